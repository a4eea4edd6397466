// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/plane_field.h>

#include "data_term_kernel.h"
#include "threads.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pcl_mrf_planes {

namespace {

constexpr double LARGEST_SUM = 65535.0; // of a data cost and four messages
constexpr int ROUNDING = 5;             // terms in that sum, each rounded up at worst

int labelCount(const std::vector<Plane>& planes)
{
  return static_cast<int>(planes.size());
}

/// |1 - c| of the text before equation (10), for a label pair: the mean of the two, so
/// that the price does not depend on the direction of the edge.
double depthScale(const Plane& p, const Plane& q)
{
  return 0.5 * (std::abs(1.0 - p.normal.z()) + std::abs(1.0 - q.normal.z()));
}

std::uint16_t rounded(double units)
{
  // One below NO_EDGE: a weight must not be taken for a missing edge.
  return static_cast<std::uint16_t>(std::lround(std::min(units, 65534.0)));
}

} // namespace

PlaneField::PlaneField(const OrganizedPoints& points, std::vector<Plane> planes,
                       const Parameters& parameters)
: points_(points)
, planes_(std::move(planes))
, parameters_(parameters)
{
  depth_.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    depth_[i] = points.depth(i);

  const auto labels = static_cast<Eigen::Index>(planes_.size());
  dissimilarity_.resize(labels, labels);
  for (Eigen::Index a = 0; a < labels; ++a)
    for (Eigen::Index b = 0; b < labels; ++b)
      dissimilarity_(a, b) = // (9); exactly 0 for a label and itself
          a == b
              ? 0.0
              : dissimilarity(planes_[static_cast<std::size_t>(a)],
                              planes_[static_cast<std::size_t>(b)], parameters_.beta);

  const bool scaled = parameters_.smoothness == Smoothness::PREDICTED_DEPTH;
  field_ = GridField(points.width, points.height, labelCount(planes_),
                     scaled ? EdgeModel::SCALED_MAXIMUM : EdgeModel::SOFT_THRESHOLD);
  choosePrices(scaled ? largestDepthStep() : 0.0);
  fillData();
  fillEdges();
}

void PlaneField::choosePrices(double largest_depth_step)
{
  const int labels = labelCount(planes_);
  double largest = 0.0;
  for (int a = 0; a < labels; ++a)
    for (int b = 0; b <= a; ++b)
      largest = std::max(largest, smoothnessTerm(a, b, largest_depth_step));

  const double largest_data = parameters_.lambda * parameters_.tau;
  const double largest_sum = largest_data + 4.0 * largest;
  units_ = largest_sum > 0.0 ? (LARGEST_SUM - ROUNDING) / largest_sum : 1.0;

  for (int a = 0; a < labels; ++a)
    for (int b = 0; b <= a; ++b) {
      field_.setPairwise(a, b, rounded(smoothnessTerm(a, b, 0.0) * units_));
      // |1 - c| lies between 0 and 2; the edge weights hold 2 |dz|.
      const double scale = depthScale(planes_[static_cast<std::size_t>(a)],
                                      planes_[static_cast<std::size_t>(b)]);
      field_.setScale(a, b, rounded(scale * 32768.0));
    }
}

void PlaneField::fillData()
{
  const CheckerboardLayout& layout = field_.layout();
  const auto width = static_cast<std::size_t>(points_.width);
  parallelRows(points_.height, parameters_.number_of_threads, [&](int y) {
    std::vector<std::uint16_t> row(width);
    const std::size_t start = static_cast<std::size_t>(y) * width;
    for (int l = 0; l < field_.labels(); ++l) {
      const Plane& plane = planes_[static_cast<std::size_t>(l)];
      const DataTerm term = {static_cast<float>(plane.normal.x()),
                             static_cast<float>(plane.normal.y()),
                             static_cast<float>(plane.normal.z()),
                             static_cast<float>(plane.d),
                             static_cast<float>(parameters_.tau),
                             static_cast<float>(parameters_.lambda * units_)};
      dataTermRow(term, &points_.x[start], &points_.y[start], &points_.z[start], width,
                  row.data());
      for (std::size_t x = 0; x < width; ++x) // an invalid point is no site: cost 0
        row[x] = points_.valid[start + x] != 0 ? row[x] : std::uint16_t{0};
      for (int colour = 0; colour < 2; ++colour) {
        const std::uint16_t* in = &row[0] + CheckerboardLayout::firstColumn(y, colour);
        std::uint16_t* out = field_.dataRow(colour, y, l);
        const int sites = layout.sitesInRow(y, colour);
        for (int k = 0; k < sites; ++k)
          out[k] = in[2 * k];
      }
    }
  });
}

std::uint16_t PlaneField::edgeWeight(std::size_t from, std::size_t to) const
{
  if (points_.valid[from] == 0 || points_.valid[to] == 0)
    return GridField::NO_EDGE;
  const double step = std::abs(static_cast<double>(depth_[from]) - depth_[to]);
  switch (parameters_.smoothness) {
  case Smoothness::HYBRID:
    return rounded(step * units_);
  case Smoothness::PREDICTED_DEPTH:
    return rounded(2.0 * step * units_);
  case Smoothness::POTTS:
  case Smoothness::DISSIMILARITY:
    break;
  }
  return 0;
}

void PlaneField::fillEdges()
{
  const auto width = static_cast<std::size_t>(points_.width);
  parallelRows(points_.height, parameters_.number_of_threads, [&](int y) {
    for (int x = 0; x < points_.width; ++x) {
      const std::size_t i =
          static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
      if (x + 1 < points_.width)
        field_.setRightEdge(x, y, edgeWeight(i, i + 1));
      if (y + 1 < points_.height)
        field_.setDownEdge(x, y, edgeWeight(i, i + width));
    }
  });
}

double PlaneField::largestDepthStep() const
{
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (std::size_t i = 0; i < points_.size(); ++i)
    if (points_.valid[i] != 0) {
      low = std::min(low, static_cast<double>(depth_[i]));
      high = std::max(high, static_cast<double>(depth_[i]));
    }
  return std::max(0.0, high - low);
}

double PlaneField::dataTerm(std::size_t index, int l) const
{
  const Eigen::Vector3d point(points_.x[index], points_.y[index], points_.z[index]);
  const double distance = planes_[static_cast<std::size_t>(l)].distance(point);
  return parameters_.lambda * std::min(std::abs(distance), parameters_.tau); // (7)
}

double PlaneField::smoothnessTerm(int a, int b, double dz) const
{
  switch (parameters_.smoothness) {
  case Smoothness::POTTS:
    return a == b ? 0.0 : parameters_.gamma; // (8)
  case Smoothness::DISSIMILARITY:
    return dissimilarity_(a, b); // (9)
  case Smoothness::HYBRID:
    return std::max(std::abs(dz), dissimilarity_(a, b)); // (10)
  case Smoothness::PREDICTED_DEPTH:
    break;
  }
  const double scale = depthScale(planes_[static_cast<std::size_t>(a)],
                                  planes_[static_cast<std::size_t>(b)]);
  return std::max(scale * std::abs(dz), dissimilarity_(a, b)); // text before (10)
}

FieldEnergy PlaneField::energy(const std::vector<std::uint16_t>& labels) const
{
  FieldEnergy sum;
  const auto width = static_cast<std::size_t>(points_.width);
  const auto edge = [&](std::size_t i, std::size_t j) {
    if (points_.valid[j] != 0)
      sum.smoothness += smoothnessTerm(labels[i], labels[j],
                                       static_cast<double>(depth_[i]) - depth_[j]);
  };
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (points_.valid[i] == 0)
      continue;
    sum.data += dataTerm(i, labels[i]);
    if ((i + 1) % width != 0)
      edge(i, i + 1);
    if (i + width < points_.size())
      edge(i, i + width);
  }
  return sum;
}

} // namespace pcl_mrf_planes
