// SPDX-License-Identifier: BSD-3-Clause
#include "plane_errors.h"

#include "region_matching.h"

#include <pcl_mrf_planes/scatter_matrix.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <unordered_map>

namespace pcl_mrf_planes::evaluation {

namespace {

using Sums = std::unordered_map<std::uint16_t, ScatterMatrix>;

Sums sumsByLabel(const OrganizedPoints& points, const LabelImage& image)
{
  Sums sums;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points.valid[i] != 0)
      sums[image.labels[i]].add(static_cast<double>(points.x[i]),
                                static_cast<double>(points.y[i]),
                                static_cast<double>(points.z[i]));
  return sums;
}

double angleBetween(const Eigen::Vector3d& p, const Eigen::Vector3d& q)
{
  constexpr double DEGREES = 180.0 / 3.14159265358979323846;
  // Of planes, which have no front; exact for small angles, as acos is not.
  return DEGREES * std::atan2(p.cross(q).norm(), std::abs(p.dot(q)));
}

} // namespace

std::vector<PlaneError> planeErrors(const OrganizedPoints& points,
                                    const LabelImage& truth, const LabelImage& labels,
                                    int min_points)
{
  const ContingencyTable table = compareLabels(truth, labels);
  if (points.width != truth.width || points.height != truth.height)
    throw std::invalid_argument("the truth is " + std::to_string(truth.width) + " x " +
                                std::to_string(truth.height) + " points, the cloud " +
                                std::to_string(points.width) + " x " +
                                std::to_string(points.height));
  Sums of_truth = sumsByLabel(points, truth);
  Sums of_labels = sumsByLabel(points, labels);
  std::vector<PlaneError> errors;
  for (const RegionOverlap& overlap : planeOverlaps(table, min_points)) {
    if (!overlap.isMatch())
      continue;
    const std::uint16_t true_label = table.truth[overlap.truth].label;
    const std::uint16_t label = table.labels[overlap.label].label;
    const ScatterMatrix& sums = of_truth[true_label];
    const PlaneFitResult expected = fitPlane(sums, PlaneFit::GEOMETRIC);
    const PlaneFitResult found = fitPlane(of_labels[label], PlaneFit::GEOMETRIC);
    if (expected.valid && found.valid)
      errors.push_back({true_label, label,
                        angleBetween(expected.plane.normal, found.plane.normal),
                        std::abs(found.plane.distance(sums.centroid()))});
  }
  return errors;
}

ErrorSpread spreadOf(std::vector<double> values)
{
  if (values.empty()) {
    constexpr double NONE = std::numeric_limits<double>::quiet_NaN();
    return {NONE, NONE, NONE};
  }
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  const double sum = std::accumulate(values.begin(), values.end(), 0.0);
  return {sum / static_cast<double>(n), 0.5 * (values[(n - 1) / 2] + values[n / 2]),
          values.back()};
}

PlaneErrorSummary summarize(const std::vector<PlaneError>& errors)
{
  std::vector<double> angles, offsets;
  for (const PlaneError& error : errors) {
    angles.push_back(error.angle);
    offsets.push_back(error.offset);
  }
  return {static_cast<int>(errors.size()), spreadOf(angles), spreadOf(offsets)};
}

} // namespace pcl_mrf_planes::evaluation
