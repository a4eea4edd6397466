// SPDX-License-Identifier: BSD-3-Clause
/** \file Command line: scores planes against ground truth. */
#include "app_main.h"
#include "evaluation/evaluation_files.h"
#include "evaluation/evaluation_options.h"
#include "evaluation/evaluation_result.h"
#include "evaluation/evaluation_table.h"
#include "output_file.h"

#include <iostream>
#include <string>
#include <vector>

namespace {

using namespace pcl_mrf_planes::evaluation;
namespace apps = pcl_mrf_planes::apps;

constexpr const char* PROGRAM = "pcl_mrf_plane_evaluation";

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
  if (!options.quiet)
    printEvaluation(std::cout, result, options);
}

} // namespace

int main(int argc, char* argv[])
{
  return apps::runApp({PROGRAM, "score fewer frames at once"}, [&] {
    const EvaluationOptions options = parseEvaluationOptions(argc, argv);
    if (options.help)
      std::cout << evaluationHelp();
    else if (options.version)
      std::cout << PROGRAM << ' ' << PCL_MRF_PLANES_VERSION << '\n';
    else
      run(options);
    return 0;
  });
}
