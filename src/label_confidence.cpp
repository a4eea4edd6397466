// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/label_confidence.h>

#include <pcl_mrf_planes/plane_field.h>
#include <pcl_mrf_planes/row_propagation.h>

#include "adaptive/label_gap.h"
#include "adaptive/label_gap_kernel.h"
#include "label_runs.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

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
  const auto middle = prices.begin() + static_cast<std::ptrdiff_t>(prices.size() / 2);
  std::nth_element(prices.begin(), middle, prices.end());
  return *middle;
}

/// Evidence at which every second plane is one: those of half as much are dropped.
constexpr double EVEN_EVIDENCE = 1000.0; // nats

/// How likely a plane of so much evidence is one that is there: its odds grow with it.
float planeShare(double evidence)
{
  const double some = std::max(evidence, 0.0);
  return static_cast<float>(some / (some + EVEN_EVIDENCE));
}

/// Labels are right if they are the best ones and their planes are there.
void weighByEvidence(const std::vector<PlaneRegion>& regions, int width,
                     const std::vector<double>& evidence,
                     std::vector<float>& confidence)
{
  for (const LabelRun& run : runsOfRegions(regions, width)) {
    const float share = planeShare(evidence[run.label - 1U]);
    for (std::size_t i = run.begin; i < run.end; ++i)
      confidence[i] *= share;
  }
}

std::vector<float> adaptiveConfidence(const OrganizedPoints& points,
                                      const PlaneSegmentation& result,
                                      const Parameters& parameters)
{
  adaptive::LabelGaps found = adaptive::labelGaps(points, result, parameters);
  const double scale = 2.0 * std::max(parameters.adaptive.label_change, 1e-9);
  adaptive::gapsToShares({0.0f, static_cast<float>(0.5 / (scale * scale))},
                         points.valid.data(), found.gaps.size(), found.gaps.data());
  weighByEvidence(result.regions, points.width, found.evidence, found.gaps);
  return std::move(found.gaps);
}

/// Makes points of a run less sure the further they are from their plane, half at so many
/// times the noise that a tile may have. \param[in] depth of the first point
void weighRun(const OrganizedPoints& points, const LabelRun& run, const Plane& plane,
              const Parameters& parameters, const float* depth,
              std::vector<float>& confidence)
{
  constexpr double HALF = 5.0;
  const double unit = HALF * parameters.noise_multiplier;
  for (std::size_t i = run.begin; i < run.end; ++i) {
    const double away = plane.normal.x() * points.x[i] +
                        plane.normal.y() * points.y[i] +
                        plane.normal.z() * points.z[i] + plane.d;
    const double z = std::abs(static_cast<double>(depth[i - run.begin]));
    const double sigmas = away / std::max(unit * parameters.noise.sigma(z), 1e-9);
    confidence[i] /= static_cast<float>(1.0 + sigmas * sigmas);
  }
}

/// The data term (7) is cut off so far away that beliefs tell little of the fit.
void weighByFit(const OrganizedPoints& points, const PlaneSegmentation& result,
                const Parameters& parameters, std::vector<float>& confidence)
{
  std::vector<float> ranges;
  const auto width = static_cast<std::size_t>(points.width);
  for (const LabelRun& run : runsOfRegions(result.regions, points.width)) {
    const std::size_t row = run.begin / width;
    const float* depths = points.depthRow(static_cast<int>(row), ranges);
    weighRun(points, run, result.regions[run.label - 1U].plane, parameters,
             depths + (run.begin - row * width), confidence);
  }
}

std::vector<float> paperConfidence(const OrganizedPoints& points,
                                   const PlaneSegmentation& result,
                                   const Parameters& parameters)
{
  std::vector<Plane> planes;
  for (const PlaneModel& model : result.clusters.planes)
    planes.push_back(model.plane);
  if (planes.empty())
    return std::vector<float>(points.size(), 0.0f);
  std::vector<float> out;
  if (planes.size() > 1) {
    out = paperGaps(points, planes, parameters);
    const double price = std::max(typicalPrice(planes, parameters), 1e-9);
    adaptive::gapsToShares({static_cast<float>(2.0 / price), 0.0f}, points.valid.data(),
                           out.size(), out.data());
  }
  else // nothing competes
    out.assign(points.valid.begin(), points.valid.end());
  weighByFit(points, result, parameters, out);
  return out;
}

} // namespace

std::vector<float> labelConfidence(const OrganizedPoints& points,
                                   const PlaneSegmentation& result,
                                   const Parameters& parameters)
{
  return parameters.method == Method::ADAPTIVE
             ? adaptiveConfidence(points, result, parameters)
             : paperConfidence(points, result, parameters);
}

} // namespace pcl_mrf_planes
