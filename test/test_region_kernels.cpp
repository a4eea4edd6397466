// SPDX-License-Identifier: BSD-3-Clause
//
// What makes the analysis of regions fast, beside plain loops over points and corners.
#include "reference/inputs.h"
#include "reference/ray_images.h"

#include "adaptive/label_gap_kernel.h"
#include "label_runs.h"
#include "line_simplification.h"
#include "plane_uncertainty_kernel.h"
#include "polygon_simplification.h"
#include "thread_team.h"

#include <pcl_mrf_planes/label_confidence.h>
#include <pcl_mrf_planes/plane_projection.h>

#define BOOST_GEOMETRY_NO_ROBUSTNESS
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/linestring.hpp>
#include <boost/geometry/geometries/multi_point.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>

#include <gtest/gtest.h>

#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace pcl_mrf_planes {
namespace {

namespace bg = boost::geometry;
using BoostPoint = bg::model::d2::point_xy<double>;

/// Calls work() once for each instruction set that this machine and the library have.
template <typename Work>
void forEachInstructionSet(const Work& work)
{
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    SCOPED_TRACE(hwy::TargetName(target));
    work();
  }
  hwy::SetSupportedTargetsForTest(0);
}

/// Number of the 4-connected part of each point, in the order of their first points, by plain
/// flooding; -1 for the background.
std::vector<int> floodedParts(const std::vector<std::uint16_t>& labels, int width)
{
  const int size = static_cast<int>(labels.size());
  std::vector<int> part(labels.size(), -1);
  int count = 0;
  for (int seed = 0; seed < size; ++seed) {
    const auto label = labels[static_cast<std::size_t>(seed)];
    if (label == 0 || part[static_cast<std::size_t>(seed)] >= 0)
      continue;
    std::vector<int> open = {seed};
    while (!open.empty()) {
      const int i = open.back();
      open.pop_back();
      if (labels[static_cast<std::size_t>(i)] != label ||
          part[static_cast<std::size_t>(i)] >= 0)
        continue;
      part[static_cast<std::size_t>(i)] = count;
      if (i % width > 0)
        open.push_back(i - 1);
      if ((i + 1) % width > 0)
        open.push_back(i + 1);
      if (i >= width)
        open.push_back(i - width);
      if (i + width < size)
        open.push_back(i + width);
    }
    ++count;
  }
  return part;
}

TEST(LabelRunsTest, ConnectedPartsAreThoseOfAPlainFloodAtAnyNumberOfThreads)
{
  const ThreadTeam team(4);
  scenes::Random random(2);
  for (int run = 0; run < 300; ++run) {
    const int width = random.integer(1, 40);
    const int height = random.integer(1, 40);
    const int most = random.integer(1, 3);
    std::vector<std::uint16_t> labels(static_cast<std::size_t>(width * height));
    for (auto& label : labels)
      label = static_cast<std::uint16_t>(random.integer(0, most));
    const std::vector<int> expected = floodedParts(labels, width);
    for (const unsigned int threads : {1U, 4U}) {
      SCOPED_TRACE(std::to_string(width) + "x" + std::to_string(height) + ", " +
                   std::to_string(threads) + " threads");
      const LabelRuns image = findRuns(labels, width, 0, threads);
      const RunParts parts = connectRuns(image, threads);
      std::vector<int> found(labels.size(), -1);
      std::vector<int> size(parts.size.size(), 0);
      for (std::size_t k = 0; k < image.runs.size(); ++k)
        for (std::size_t i = image.runs[k].begin; i < image.runs[k].end; ++i) {
          found[i] = parts.part_of_run[k];
          ++size[static_cast<std::size_t>(found[i])];
        }
      ASSERT_EQ(found, expected);
      EXPECT_TRUE(std::equal(size.begin(), size.end(), parts.size.begin()));
    }
  }
}

TEST(RegionRunsTest, AreThoseOfTheLabelImage)
{
  scenes::Random random(1);
  for (int run = 0; run < 100; ++run) {
    const auto input = reference::raggedPoints(random, false);
    const OrganizedPoints& points = input.points;
    const auto regions = gatherRegions(points, input.planes, input.labels, 0);
    std::vector<std::uint16_t> plain(points.size(), 0);
    for (std::size_t k = 0; k < regions.size(); ++k)
      for (const int i : regions[k].indices)
        plain[static_cast<std::size_t>(i)] = static_cast<std::uint16_t>(k + 1);
    EXPECT_EQ(regionLabels(points, regions), plain);
    const LabelRuns expected = findRuns(plain, points.width, 0);
    const LabelRuns found = regionRuns(regions, points.width, points.height);
    ASSERT_EQ(found.rows, expected.rows);
    ASSERT_EQ(found.runs.size(), expected.runs.size());
    for (std::size_t k = 0; k < found.runs.size(); ++k) {
      EXPECT_EQ(found.runs[k].begin, expected.runs[k].begin);
      EXPECT_EQ(found.runs[k].end, expected.runs[k].end);
      EXPECT_EQ(found.runs[k].label, expected.runs[k].label);
    }
  }
}

TEST(RegionRunsTest, SuccessorsAreCountedAsOneByOne)
{
  scenes::Random random(2);
  std::vector<int> numbers = {0};
  while (numbers.size() < 2000)
    numbers.push_back(numbers.back() + (random.uniform(0, 1) < 0.05 ? 2 : 1));
  for (std::size_t k = 0; k < numbers.size(); ++k)
    for (const std::size_t most : {1U, 2U, 7U, 40U, 3000U}) {
      std::size_t expected = 1;
      while (expected < most && k + expected < numbers.size() &&
             numbers[k + expected] == numbers[k] + static_cast<int>(expected))
        ++expected;
      ASSERT_EQ(countSuccessors(numbers, k, most), expected);
    }
}

/// A ragged border, some of its corners the same.
FlatRing raggedRing(scenes::Random& random, int corners)
{
  FlatRing ring;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * M_PI * k / corners;
    const double radius = random.uniform(0.8, 1.2);
    ring.emplace_back(std::round(20 * radius * std::cos(angle)) / 10,
                      std::round(20 * radius * std::sin(angle)) / 10);
  }
  return ring;
}

TEST(LineSimplificationTest, KeepsTheCornersThatBoostKeeps)
{
  scenes::Random random(3);
  for (int run = 0; run < 300; ++run) {
    const FlatRing ring = raggedRing(random, random.integer(2, 150));
    const double tolerance = run % 4 == 0 ? 0.0 : random.uniform(0.001, 0.5);
    bg::model::linestring<BoostPoint> line;
    FlatLine mine;
    for (const Eigen::Vector2d& corner : ring) {
      line.emplace_back(corner.x(), corner.y());
      mine.x.push_back(corner.x());
      mine.y.push_back(corner.y());
    }
    bg::model::linestring<BoostPoint> expected;
    bg::simplify(line, expected, tolerance);
    forEachInstructionSet([&] {
      std::vector<std::uint8_t> kept(ring.size(), 0);
      keepCorners(mine, 0, ring.size() - 1, tolerance, kept);
      std::size_t at = 0;
      for (std::size_t k = 0; k < ring.size(); ++k)
        if (kept[k] != 0 && at < expected.size()) {
          EXPECT_EQ(ring[k].x(), expected[at].x());
          EXPECT_EQ(ring[k].y(), expected[at].y());
          ++at;
        }
      EXPECT_EQ(at, expected.size());
    });
  }
}

TEST(ConvexHullTest, IsTheOneOfAllCorners)
{
  scenes::Random random(4);
  for (int run = 0; run < 300; ++run) {
    FlatRing corners = raggedRing(random, random.integer(1, 200));
    if (run % 5 == 0) // a line has no inside
      for (Eigen::Vector2d& corner : corners)
        corner.y() = 2 * corner.x();
    bg::model::multi_point<BoostPoint> all;
    for (const Eigen::Vector2d& corner : corners)
      all.emplace_back(corner.x(), corner.y());
    bg::model::polygon<BoostPoint, false> expected;
    bg::convex_hull(all, expected);
    const FlatRing hull = convexHull(corners);
    ASSERT_EQ(hull.size() + 1, expected.outer().size());
    for (std::size_t k = 0; k < hull.size(); ++k) {
      EXPECT_EQ(hull[k].x(), expected.outer()[k].x());
      EXPECT_EQ(hull[k].y(), expected.outer()[k].y());
    }
  }
}

/// Coordinates of some points, as the kernels take them.
struct Coordinates {
  std::vector<float> x, y, z;
};

Coordinates randomCoordinates(scenes::Random& random, std::size_t count)
{
  Coordinates out;
  for (std::size_t k = 0; k < count; ++k) {
    out.x.push_back(static_cast<float>(random.uniform(-2, 2)));
    out.y.push_back(static_cast<float>(random.uniform(-2, 2)));
    out.z.push_back(static_cast<float>(random.uniform(0.5, 4)));
  }
  return out;
}

TEST(FrameSumsTest, AreTheMomentsOfThePoints)
{
  scenes::Random random(5);
  for (std::size_t count = 1; count < 70; ++count) {
    const Coordinates p = randomCoordinates(random, count);
    const PlaneFrame frame = {{0.6, 0, 0.8}, 0.3, {0.8, 0, -0.6}, 0.1,
                              {0, 1, 0},     0.2, 1.25,           1e-3};
    std::vector<double> variance;
    for (std::size_t k = 0; k < count; ++k)
      variance.push_back(random.uniform(0, 1));
    for (const bool given : {false, true}) {
      double expected[FrameSums::COUNT] = {};
      for (std::size_t k = 0; k < count; ++k) {
        const double u = 0.8 * p.x[k] - 0.6 * p.z[k] - 0.1;
        const double v = p.y[k] - 0.2;
        const double r = 0.6 * p.x[k] + 0.8 * p.z[k] + 0.3;
        const double range =
            std::pow(p.x[k], 2) + std::pow(p.y[k], 2) + std::pow(p.z[k], 2);
        const double w = (given ? variance[k] : 1.25 * r * r) + 1e-3 * range;
        const double terms[] = {u,     v,         r,         w,        w * u,
                                w * v, w * u * u, w * u * v, w * v * v};
        for (std::size_t s = 0; s < FrameSums::COUNT; ++s)
          expected[s] += terms[s];
      }
      const auto sums = [&] {
        return sumInFrame(frame, p.x.data(), p.y.data(), p.z.data(),
                          given ? variance.data() : nullptr, count);
      };
      const FrameSums best = sums();
      forEachInstructionSet([&] {
        const FrameSums found = sums();
        for (std::size_t s = 0; s < FrameSums::COUNT; ++s) {
          EXPECT_NEAR(found.sum[s], expected[s], 1e-11 * static_cast<double>(count));
          EXPECT_EQ(found.sum[s], best.sum[s]) << "other bits";
        }
      });
    }
  }
}

TEST(ProjectPointsTest, AreProjectedAsOneByOne)
{
  scenes::Random random(6);
  for (const ProjectionWay way : {ProjectionWay::NORMAL, ProjectionWay::RAY})
    for (std::size_t stride = 3; stride < 9; ++stride) {
      const Plane plane = reference::randomPlane(random);
      const Eigen::Vector3d origin(0.1, -0.2, 0.3);
      std::vector<float> cloud;
      for (std::size_t k = 0; k < 200 * stride; ++k)
        cloud.push_back(static_cast<float>(random.uniform(-2, 2)));
      std::vector<int> indices;
      for (int k = 0; k < 200; ++k)
        if (random.uniform(0, 1) < 0.7)
          indices.push_back(k);
      std::vector<float> expected = cloud;
      for (const int k : indices) {
        float* p = &expected[static_cast<std::size_t>(k) * stride];
        const Eigen::Vector3d q =
            projectPoint(Eigen::Vector3d(p[0], p[1], p[2]) - origin, plane, way) +
            origin;
        for (int axis = 0; axis < 3; ++axis)
          p[axis] = static_cast<float>(q[axis]);
      }
      forEachInstructionSet([&] {
        std::vector<float> found = cloud;
        projectPoints(plane, origin, way, indices, stride, found.data());
        for (std::size_t k = 0; k < cloud.size(); ++k)
          ASSERT_FLOAT_EQ(found[k], expected[k]) << "number " << k;
      });
    }
}

/// Eight points in the middle of some of other labels.
struct GapInput {
  Coordinates points;
  std::uint16_t labels[3][10]; ///< above, here, below; from the left neighbour on
  float right[9], above[8], below[8];
  std::vector<adaptive::GapCandidate> candidates;
};

GapInput randomGaps(scenes::Random& random)
{
  GapInput in;
  in.points = randomCoordinates(random, 8);
  const int labels = random.integer(1, 4);
  const bool same = random.uniform(0, 1) < 0.3;
  const int one = random.integer(0, labels - 1);
  for (auto& row : in.labels)
    for (std::uint16_t& label : row)
      label = static_cast<std::uint16_t>(same ? one : random.integer(0, labels - 1));
  const auto price = [&] { return static_cast<float>(random.uniform(0, 3)); };
  std::generate(std::begin(in.right), std::end(in.right), price);
  std::generate(std::begin(in.above), std::end(in.above), price);
  std::generate(std::begin(in.below), std::end(in.below), price);
  in.candidates.emplace_back();
  for (int l = 1; l < labels; ++l) {
    const Plane plane = reference::randomPlane(random);
    in.candidates.push_back(
        {static_cast<std::uint16_t>(l), static_cast<float>(plane.normal.x()),
         static_cast<float>(plane.normal.y()), static_cast<float>(plane.normal.z()),
         static_cast<float>(plane.d), price()});
  }
  return in;
}

/// The least cost of another label less that of its own, neighbours as they are.
double plainGap(const GapInput& in, const adaptive::GapCosts& costs, std::size_t k)
{
  const std::uint16_t others[] = {in.labels[1][k], in.labels[1][k + 2],
                                  in.labels[0][k + 1], in.labels[2][k + 1]};
  const double prices[] = {in.right[k], in.right[k + 1], in.above[k], in.below[k]};
  const std::uint16_t mine = in.labels[1][k + 1];
  double own = costs.most;
  double least = std::numeric_limits<float>::max();
  if (mine == 0) // a plane that was not found costs no less
    least = costs.none + prices[0] + prices[1] + prices[2] + prices[3];
  for (const adaptive::GapCandidate& c : in.candidates) {
    const double distance = std::abs(c.a * in.points.x[k] + c.b * in.points.y[k] +
                                     c.c * in.points.z[k] + c.d);
    double cost = c.label == 0 ? static_cast<double>(costs.none)
                               : std::min<double>(distance * c.per_sigma, costs.most);
    for (std::size_t n = 0; n < 4; ++n)
      cost += others[n] == c.label ? 0.0 : prices[n];
    if (c.label == mine)
      own = cost;
    else
      least = std::min(least, cost);
  }
  return std::max(0.0, least - own);
}

TEST(LabelGapTest, IsWhatTheSecondBestLabelCostsMore)
{
  scenes::Random random(7);
  const adaptive::GapCosts costs = {1.5f, 4.5f};
  for (int run = 0; run < 2000; ++run) {
    const GapInput in = randomGaps(random);
    const adaptive::GapRow row = {
        in.points.x.data(), in.points.y.data(), in.points.z.data(),
        in.labels[1] + 1,   in.labels[0] + 1,   in.labels[2] + 1,
        in.right + 1,       in.above,           in.below};
    forEachInstructionSet([&] {
      float gaps[8];
      gapsOfEight(costs, row, in.candidates.data(), in.candidates.size(), gaps);
      for (std::size_t k = 0; k < 8; ++k) {
        const double expected = plainGap(in, costs, k);
        ASSERT_NEAR(gaps[k], expected, 2e-5) << "point " << k << " of run " << run;
      }
    });
  }
}

TEST(LabelGapTest, SharesAreThoseOfTheExponential)
{
  std::vector<float> gaps;
  for (int k = 0; k < 1001; ++k)
    gaps.push_back(0.05f * static_cast<float>(k));
  gaps.push_back(std::numeric_limits<float>::max());
  std::vector<std::uint8_t> valid(gaps.size(), 1);
  valid[17] = 0;
  forEachInstructionSet([&] {
    for (const adaptive::GapExponent& exponent :
         {adaptive::GapExponent{0.7f, 0.0f}, {0.0f, 0.06f}, {0.2f, 0.01f}}) {
      std::vector<float> shares = gaps;
      adaptive::gapsToShares(exponent, valid.data(), gaps.size(), shares.data());
      for (std::size_t k = 0; k < gaps.size(); ++k) {
        const double gap = gaps[k];
        const double x = gap * (exponent.linear + exponent.squared * gap);
        const double expected = valid[k] == 0 ? 0.0 : -std::expm1(-x);
        ASSERT_NEAR(shares[k], expected, 1e-6) << "gap " << gap;
        ASSERT_TRUE(shares[k] >= 0.0f && shares[k] <= 1.0f);
      }
    }
  });
}

TEST(LabelGapTest, NoiseThatIsKeptIsTheNoiseThatIsFound)
{
  const OrganizedPoints points = reference::toPoints(
      reference::takePicture("room", 157, 121, 3, scenes::SensorNoise::kinect()));
  for (const bool estimated : {true, false}) {
    Parameters parameters;
    parameters.adaptive.estimate_noise = estimated; // false: a Kinect's is stated
    PlaneSegmentation result = segmentPlanes(points, parameters);
    ASSERT_GT(result.regions.size(), 2U);
    ASSERT_NE(result.block_noise, nullptr);
    const std::vector<float> expected = labelConfidence(points, result, parameters);
    result.block_noise.reset();
    EXPECT_EQ(labelConfidence(points, result, parameters), expected) << estimated;
  }
}

} // namespace
} // namespace pcl_mrf_planes
