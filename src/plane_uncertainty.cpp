// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/plane_uncertainty.h>

#include <pcl_mrf_planes/scatter_matrix.h>

#include "label_runs.h"
#include "plane_uncertainty_kernel.h"
#include "region_interior.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace pcl_mrf_planes {

namespace {

constexpr double FEWEST_POINTS = 4;
/// Points off the border of a region that its plane is fitted to by themselves.
constexpr double FEWEST_INSIDE = 60;
/// Spread of points across the narrow side of a plane, over that along its normal, that
/// makes it a plane.
constexpr double NARROWEST = 2.0;
/// The same over the long side: less is a line.
constexpr double THINNEST = 1e-3;
/// Least noise at 1 m, growing with distance: what float coordinates leave.
constexpr double LEAST_SIGMA = 2e-7;
/// Blocks that the correlation of all regions counts as beside a region's own.
constexpr double POOLED_BLOCKS = 30.0;
/// Least and most of a block that may be its plane's doing.
constexpr double FEWEST_IN_BLOCK = 8.0;
constexpr double LARGEST_LEVERAGE = 0.5;
/// What noise along the ray may be of a distance.
constexpr double LARGEST_NOISE = 0.1;
/// Median of chi-square with one degree of freedom.
constexpr double MEDIAN_CHI_SQUARE = 0.4549364;

/// Sums over the points of a region in one block of the image.
struct Block {
  double n = 0, u = 0, v = 0; ///< points, and their places in the plane
  double distance = 0;        ///< sum of the signed distances
  double variance = 0;        ///< sum of the noise variances
};

/// What the points of a region say about its plane.
struct Evidence {
  PlaneUncertainty result;
  double n = 0; ///< points
  Eigen::Vector3d centroid;
  Eigen::Matrix2d spread; ///< n times the covariance in the plane less the noise, m^2
  Eigen::Matrix3d noise;  ///< sum w w^t e^2
  std::vector<double> ratios; ///< of blocks: squared sum over its expected value
  /// Sum of g g^t over those blocks, with g the sum of w r over the points of a block.
  Eigen::Matrix3d shared = Eigen::Matrix3d::Zero();
};

/// Side of the blocks: many in an image, and wider than noise is correlated.
int blockSide(const OrganizedPoints& points)
{
  return std::clamp(std::min(points.width / 20, points.height / 15), 8, 32);
}

/// Sums up a region.
class RegionSums {
public:
  RegionSums(const OrganizedPoints& points, const UncertaintyNoise& noise)
  : points_(points)
  , noise_(noise)
  , side_(blockSide(points))
  , columns_((points.width + side_ - 1) / side_)
  , blocks_(static_cast<std::size_t>(columns_) *
            static_cast<std::size_t>((points.height + side_ - 1) / side_))
  , stated_(static_cast<std::size_t>(side_))
  {}

  /// Of the points off the border, or of all if the others determine no plane.
  Evidence add(const PlaneRegion& region, const RegionInterior& interior)
  {
    Evidence evidence;
    evidence.result.valid = interior.n >= FEWEST_INSIDE && fit(interior, evidence);
    if (evidence.result.valid) {
      sum(interior, evidence);
      return evidence;
    }
    const RegionInterior whole = {runsOfRegions({region}, points_.width),
                                  static_cast<double>(region.indices.size()),
                                  region.centroid, region.covariance};
    evidence.result.valid = fit(whole, evidence);
    if (evidence.result.valid)
      sum(whole, evidence);
    return evidence;
  }

private:
  /// The plane of least squares in its own axes.
  bool fit(const RegionInterior& region, Evidence& out) const
  {
    const double n = region.n;
    out.n = n;
    out.centroid = out.result.centroid = region.centroid;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(region.covariance);
    const Eigen::Vector3d& values = axes.eigenvalues();
    out.result.basis = axes.eigenvectors().rightCols<2>();
    out.result.plane.normal = axes.eigenvectors().col(0);
    out.result.plane.d = -out.result.plane.normal.dot(region.centroid);
    out.result.plane.orientTowardsOrigin();
    const double least = std::max(values[0], 0.0);
    out.spread = n * (values.tail<2>().array() - least).matrix().asDiagonal();
    return n >= FEWEST_POINTS && values.allFinite() &&
           values[1] > NARROWEST * NARROWEST * least &&
           values[1] > THINNEST * THINNEST * values[2];
  }

  void sum(const RegionInterior& region, Evidence& out)
  {
    std::fill(blocks_.begin(), blocks_.end(), Block());
    const PlaneFrame frame = frameOf(out);
    FrameSums all;
    for (const LabelRun& run : region.runs)
      sumBlocks(frame, run, out.result.plane, all);
    const double* s = all.sum;
    out.noise << s[FrameSums::WUU], s[FrameSums::WUV], s[FrameSums::WU],
        s[FrameSums::WUV], s[FrameSums::WVV], s[FrameSums::WV], s[FrameSums::WU],
        s[FrameSums::WV], s[FrameSums::W];
    compareBlocks(out);
  }

  /// Adds the points of a run, block by block.
  void sumBlocks(const PlaneFrame& frame, const LabelRun& run, const Plane& plane,
                 FrameSums& all)
  {
    const auto width = static_cast<std::size_t>(points_.width);
    const auto side = static_cast<std::size_t>(side_);
    const std::size_t row = run.begin / width;
    for (std::size_t i = run.begin; i < run.end;) {
      const std::size_t column = i - row * width;
      const std::size_t count = std::min(side - column % side, run.end - i);
      const FrameSums sums = sumRun(frame, i, count, plane);
      addBlock(sums, count,
               row / side * static_cast<std::size_t>(columns_) + column / side);
      for (std::size_t s = 0; s < FrameSums::COUNT; ++s)
        all.sum[s] += sums.sum[s];
      i += count;
    }
  }

  static PlaneFrame frameOf(const Evidence& evidence)
  {
    const Plane& plane = evidence.result.plane;
    const Eigen::Vector3d right = evidence.result.basis.col(0);
    const Eigen::Vector3d up = evidence.result.basis.col(1);
    return {{plane.normal.x(), plane.normal.y(), plane.normal.z()},
            plane.d,
            {right.x(), right.y(), right.z()},
            right.dot(evidence.centroid),
            {up.x(), up.y(), up.z()},
            up.dot(evidence.centroid),
            evidence.n / (evidence.n - 3.0), // three numbers were fitted
            LEAST_SIGMA * LEAST_SIGMA};
  }

  FrameSums sumRun(const PlaneFrame& frame, std::size_t i, std::size_t count,
                   const Plane& plane)
  {
    if (noise_.stated)
      for (std::size_t k = 0; k < count; ++k)
        stated_[k] = statedVariance(i + k, plane);
    return sumInFrame(frame, &points_.x[i], &points_.y[i], &points_.z[i],
                      noise_.stated ? stated_.data() : nullptr, count);
  }

  /// Variance along the normal: a ray of length |p| meets the plane at n . p = -d.
  double statedVariance(std::size_t i, const Plane& plane) const
  {
    const double depth =
        std::max(std::abs(static_cast<double>(points_.depth(i))), 1e-6);
    const double sigma = noise_.model.sigma(depth) * plane.d / depth;
    return sigma * sigma;
  }

  void addBlock(const FrameSums& sums, std::size_t count, std::size_t block_index)
  {
    Block& block = blocks_[block_index];
    block.n += static_cast<double>(count);
    block.u += sums.sum[FrameSums::U];
    block.v += sums.sum[FrameSums::V];
    block.distance += sums.sum[FrameSums::R];
    block.variance += sums.sum[FrameSums::W];
  }

  void compareBlocks(Evidence& out) const
  {
    for (const Block& b : blocks_) {
      if (b.n < FEWEST_IN_BLOCK)
        continue;
      const double leverage =
          (b.n / out.n) +
          (b.u * b.u / out.spread(0, 0) + b.v * b.v / out.spread(1, 1)) / b.n;
      const Eigen::Vector3d g = b.distance * Eigen::Vector3d(b.u / b.n, b.v / b.n, 1.0);
      out.shared += g * g.transpose() / std::max(1.0 - leverage, 0.5);
      if (leverage < LARGEST_LEVERAGE)
        out.ratios.push_back(b.distance * b.distance / (b.variance * (1.0 - leverage)));
    }
  }

  const OrganizedPoints& points_;
  const UncertaintyNoise& noise_;
  int side_;
  int columns_;
  std::vector<Block> blocks_;
  std::vector<double> stated_; ///< variances of the points at hand
};

/// Points per independent one of all regions, by the median: a few that are not flat have
/// no say.
double pooledCorrelation(const std::vector<Evidence>& all)
{
  std::vector<double> ratios;
  for (const Evidence& evidence : all)
    ratios.insert(ratios.end(), evidence.ratios.begin(), evidence.ratios.end());
  if (ratios.empty())
    return 1.0;
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::nth_element(ratios.begin(), middle, ratios.end());
  return *middle / MEDIAN_CHI_SQUARE;
}

double ownCorrelation(const Evidence& evidence, double pooled)
{
  double sum = POOLED_BLOCKS * pooled;
  for (const double ratio : evidence.ratios)
    sum += ratio;
  const double blocks = POOLED_BLOCKS + static_cast<double>(evidence.ratios.size());
  return std::max(1.0, sum / blocks);
}

/// Noise of the sums, at least what the blocks show: along the directions in which they are
/// off together by more than noise explains, as where points of other surfaces are among
/// them. Blocks as expected count beside a region's own, so that chance has little say.
Eigen::Matrix3d robustNoise(const Evidence& evidence, double correlation)
{
  Eigen::Matrix3d noise = correlation * evidence.noise;
  const Eigen::LLT<Eigen::Matrix3d> factor(noise);
  if (factor.info() != Eigen::Success)
    return noise;
  const Eigen::Matrix3d root = factor.matrixL();
  Eigen::Matrix3d ratio = factor.matrixL().solve(evidence.shared);
  ratio = factor.matrixL().solve(ratio.transpose()).eval();
  const auto blocks = static_cast<double>(evidence.ratios.size());
  ratio = (POOLED_BLOCKS * Eigen::Matrix3d::Identity() + blocks * ratio) /
          (POOLED_BLOCKS + blocks);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(ratio);
  if (!axes.eigenvalues().allFinite())
    return noise;
  const Eigen::Matrix3d directions = root * axes.eigenvectors();
  return directions * axes.eigenvalues().cwiseMax(1.0).asDiagonal() *
         directions.transpose();
}

/// d of (a, b, c, d) over d of (alpha, beta, delta).
Eigen::Matrix<double, 4, 3> jacobian(const Eigen::Matrix<double, 3, 2>& basis)
{
  Eigen::Matrix<double, 4, 3> j = Eigen::Matrix<double, 4, 3>::Zero();
  j.topLeftCorner<3, 2>() = basis;
  j(3, 2) = 1.0;
  return j;
}

/// Errors at the centroid as errors of the offset from the origin.
Eigen::Matrix3d toOrigin(const Eigen::Vector2d& centroid)
{
  Eigen::Matrix3d l = Eigen::Matrix3d::Identity();
  l.row(2).head<2>() = -centroid.transpose();
  return l;
}

/// Expected (alpha, beta) of the error. A point that the noise moves by e along the normal
/// moves by -e p / d along the plane (p from the sensor): the products no longer cancel.
/// Nothing where no sensor is so noisy: the points do not come along rays from the origin.
Eigen::Vector2d biasOf(const Evidence& evidence, const Eigen::Vector2d& centroid)
{
  const double d = evidence.result.plane.d;
  if (!(LARGEST_NOISE * d > std::sqrt(evidence.noise(2, 2) / evidence.n)))
    return Eigen::Vector2d::Zero();
  const Eigen::Vector2d moments =
      evidence.noise.topRightCorner<2, 1>() + evidence.noise(2, 2) * centroid;
  return evidence.spread.diagonal().cwiseInverse().cwiseProduct(moments) / d;
}

PlaneUncertainty finish(const Evidence& evidence, double pooled)
{
  PlaneUncertainty out = evidence.result;
  if (!out.valid) {
    const double infinite = std::numeric_limits<double>::infinity();
    out.minimal = Eigen::Vector3d::Constant(infinite).asDiagonal();
    out.at_centroid = out.minimal;
    out.covariance = Eigen::Vector4d::Constant(infinite).asDiagonal();
    return out;
  }
  out.points_per_independent = ownCorrelation(evidence, pooled);
  const Eigen::Vector2d centroid = out.basis.transpose() * evidence.centroid;
  const Eigen::Vector3d inverse(1.0 / evidence.spread(0, 0),
                                1.0 / evidence.spread(1, 1), 1.0 / evidence.n);
  const Eigen::Matrix3d noise = robustNoise(evidence, out.points_per_independent);
  out.at_centroid = inverse.asDiagonal() * noise * inverse.asDiagonal();
  Eigen::Vector3d bias = Eigen::Vector3d::Zero();
  bias.head<2>() = biasOf(evidence, centroid);
  const Eigen::Matrix3d l = toOrigin(centroid);
  const Eigen::Matrix<double, 4, 3> j = jacobian(out.basis);
  out.minimal = l * out.at_centroid * l.transpose();
  out.covariance = j * out.minimal * j.transpose();
  out.bias = j * (l * bias);
  return out;
}

} // namespace

Plane PlaneUncertainty::unbiased() const
{
  Plane result;
  const Eigen::Vector3d normal = plane.normal - bias.head<3>();
  result.normal = normal.normalized();
  result.d = (plane.d - bias[3]) / normal.norm();
  return result;
}

double PlaneUncertainty::squaredDistance(const Plane& other) const
{
  if (!valid)
    return 0.0;
  const Plane mine = unbiased();
  const double sign = mine.normal.dot(other.normal) < 0.0 ? -1.0 : 1.0;
  Eigen::Vector3d error;
  error.head<2>() = basis.transpose() * (sign * other.normal - mine.normal);
  error[2] = sign * other.distance(centroid) - mine.distance(centroid);
  return error.dot(at_centroid.ldlt().solve(error));
}

UncertaintyNoise UncertaintyNoise::of(const Parameters& parameters)
{
  UncertaintyNoise noise;
  noise.stated =
      parameters.method == Method::ADAPTIVE && !parameters.adaptive.estimate_noise;
  noise.model = parameters.noise;
  return noise;
}

std::vector<PlaneUncertainty>
planeUncertainties(const OrganizedPoints& points,
                   const std::vector<PlaneRegion>& regions,
                   const UncertaintyNoise& noise)
{
  RegionSums sums(points, noise);
  std::vector<Evidence> all;
  all.reserve(regions.size());
  const std::vector<RegionInterior> interiors = regionInteriors(points, regions);
  for (std::size_t k = 0; k < regions.size(); ++k)
    all.push_back(sums.add(regions[k], interiors[k]));
  const double pooled = pooledCorrelation(all);
  std::vector<PlaneUncertainty> result;
  result.reserve(all.size());
  for (const Evidence& evidence : all)
    result.push_back(finish(evidence, pooled));
  return result;
}

PlaneUncertainty inCloudFrame(const PlaneUncertainty& uncertainty,
                              const SensorPose& pose)
{
  PlaneUncertainty out = uncertainty;
  out.plane.normal = pose.rotation * uncertainty.plane.normal;
  out.plane.d = uncertainty.plane.d - out.plane.normal.dot(pose.origin);
  out.basis = pose.rotation * uncertainty.basis;
  out.centroid = pose.rotation * uncertainty.centroid + pose.origin;
  Eigen::Matrix4d move = Eigen::Matrix4d::Identity();
  move.topLeftCorner<3, 3>() = pose.rotation;
  move.row(3).head<3>() = -(pose.rotation.transpose() * pose.origin).transpose();
  out.bias = move * uncertainty.bias;
  if (!uncertainty.valid) // infinite: nothing to move
    return out;
  const Eigen::Matrix3d l = toOrigin(out.basis.transpose() * pose.origin);
  out.minimal = l * uncertainty.minimal * l.transpose();
  out.covariance = move * uncertainty.covariance * move.transpose();
  return out;
}

} // namespace pcl_mrf_planes
