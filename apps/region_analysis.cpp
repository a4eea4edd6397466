// SPDX-License-Identifier: BSD-3-Clause
#include "region_analysis.h"

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

RegionAnalysis
analyseRegions(const pcl::MRFPlaneSegmentation<pcl::PointXYZ>& segmentation,
               const RegionOptions& options)
{
  RegionAnalysis analysis;
  segmentation.computeUncertainties(analysis.uncertainties);
  if (options.outlines || !options.polygons.empty())
    segmentation.computeOutlines(analysis.outlines);
  if (options.creases) {
    segmentation.computeCreases(analysis.creases);
    analysis.relations = relate(segmentation.getResult().regions);
  }
  if (options.confidence || !options.confidence_image.empty())
    segmentation.computeConfidence(analysis.confidence);
  if (options.project)
    segmentation.projectOntoPlanes(analysis.projected, *options.project);
  return analysis;
}

} // namespace pcl_mrf_planes::apps
