// SPDX-License-Identifier: BSD-3-Clause
#include "label_contours.h"

#include <pcl_mrf_planes/region_contour.h>

namespace pcl_mrf_planes::viewer {

std::vector<LabelContour> contoursOf(const ViewFrame& frame, const SegmentedView& view,
                                     int min_points)
{
  const int width = frame.points.width;
  const int height = frame.points.height;
  const ConnectedParts parts = findConnectedParts(view.labels, width, height);
  std::vector<LabelContour> contours;
  for (std::size_t k = 0; k < parts.size.size(); ++k)
    if (parts.size[k] >= min_points)
      contours.push_back(
          {parts.label[k], traceContour(parts, static_cast<int>(k), width, height)});
  return contours;
}

} // namespace pcl_mrf_planes::viewer
