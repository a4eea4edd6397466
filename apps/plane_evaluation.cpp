// SPDX-License-Identifier: BSD-3-Clause
/** \file Command line: scores planes against ground truth. */
#include "evaluation/evaluation_files.h"
#include "evaluation/evaluation_options.h"
#include "evaluation/evaluation_result.h"
#include "evaluation/evaluation_table.h"
#include "option_values.h"
#include "output_file.h"

#include <pcl/console/print.h>

#include <exception>
#include <iostream>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace pcl_mrf_planes::evaluation;
namespace apps = pcl_mrf_planes::apps;

constexpr const char* PROGRAM = "pcl_mrf_plane_evaluation";
constexpr int FAILURE = 1;
constexpr int WRONG_USAGE = 2;

std::vector<FrameFiles> listFrames(const EvaluationOptions& options)
{
  if (!options.files.empty())
    return pairFrames(options.files, options.cloud, options.suffixes);
  return findFrames(options.truth, options.labels, options.cloud, options.suffixes);
}

void run(const EvaluationOptions& options)
{
  for (const std::string& path : {options.csv, options.json})
    if (!path.empty())
      apps::checkWritable(path);
  std::vector<FrameResult> frames;
  for (const FrameFiles& files : listFrames(options))
    frames.push_back(scoreFrame(files, options));
  const EvaluationResult result = summarizeFrames(std::move(frames));
  if (!options.csv.empty())
    writeCsv(options.csv, result);
  if (!options.json.empty())
    writeJson(options.json, result, options);
  if (options.quiet)
    return;
  printEvaluation(std::cout, result, options);
  if (!std::cout.flush())
    throw std::runtime_error("cannot write to standard output");
}

} // namespace

int main(int argc, char* argv[])
{
  // What PCL would print is said by the messages below, with what to do about it.
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  try {
    const EvaluationOptions options = parseEvaluationOptions(argc, argv);
    if (options.help)
      std::cout << evaluationHelp();
    else if (options.version)
      std::cout << PROGRAM << ' ' << PCL_MRF_PLANES_VERSION << '\n';
    else
      run(options);
    if (!std::cout.flush())
      throw std::runtime_error("cannot write to standard output");
    return 0;
  }
  catch (const apps::UsageError& error) {
    std::cerr << PROGRAM << ": " << error.what() << '\n';
    return WRONG_USAGE;
  }
  catch (const std::bad_alloc&) {
    std::cerr << PROGRAM << ": not enough memory; score fewer frames at once\n";
  }
  catch (const std::exception& error) {
    std::cerr << PROGRAM << ": " << error.what() << '\n';
  }
  return FAILURE;
}
