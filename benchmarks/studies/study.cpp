// SPDX-License-Identifier: BSD-3-Clause
#include "study.h"

#include "frames.h"
#include "parallel.h"

namespace pcl_mrf_planes::benchmarks {

std::vector<LabelledCloud> readLabelledClouds(const std::string& folder,
                                              const std::vector<std::string>& sets)
{
  std::vector<LabelledCloud> clouds;
  for (const Frame& frame : listFrames(folder, sets))
    if (!frame.truth.empty())
      clouds.push_back({frame.set, frame.name, readCloud(frame), readTruth(frame)});
  return clouds;
}

std::vector<Result> runStudy(const Study& study, unsigned int threads)
{
  std::vector<Result> results(study.variants.size() * study.clouds.size());
  doAll(results.size(), threads, [&](std::size_t i) {
    const Variant& variant = study.variants[i / study.clouds.size()];
    const LabelledCloud& cloud = study.clouds[i % study.clouds.size()];
    Result& result = results[i];
    result.method = study.name;
    result.setting = variant.name;
    result.set = cloud.set;
    result.frame = cloud.name;
    result.width = cloud.truth.width;
    result.height = cloud.truth.height;
    const Labels labels = variant.segment(cloud.cloud, result.milliseconds);
    scoreAgainst(cloud.truth, {result.width, result.height, labels}, result);
  });
  return results;
}

} // namespace pcl_mrf_planes::benchmarks
