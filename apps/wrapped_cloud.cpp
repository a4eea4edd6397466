// SPDX-License-Identifier: BSD-3-Clause
#include "wrapped_cloud.h"

#include <pcl_mrf_planes/organized_points.h>
#include <pcl_mrf_planes/plane_regions.h>
#include <pcl_mrf_planes/scatter_matrix.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace pcl_mrf_planes::apps {

namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Labels = pcl::PointCloud<pcl::Label>;

/// Wide enough for the largest tiles (32 points) on the far side of the seam.
constexpr std::uint32_t WIDEST_MARGIN = 128;
/// Two labels are one plane if this share of the smaller one's points of the margin says
/// so.
constexpr double JOINING_SHARE = 0.5;

std::uint32_t marginOf(const Cloud& cloud)
{
  return std::min(cloud.width, WIDEST_MARGIN);
}

/// PCL's own at() takes signed numbers.
template <typename AnyCloud>
auto& pointAt(AnyCloud& cloud, std::uint32_t column, std::uint32_t row)
{
  return cloud[std::size_t{row} * cloud.width + column];
}

Cloud::Ptr withMargins(const Cloud& cloud)
{
  const std::uint32_t margin = marginOf(cloud);
  Cloud::Ptr wide(new Cloud(cloud.width + 2 * margin, cloud.height));
  wide->sensor_origin_ = cloud.sensor_origin_;
  wide->sensor_orientation_ = cloud.sensor_orientation_;
  wide->is_dense = cloud.is_dense;
  for (std::uint32_t row = 0; row < wide->height; ++row)
    for (std::uint32_t column = 0; column < wide->width; ++column)
      pointAt(*wide, column, row) =
          pointAt(cloud, (column + cloud.width - margin) % cloud.width, row);
  return wide;
}

/// Labels that mean the same plane, by union of sets.
class SameLabels {
public:
  explicit SameLabels(std::size_t labels)
  : parents_(labels + 1)
  {
    std::iota(parents_.begin(), parents_.end(), 0u);
  }
  std::uint32_t find(std::uint32_t label) const
  {
    while (parents_[label] != label)
      label = parents_[label];
    return label;
  }
  void join(std::uint32_t a, std::uint32_t b)
  {
    a = find(a);
    b = find(b);
    parents_[std::max(a, b)] = std::min(a, b);
  }

private:
  std::vector<std::uint32_t> parents_;
};

SameLabels joinAcrossSeam(const Labels& wide, std::size_t planes, std::uint32_t width)
{
  const std::uint32_t margin = (wide.width - width) / 2;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> both;
  std::map<std::uint32_t, std::size_t> of_scan, of_margin;
  for (std::uint32_t row = 0; row < wide.height; ++row)
    for (std::uint32_t i = 0; i < 2 * margin; ++i) {
      const bool left = i < margin;
      const std::uint32_t column = left ? i : i + width;
      const std::uint32_t repeated = left ? column + width : column - width;
      const std::uint32_t a = pointAt(wide, repeated, row).label;
      const std::uint32_t b = pointAt(wide, column, row).label;
      ++of_scan[a];
      ++of_margin[b];
      ++both[{a, b}];
    }
  SameLabels same(planes);
  for (const auto& pair : both) {
    const std::uint32_t a = pair.first.first, b = pair.first.second;
    const auto smaller = static_cast<double>(std::min(of_scan[a], of_margin[b]));
    if (a != 0 && b != 0 && a != b &&
        static_cast<double>(pair.second) >= JOINING_SHARE * smaller)
      same.join(a, b);
  }
  return same;
}

/// The scan and its first column once more, so that the seam has an area, too.
OrganizedPoints closedScan(const Cloud& cloud)
{
  OrganizedPoints points;
  points.resize(static_cast<int>(cloud.width) + 1, static_cast<int>(cloud.height));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto column = static_cast<std::uint32_t>(i % (cloud.width + 1));
    const auto& p = pointAt(cloud, column % cloud.width,
                            static_cast<std::uint32_t>(i / (cloud.width + 1)));
    points.set(i, p.x, p.y, p.z);
  }
  return points;
}

/// Planes of the scan's own points, fitted anew where labels were joined.
class SeamlessPlanes {
public:
  SeamlessPlanes(const Cloud& cloud, const SegmentedCloud& wide)
  : cloud_(cloud)
  , points_(closedScan(cloud))
  , same_(joinAcrossSeam(wide.labels, wide.planes.size(), cloud.width))
  , labels_(points_.size(), NO_PLANE)
  , sums_(wide.planes.size())
  {
    const std::uint32_t margin = marginOf(cloud);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const auto column = static_cast<std::uint32_t>(i % (cloud.width + 1));
      const std::uint32_t label =
          pointAt(wide.labels, margin + column % cloud.width,
                  static_cast<std::uint32_t>(i / (cloud.width + 1)))
              .label;
      if (label == 0 || points_.valid[i] == 0)
        continue;
      const std::uint32_t plane = same_.find(label) - 1;
      labels_[i] = static_cast<std::uint16_t>(plane);
      if (column < cloud.width)
        sums_[plane].add(static_cast<double>(points_.x[i]),
                         static_cast<double>(points_.y[i]),
                         static_cast<double>(points_.z[i]));
    }
    for (const PlaneSummary& plane : wide.planes)
      planes_.push_back({plane.coefficients.head<3>().cast<double>(),
                         static_cast<double>(plane.coefficients[3])});
    fitJoined();
  }

  /// Into the result: planes and labels, largest area first.
  void gather(const Parameters& parameters, const SegmentedCloud& wide,
              SegmentedCloud& result) const
  {
    const auto regions = gatherRegions(points_, planes_, labels_,
                                       parameters.min_inliers, parameters.min_area);
    std::vector<std::uint32_t> number(planes_.size(), 0);
    for (const PlaneRegion& region : regions) {
      const auto old = static_cast<std::size_t>(region.label);
      PlaneSummary plane = wide.planes[old];
      plane.coefficients.head<3>() = planes_[old].normal.cast<float>();
      plane.coefficients[3] = static_cast<float>(planes_[old].d);
      plane.centroid = sums_[old].centroid().homogeneous().cast<float>();
      plane.points = static_cast<std::size_t>(sums_[old].n);
      plane.area = region.area;
      plane.rms = sums_[old].rmsDistance(planes_[old]);
      result.planes.push_back(plane);
      number[old] = static_cast<std::uint32_t>(result.planes.size());
    }
    result.labels = Labels(cloud_.width, cloud_.height);
    for (std::size_t i = 0; i < result.labels.size(); ++i) {
      const std::uint16_t label =
          labels_[i / cloud_.width * (cloud_.width + 1) + i % cloud_.width];
      result.labels[i].label = label == NO_PLANE ? 0 : number[label];
    }
  }

  /// Measured points of the scan.
  std::size_t validPoints() const
  {
    std::size_t count = 0;
    for (std::size_t i = 0; i < points_.size(); ++i)
      count += i % (cloud_.width + 1) < cloud_.width && points_.valid[i] != 0 ? 1 : 0;
    return count;
  }

private:
  void fitJoined()
  {
    std::vector<int> parts(planes_.size(), 0);
    for (std::size_t k = 0; k < planes_.size(); ++k)
      ++parts[same_.find(static_cast<std::uint32_t>(k + 1)) - 1];
    for (std::size_t k = 0; k < planes_.size(); ++k) {
      const PlaneFitResult fit = fitPlane(sums_[k], PlaneFit::GEOMETRIC);
      if (parts[k] < 2 || !fit.valid)
        continue;
      const bool turned = fit.plane.normal.dot(planes_[k].normal) < 0.0;
      planes_[k] = fit.plane;
      if (turned) { // towards the sensor, which need not be at the origin
        planes_[k].normal = -planes_[k].normal;
        planes_[k].d = -planes_[k].d;
      }
    }
  }

  const Cloud& cloud_;
  OrganizedPoints points_;
  SameLabels same_;
  std::vector<std::uint16_t> labels_; ///< index of a plane, or NO_PLANE
  std::vector<ScatterMatrix> sums_;
  std::vector<Plane> planes_;
};

} // namespace

SegmentedCloud segmentWrapped(const Cloud& cloud, const Parameters& parameters,
                              int repeat)
{
  const SegmentedCloud wide = segmentCloud(withMargins(cloud), parameters, repeat);
  const SeamlessPlanes planes(cloud, wide);
  SegmentedCloud result;
  result.timing = wide.timing;
  result.report = wide.report;
  planes.gather(parameters, wide, result);
  std::size_t labelled = 0;
  for (const PlaneSummary& plane : result.planes)
    labelled += plane.points;
  result.report.points = cloud.size();
  result.report.valid_points = planes.validPoints();
  result.report.planes = result.planes.size();
  result.report.labelled_share =
      static_cast<double>(labelled) /
      static_cast<double>(std::max<std::size_t>(1, result.report.valid_points));
  return result;
}

} // namespace pcl_mrf_planes::apps
