// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/plane_field.h>

#include "field_kernel.h"
#include "frame_memory.h"

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

/// OrganizedPoints::depthRow() in memory of the frame.
const float* depthRow(const OrganizedPoints& points, int row,
                      FrameVector<float>& storage)
{
  const std::size_t start =
      static_cast<std::size_t>(row) * static_cast<std::size_t>(points.width);
  if (points.depth_measure != DepthMeasure::RANGE)
    return &points.z[start];
  storage.resize(static_cast<std::size_t>(points.width));
  for (std::size_t i = 0; i < storage.size(); ++i)
    storage[i] = points.depth(start + i);
  return storage.data();
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
, layout_(points.width, points.height)
{
  prepare();
}

PlaneField::PlaneField(const OrganizedPoints& points, const std::vector<Plane>& planes,
                       const Parameters& parameters, PlaneField&& memory)
: points_(points)
, planes_(std::move(memory.planes_))
, parameters_(parameters)
, dissimilarity_(std::move(memory.dissimilarity_))
, layout_(points.width, points.height)
, prices_(std::move(memory.prices_))
{
  planes_.assign(planes.begin(), planes.end());
  prepare();
}

void PlaneField::prepare()
{
  dissimilarity_.clear();
  for (const Plane& a : planes_)
    for (const Plane& b : planes_)
      dissimilarity_.push_back( // (9); exactly 0 for a label and itself
          &a == &b ? 0.0 : dissimilarity(a, b, parameters_.beta));

  const bool scaled = parameters_.smoothness == Smoothness::PREDICTED_DEPTH;
  prices_.reset(labelCount(planes_),
                scaled ? EdgeModel::SCALED_MAXIMUM : EdgeModel::SOFT_THRESHOLD);
  choosePrices(scaled ? largestDepthStep() : 0.0);
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
      prices_.setPairwise(a, b, rounded(smoothnessTerm(a, b, 0.0) * units_));
      // |1 - c| lies between 0 and 2; the edge weights hold 2 |dz|.
      const double scale = depthScale(planes_[static_cast<std::size_t>(a)],
                                      planes_[static_cast<std::size_t>(b)]);
      prices_.setScale(a, b, rounded(scale * 32768.0));
    }
}

void PlaneField::fillRow(int y, const FieldRow& row) const
{
  fillData(y, row);
  fillEdges(y, row);
}

void PlaneField::fillData(int y, const FieldRow& row) const
{
  const auto width = static_cast<std::size_t>(points_.width);
  const std::size_t start = static_cast<std::size_t>(y) * width;
  FrameVector<std::uint16_t> costs(width +
                                   1); // one more: a row of width 1 has no odd site
  for (int l = 0; l < prices_.labels(); ++l) {
    const Plane& plane = planes_[static_cast<std::size_t>(l)];
    const DataTerm term = {static_cast<float>(plane.normal.x()),
                           static_cast<float>(plane.normal.y()),
                           static_cast<float>(plane.normal.z()),
                           static_cast<float>(plane.d),
                           static_cast<float>(parameters_.tau),
                           static_cast<float>(parameters_.lambda * units_)};
    dataTermRow(term, &points_.x[start], &points_.y[start], &points_.z[start],
                &points_.valid[start], width, costs.data());
    split(costs.data(), y, row.data, static_cast<std::ptrdiff_t>(l) * layout_.stride);
  }
}

double PlaneField::edgeScale() const
{
  switch (parameters_.smoothness) {
  case Smoothness::HYBRID:
    return units_;
  case Smoothness::PREDICTED_DEPTH:
    return 2.0 * units_; // |1 - c| is held halved
  case Smoothness::POTTS:
  case Smoothness::DISSIMILARITY:
    break;
  }
  return 0.0; // the depth has no say
}

void PlaneField::fillEdges(int y, const FieldRow& row) const
{
  const auto width = static_cast<std::size_t>(points_.width);
  const std::size_t start = static_cast<std::size_t>(y) * width;
  const auto scale = static_cast<float>(edgeScale());
  FrameVector<std::uint16_t> weights(width + 1, PairPrices::NO_EDGE);
  FrameVector<float> range;
  const float* depth = depthRow(points_, y, range);
  const std::uint8_t* valid = &points_.valid[start];
  edgeWeightRow(depth, depth + 1, valid, valid + 1, scale, width - 1, weights.data());
  weights[width - 1] = PairPrices::NO_EDGE;
  split(weights.data(), y, row.right, 0);

  if (y + 1 < points_.height) {
    FrameVector<float> range_below;
    edgeWeightRow(depth, depthRow(points_, y + 1, range_below), valid, valid + width,
                  scale, width, weights.data());
  }
  else
    std::fill(weights.begin(), weights.end(), PairPrices::NO_EDGE);
  split(weights.data(), y, row.down, 0);
}

void PlaneField::split(const std::uint16_t* costs, int y,
                       std::uint16_t* const colours[2], std::ptrdiff_t offset) const
{
  for (int colour = 0; colour < 2; ++colour) {
    const std::uint16_t* in = costs + CheckerboardLayout::firstColumn(y, colour);
    std::uint16_t* out = colours[colour] + offset;
    const int sites = layout_.sitesInRow(y, colour);
    for (int k = 0; k < sites; ++k)
      out[k] = in[2 * k];
  }
}

double PlaneField::largestDepthStep() const
{
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (std::size_t i = 0; i < points_.size(); ++i)
    if (points_.valid[i] != 0) {
      low = std::min(low, static_cast<double>(points_.depth(i)));
      high = std::max(high, static_cast<double>(points_.depth(i)));
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
    return labelDissimilarity(a, b); // (9)
  case Smoothness::HYBRID:
    return std::max(std::abs(dz), labelDissimilarity(a, b)); // (10)
  case Smoothness::PREDICTED_DEPTH:
    break;
  }
  const double scale = depthScale(planes_[static_cast<std::size_t>(a)],
                                  planes_[static_cast<std::size_t>(b)]);
  return std::max(scale * std::abs(dz), labelDissimilarity(a, b)); // text before (10)
}

FieldEnergy PlaneField::energy(const std::vector<std::uint16_t>& labels) const
{
  FieldEnergy sum;
  const auto width = static_cast<std::size_t>(points_.width);
  const auto edge = [&](std::size_t i, std::size_t j) {
    if (points_.valid[j] != 0)
      sum.smoothness +=
          smoothnessTerm(labels[i], labels[j],
                         static_cast<double>(points_.depth(i)) - points_.depth(j));
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
