// SPDX-License-Identifier: BSD-3-Clause
#include "reference/inputs.h"

#include <pcl_mrf_planes/plane_segmentation.h>
#include <pcl_mrf_planes/plane_uncertainty.h>
#include <pcl_mrf_planes/scatter_matrix.h>

#include <Eigen/Dense>
#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace pcl_mrf_planes {
namespace {

constexpr double CHI_SQUARE_3_95 = 7.815;

/// Noise of a preset along every ray of an exact picture.
OrganizedPoints withNoise(const scenes::SceneFrame& frame, const NoiseModel& noise,
                          scenes::Random& random)
{
  const bool pinhole = frame.camera.isPinhole();
  OrganizedPoints points;
  points.resize(frame.width, frame.height);
  points.depth_measure = pinhole ? DepthMeasure::OPTICAL_AXIS : DepthMeasure::RANGE;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d p(frame.x[i], frame.y[i], frame.z[i]);
    const double depth = pinhole ? p.z() : p.norm();
    const Eigen::Vector3d q = p * (1.0 + noise.sigma(depth) * random.normal() / depth);
    points.set(i, static_cast<float>(q.x()), static_cast<float>(q.y()),
               static_cast<float>(q.z()));
  }
  return points;
}

/// The truth's labels from 0, NO_PLANE for none.
std::vector<std::uint16_t> trueLabels(const scenes::SceneFrame& frame)
{
  std::vector<std::uint16_t> labels;
  for (const std::uint16_t label : frame.labels)
    labels.push_back(label == 0 ? NO_PLANE : static_cast<std::uint16_t>(label - 1));
  return labels;
}

Plane truePlane(const scenes::SceneFrame& frame, int label)
{
  const Eigen::Vector4d& abcd = frame.planes[static_cast<std::size_t>(label)];
  return {abcd.head<3>(), abcd[3]};
}

/// Regions of the true labels with planes of least squares.
std::vector<PlaneRegion> fitTrueRegions(const scenes::SceneFrame& frame,
                                        const OrganizedPoints& points, int least)
{
  const std::vector<std::uint16_t> labels = trueLabels(frame);
  std::vector<ScatterMatrix> sums(frame.planes.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points.valid[i] != 0 && labels[i] != NO_PLANE)
      sums[labels[i]].add(points.x[i], points.y[i], points.z[i]);
  std::vector<Plane> planes;
  for (const ScatterMatrix& sum : sums)
    planes.push_back(fitPlane(sum, PlaneFit::GEOMETRIC).plane);
  return gatherRegions(points, planes, labels, least);
}

/// How often the truth lies inside the ellipsoid.
struct Coverage {
  int inside = 0;
  int outside = 0;
  void count(double squared_distance)
  {
    ++(squared_distance < CHI_SQUARE_3_95 ? inside : outside);
  }
  int planes() const { return inside + outside; }
  double share() const { return inside / static_cast<double>(inside + outside); }
};

struct Case {
  std::string preset;
  bool stated;
};

std::vector<Case> cases()
{
  std::vector<Case> all;
  for (const std::string& name : NoiseModel::names())
    if (name != "none")
      for (const bool stated : {true, false})
        all.push_back({name, stated});
  return all;
}

class CoverageTest : public testing::TestWithParam<Case> {};

INSTANTIATE_TEST_SUITE_P(Presets, CoverageTest, testing::ValuesIn(cases()),
                         [](const auto& one) {
                           return one.param.preset +
                                  (one.param.stated ? "Stated" : "FromPoints");
                         });

scenes::SceneFrame exactPicture(const std::string& preset, std::uint64_t seed,
                                int width)
{
  scenes::View view = scenes::makeScene("room", seed);
  if (preset == "lidar")
    view.camera.makeLidar(2 * width, width / 2);
  else
    view.camera.resize(width, 3 * width / 4);
  return scenes::render(view.scene, view.camera);
}

TEST_P(CoverageTest, TruthLiesInsideTheEllipsoidAsOftenAsItShould)
{
  UncertaintyNoise noise;
  noise.stated = GetParam().stated;
  ASSERT_TRUE(NoiseModel::fromName(GetParam().preset, noise.model));
  scenes::Random random(17);
  Coverage coverage;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const scenes::SceneFrame frame = exactPicture(GetParam().preset, seed, 160);
    for (int run = 0; run < 20; ++run) {
      const OrganizedPoints points = withNoise(frame, noise.model, random);
      const auto regions = fitTrueRegions(frame, points, 60);
      const auto found = planeUncertainties(points, regions, noise);
      for (std::size_t k = 0; k < regions.size(); ++k)
        if (found[k].valid)
          coverage.count(found[k].squaredDistance(truePlane(frame, regions[k].label)));
    }
  }
  RecordProperty("planes", coverage.planes());
  RecordProperty("share", std::to_string(coverage.share()));
  EXPECT_GT(coverage.planes(), 600);
  EXPECT_NEAR(coverage.share(), 0.95, 0.025) << coverage.planes() << " planes";
}

/// The true plane that at least nine in ten points of a region lie on, or -1: others have
/// become one region with a part of another plane.
int trueLabel(const scenes::SceneFrame& frame, const PlaneRegion& region)
{
  std::vector<std::size_t> votes(frame.planes.size() + 1, 0);
  for (const int i : region.indices)
    ++votes[frame.labels[static_cast<std::size_t>(i)]];
  for (std::size_t k = 1; k < votes.size(); ++k)
    if (10 * votes[k] >= 9 * region.indices.size())
      return static_cast<int>(k) - 1;
  return -1;
}

TEST_P(CoverageTest, HoldsForPlanesThatTheDefaultProfileFinds)
{
  Parameters parameters;
  ASSERT_TRUE(NoiseModel::fromName(GetParam().preset, parameters.noise));
  parameters.adaptive.estimate_noise = !GetParam().stated;
  scenes::Random random(18);
  Coverage coverage;
  Coverage biased;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const scenes::SceneFrame frame = exactPicture(GetParam().preset, seed, 320);
    for (int run = 0; run < 4; ++run) {
      const OrganizedPoints points = withNoise(frame, parameters.noise, random);
      const auto regions = segmentPlanes(points, parameters).regions;
      const auto found =
          planeUncertainties(points, regions, UncertaintyNoise::of(parameters));
      for (std::size_t k = 0; k < regions.size(); ++k)
        if (const int label = trueLabel(frame, regions[k]);
            label >= 0 && found[k].valid) {
          coverage.count(found[k].squaredDistance(truePlane(frame, label)));
          PlaneUncertainty raw = found[k];
          raw.bias.setZero();
          biased.count(raw.squaredDistance(truePlane(frame, label)));
        }
    }
  }
  RecordProperty("planes", coverage.planes());
  RecordProperty("share", std::to_string(coverage.share()));
  RecordProperty("share_biased", std::to_string(biased.share()));
  EXPECT_GT(coverage.planes(), 250);
  EXPECT_NEAR(coverage.share(), 0.96, 0.03) << coverage.planes() << " planes";
  EXPECT_GT(coverage.share(), biased.share()) << "the bias is worth subtracting";
}

/// A wall seen obliquely, with independent noise that grows with the depth.
class WallTest : public testing::Test {
protected:
  WallTest()
  {
    scenes::View view = scenes::singlePlane(2.0, 0.7);
    view.camera.resize(96, 72);
    frame_ = scenes::render(view.scene, view.camera);
  }

  PlaneUncertainty find(const OrganizedPoints& points) const
  {
    return planeUncertainties(points, fitTrueRegions(frame_, points, 1), noise_)[0];
  }

  scenes::SceneFrame frame_;
  UncertaintyNoise noise_ = {true, NoiseModel::kinect()};
  scenes::Random random_{5};
};

TEST_F(WallTest, CovarianceIsThatOfManyMeasurements)
{
  constexpr int RUNS = 1500;
  const Plane truth = truePlane(frame_, 0);
  Eigen::Vector4d mean = Eigen::Vector4d::Zero();
  Eigen::Matrix4d square = Eigen::Matrix4d::Zero();
  Eigen::Matrix4d stated = Eigen::Matrix4d::Zero();
  Eigen::Vector4d bias = Eigen::Vector4d::Zero();
  for (int run = 0; run < RUNS; ++run) {
    const PlaneUncertainty found = find(withNoise(frame_, noise_.model, random_));
    Eigen::Vector4d error;
    error << found.plane.normal - truth.normal, found.plane.d - truth.d;
    mean += error / RUNS;
    square += error * error.transpose() / RUNS;
    stated += found.covariance / found.points_per_independent / RUNS;
    bias += found.bias / RUNS;
  }
  const Eigen::Matrix4d measured = square - mean * mean.transpose();
  EXPECT_LT((stated - measured).norm(), 0.12 * measured.norm()) << stated << "\n\n"
                                                                << measured;
  const double deviation = std::sqrt(measured.trace());
  const double chance = 5.0 * deviation / std::sqrt(RUNS);
  EXPECT_LT((bias - mean).norm(), chance);
  EXPECT_GT(mean.norm(), 2.0 * chance)
      << "a wall with a bias that can be told from noise";
}

TEST_F(WallTest, FourNumbersHaveThreeDegreesOfFreedom)
{
  const PlaneUncertainty found = find(withNoise(frame_, noise_.model, random_));
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> axes(found.covariance);
  EXPECT_LT(std::abs(axes.eigenvalues()[0]), 1e-9 * axes.eigenvalues()[3]);
  EXPECT_GT(axes.eigenvalues()[1], 1e-6 * axes.eigenvalues()[3]);
  EXPECT_LT((found.covariance.topLeftCorner<3, 3>() * found.plane.normal).norm(),
            1e-9 * axes.eigenvalues()[3])
      << "a unit normal cannot change along itself";
  EXPECT_LT(
      (found.basis.transpose() * found.basis - Eigen::Matrix2d::Identity()).norm(),
      1e-12);
  EXPECT_LT((found.basis.transpose() * found.plane.normal).norm(), 1e-12);
}

TEST_F(WallTest, TwiceTheNoiseIsFourTimesTheVariance)
{
  const OrganizedPoints points = withNoise(frame_, NoiseModel::fixed(0.001), random_);
  noise_.model = NoiseModel::fixed(0.01);
  const PlaneUncertainty once = find(points);
  noise_.model = NoiseModel::fixed(0.02);
  const PlaneUncertainty twice = find(points);
  EXPECT_LT((twice.minimal - 4.0 * once.minimal).norm(), 1e-5 * twice.minimal.norm());
  EXPECT_EQ(once.points_per_independent, 1.0) << "less noise than stated";
}

TEST_F(WallTest, DistancesDoNotDependOnTheFrame)
{
  const PlaneUncertainty found = find(withNoise(frame_, noise_.model, random_));
  SensorPose pose;
  pose.rotation =
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  pose.origin = Eigen::Vector3d(10, -20, 5);
  const PlaneUncertainty moved = inCloudFrame(found, pose);
  const Plane truth = truePlane(frame_, 0);
  Plane moved_truth;
  moved_truth.normal = pose.rotation * truth.normal;
  moved_truth.d = truth.d - moved_truth.normal.dot(pose.origin);
  const double here = found.squaredDistance(truth);
  EXPECT_NEAR(moved.squaredDistance(moved_truth), here, 0.02 * (1 + here));
  Eigen::Matrix<double, 4, 3> j = Eigen::Matrix<double, 4, 3>::Zero();
  j.topLeftCorner<3, 2>() = moved.basis;
  j(3, 2) = 1;
  EXPECT_LT((j * moved.minimal * j.transpose() - moved.covariance).norm(),
            1e-9 * moved.covariance.norm())
      << "both forms say the same";
}

/// Noise that the points of squares of 4x4 share.
OrganizedPoints withBlotches(const scenes::SceneFrame& frame, double sigma,
                             scenes::Random& random)
{
  constexpr int SIDE = 4;
  const int columns = frame.width / SIDE + 1;
  std::vector<double> error;
  for (int k = 0; k < columns * (frame.height / SIDE + 1); ++k)
    error.push_back(sigma * random.normal());
  OrganizedPoints points = reference::toPoints(frame);
  for (int y = 0; y < frame.height; ++y)
    for (int x = 0; x < frame.width; ++x) {
      const auto i = static_cast<std::size_t>(y * frame.width + x);
      const double e = error[static_cast<std::size_t>(y / SIDE * columns + x / SIDE)];
      const auto f = static_cast<float>(1 + e / frame.z[i]);
      points.set(i, frame.x[i] * f, frame.y[i] * f, frame.z[i] * f);
    }
  return points;
}

TEST_F(WallTest, NoiseThatNeighboursShareIsAllowedFor)
{
  Coverage coverage;
  double points_per_independent = 0;
  for (int run = 0; run < 400; ++run) {
    noise_.stated = run % 2 == 0;
    noise_.model = NoiseModel::fixed(0.01);
    const PlaneUncertainty found = find(withBlotches(frame_, 0.01, random_));
    coverage.count(found.squaredDistance(truePlane(frame_, 0)));
    points_per_independent += found.points_per_independent / 400;
  }
  EXPECT_NEAR(points_per_independent, 16.0, 3.0) << "squares of 16 points";
  EXPECT_GT(coverage.share(), 0.90);
}

TEST(UncertaintyNoiseTest, IsStatedWhereTheDefaultProfileDoesNotEstimateIt)
{
  Parameters parameters;
  parameters.noise = NoiseModel::fixed(0.02);
  for (const Method method : {Method::ADAPTIVE, Method::PAPER})
    for (const bool estimates : {true, false}) {
      parameters.method = method;
      parameters.adaptive.estimate_noise = estimates;
      const UncertaintyNoise noise = UncertaintyNoise::of(parameters);
      EXPECT_EQ(noise.stated, method == Method::ADAPTIVE && !estimates);
      EXPECT_EQ(noise.model.sigma(3.0), 0.02);
    }
}

TEST(PlaneUncertaintyTest, PointsThatAreNoPlaneSaySo)
{
  OrganizedPoints points;
  points.resize(40, 2);
  for (std::size_t i = 0; i < 40; ++i)
    points.set(i, static_cast<float>(i) * 0.01f, 0.0f, 1.0f); // a line
  const std::vector<Plane> planes = {{{0, 0, -1}, 1}, {{0, 0, -1}, 1}};
  std::vector<std::uint16_t> labels(points.size(), 0);
  for (std::size_t i = 1; i < 3; ++i)
    labels[i] = 1; // two points
  const auto regions = gatherRegions(points, planes, labels, 0);
  ASSERT_EQ(regions.size(), 2U);
  for (const PlaneUncertainty& found : planeUncertainties(points, regions)) {
    EXPECT_FALSE(found.valid);
    EXPECT_TRUE(std::isinf(found.minimal(0, 0)) && std::isinf(found.covariance(3, 3)));
    EXPECT_EQ(found.minimal(0, 1), 0.0);
    EXPECT_EQ(found.squaredDistance({{1, 0, 0}, 5}), 0.0) << "no plane is ruled out";
    SensorPose pose;
    pose.rotation = Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitY()).toRotationMatrix();
    pose.origin = Eigen::Vector3d(1, 2, 3);
    const PlaneUncertainty moved = inCloudFrame(found, pose);
    EXPECT_FALSE(moved.valid);
    EXPECT_EQ(moved.minimal, found.minimal) << "infinity has no other frame";
    EXPECT_EQ(moved.covariance, found.covariance);
    EXPECT_NEAR(moved.plane.distance(pose.rotation * found.centroid + pose.origin),
                found.plane.distance(found.centroid), 1e-9);
  }
  EXPECT_TRUE(planeUncertainties(points, {}).empty());
}

TEST(PlaneUncertaintyTest, APlaneThroughTheSensorHasAFiniteOne)
{
  scenes::Random random(7);
  OrganizedPoints points;
  points.resize(40, 30);
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x)
      points.set(
          static_cast<std::size_t>(40 * y + x), // edge-on, as depth images have none
          static_cast<float>(0.001 * random.normal()), 0.01f * static_cast<float>(y),
          1 + 0.01f * static_cast<float>(x));
  const std::vector<std::uint16_t> labels(points.size(), 0);
  const auto regions = gatherRegions(points, {{{-1, 0, 0}, 0}}, labels, 0);
  ASSERT_EQ(regions.size(), 1U);
  const PlaneUncertainty found = planeUncertainties(points, regions)[0];
  ASSERT_TRUE(found.valid);
  EXPECT_TRUE(found.minimal.allFinite() && found.covariance.allFinite());
  EXPECT_LT(found.squaredDistance({{1, 0, 0}, 0}), 16.0)
      << "the truth is not ruled out";
  EXPECT_GT(found.squaredDistance({{1, 0, 0}, 0.1}), 100.0) << "one 10 cm off is";
}

TEST(PlaneUncertaintyTest, ExactPointsHaveLittleButNotNone)
{
  scenes::View view = scenes::singlePlane();
  view.camera.resize(64, 48);
  const auto frame = scenes::render(view.scene, view.camera);
  const OrganizedPoints points = reference::toPoints(frame);
  const auto found = planeUncertainties(points, fitTrueRegions(frame, points, 0));
  ASSERT_TRUE(found[0].valid);
  EXPECT_GT(found[0].minimal(2, 2), 0.0) << "floats are not exact";
  EXPECT_LT(std::sqrt(found[0].minimal(2, 2)), 1e-6);
}

} // namespace
} // namespace pcl_mrf_planes
