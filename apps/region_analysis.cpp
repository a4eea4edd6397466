// SPDX-License-Identifier: BSD-3-Clause
#include "region_analysis.h"

#include <chrono>

namespace pcl_mrf_planes::apps {

namespace {

std::vector<RegionRelation> relate(const std::vector<PlaneRegion>& regions)
{
  std::vector<RegionRelation> relations;
  for (std::size_t a = 0; a < regions.size(); ++a)
    for (std::size_t b = a + 1; b < regions.size(); ++b)
      relations.push_back({a, b, normalAngle(regions[a].plane, regions[b].plane),
                           planeDistance(regions[a], regions[b])});
  return relations;
}

} // namespace

void analyseRegions(const pcl::MRFPlaneSegmentation<pcl::PointXYZ>& segmentation,
                    const RegionOptions& options, RegionAnalysis& analysis)
{
  analysis.stage_ms.clear();
  const auto timed = [&](const char* name, const auto& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::milli> time =
        std::chrono::steady_clock::now() - start;
    analysis.stage_ms.emplace_back(name, time.count());
  };
  timed("uncertainties",
        [&] { segmentation.computeUncertainties(analysis.uncertainties); });
  if (options.outlines || !options.polygons.empty())
    timed("outlines", [&] { segmentation.computeOutlines(analysis.outlines); });
  if (options.creases)
    timed("creases", [&] {
      segmentation.computeCreases(analysis.creases);
      analysis.relations = relate(segmentation.getResult().regions);
    });
  if (options.confidence || !options.confidence_image.empty())
    timed("confidence", [&] { segmentation.computeConfidence(analysis.confidence); });
  if (options.project)
    timed("projection", [&] {
      segmentation.projectOntoPlanes(analysis.projected, *options.project);
    });
}

} // namespace pcl_mrf_planes::apps
