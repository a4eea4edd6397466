// SPDX-License-Identifier: BSD-3-Clause
/** \file Command line: what each part of the profile DEFAULT is worth, how much its
 * parameters matter, and what noise does to it. */
#include "studies.h"

#include <pcl/console/print.h>

#include <boost/program_options.hpp>

#include <algorithm>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

namespace po = boost::program_options;
using namespace pcl_mrf_planes::benchmarks;

struct Options {
  bool help = false;
  std::string data, output;
  std::vector<std::string> sets, studies;
  unsigned int threads = 2;
};

po::options_description describe(Options& o)
{
  po::options_description all("Options");
  auto add = all.add_options();
  add("help,h", po::bool_switch(&o.help), "print this and exit");
  add("data", po::value(&o.data),
      "folder of sets: SET/NAME.pcd with ground truth, as for benchmark_peers");
  add("output", po::value(&o.output)->default_value("studies.csv"), "CSV to write");
  add("sets", po::value(&o.sets)->multitoken(), "these sets only");
  add("studies", po::value(&o.studies)->multitoken(),
      "these only: ablation, sensitivity, noise");
  add("threads", po::value(&o.threads)->default_value(2),
      "frames at a time; the times in the CSV are then of all of them together");
  return all;
}

bool isWanted(const Options& options, const std::string& study)
{
  const auto& names = options.studies;
  return names.empty() || std::find(names.begin(), names.end(), study) != names.end();
}

std::vector<Study> chooseStudies(const Options& options)
{
  const std::vector<LabelledCloud> clouds =
      readLabelledClouds(options.data, options.sets);
  std::vector<Study> studies;
  if (isWanted(options, "ablation"))
    studies.push_back({"ablation", ablationVariants(), clouds});
  if (isWanted(options, "sensitivity"))
    studies.push_back({"sensitivity", sensitivityVariants(), clouds});
  if (isWanted(options, "noise"))
    studies.push_back(noiseStudy(clouds, options.threads));
  return studies;
}

void runAll(const Options& options)
{
  ResultFile file(options.output, "study,variant");
  for (const Study& study : chooseStudies(options)) {
    std::cout << study.name << ": " << study.variants.size() << " variants on "
              << study.clouds.size() << " clouds" << std::endl;
    const std::vector<Result> results = runStudy(study, options.threads);
    for (const Result& result : results)
      file.add(result);
    std::cout << summaryOf(results) << std::endl;
  }
  file.finish();
}

int run(int argc, char* argv[])
{
  Options options;
  const po::options_description all = describe(options);
  po::variables_map values;
  po::store(po::parse_command_line(argc, argv, all), values);
  po::notify(values);
  if (options.help) {
    std::cout
        << "benchmark_studies [options]\n\n"
           "Runs the profile DEFAULT with parts of it switched off, with other\n"
           "parameters, and on clouds of growing noise; writes a CSV of scores.\n\n"
        << all;
    return 0;
  }
  if (options.data.empty())
    throw po::error("name the folder of the clouds by --data");
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS); // its hints fill the screen
  runAll(options);
  return 0;
}

} // namespace

int main(int argc, char* argv[])
{
  try {
    return run(argc, argv);
  }
  catch (const po::error& error) {
    std::cerr << "benchmark_studies: " << error.what()
              << "; --help lists the options\n";
    return 2;
  }
  catch (const std::exception& error) {
    std::cerr << "benchmark_studies: " << error.what() << '\n';
    return 1;
  }
}
