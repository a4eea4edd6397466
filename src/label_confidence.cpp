// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/label_confidence.h>

#include <pcl_mrf_planes/plane_field.h>
#include <pcl_mrf_planes/row_propagation.h>

#include "adaptive/label_gap.h"
#include "adaptive/label_gap_kernel.h"

#include <algorithm>
#include <cstddef>

namespace pcl_mrf_planes {

namespace {

/// Gaps of the beliefs in units of energy, equation (6).
std::vector<float> paperGaps(const OrganizedPoints& points,
                             const std::vector<Plane>& planes,
                             const Parameters& parameters)
{
  const PlaneField field(points, planes, parameters);
  std::vector<float> gaps;
  gaps.reserve(points.size());
  for (const std::uint16_t gap :
       propagateRowGaps(field, parameters.iterations, parameters.number_of_threads))
    gaps.push_back(static_cast<float>(gap / field.unitsPerEnergy()));
  return gaps;
}

/// Median price of two different planes at the same depth.
double typicalPrice(const std::vector<Plane>& planes, const Parameters& parameters)
{
  if (parameters.smoothness == Smoothness::POTTS)
    return parameters.gamma;
  std::vector<double> prices;
  for (std::size_t a = 0; a < planes.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      prices.push_back(dissimilarity(planes[a], planes[b], parameters.beta));
  if (prices.empty())
    return 1.0;
  const auto middle = prices.begin() + static_cast<std::ptrdiff_t>(prices.size() / 2);
  std::nth_element(prices.begin(), middle, prices.end());
  return *middle;
}

void gapsToConfidence(const OrganizedPoints& points, double price,
                      std::vector<float>& gaps)
{
  const double scale = 1.0 / std::max(2.0 * price, 1e-9);
  adaptive::gapsToShares(static_cast<float>(scale), points.valid.data(), gaps.size(),
                         gaps.data());
}

} // namespace

std::vector<float> labelConfidence(const OrganizedPoints& points,
                                   const PlaneSegmentation& result,
                                   const Parameters& parameters)
{
  if (parameters.method == Method::ADAPTIVE) {
    std::vector<float> gaps = adaptive::labelGaps(points, result, parameters);
    gapsToConfidence(points, parameters.adaptive.label_change, gaps);
    return gaps;
  }
  std::vector<Plane> planes;
  for (const PlaneModel& model : result.clusters.planes)
    planes.push_back(model.plane);
  if (planes.empty())
    return std::vector<float>(points.size(), 0.0f);
  std::vector<float> gaps = paperGaps(points, planes, parameters);
  gapsToConfidence(points, typicalPrice(planes, parameters), gaps);
  return gaps;
}

} // namespace pcl_mrf_planes
