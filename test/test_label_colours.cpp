// SPDX-License-Identifier: BSD-3-Clause
//
// What colours of labels promise: distinct, never gray, seen by everybody, and kept from
// frame to frame.
#include "colour_track.h"
#include "colour_vision.h"
#include "label_colours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

namespace pcl_mrf_planes::apps {
namespace {

constexpr Rgb WHITE = {255, 255, 255};
constexpr Rgb BLACK = {0, 0, 0};

double smallestDistance(std::uint32_t labels, Vision vision)
{
  double smallest = std::numeric_limits<double>::max();
  for (std::uint32_t p = 0; p <= labels; ++p) // with the gray of no plane
    for (std::uint32_t q = 0; q < p; ++q)
      smallest = std::min(smallest, distance(seenAs(labelColour(p), vision),
                                             seenAs(labelColour(q), vision)));
  return smallest;
}

double contrast(const Rgb& p, const Rgb& q)
{
  const double lighter = std::max(luminance(p), luminance(q));
  const double darker = std::min(luminance(p), luminance(q));
  return (lighter + 0.05) / (darker + 0.05);
}

TEST(ColourVisionTest, OklabHasItsPublishedValues)
{
  const Oklab white = seenAs(WHITE, Vision::NORMAL);
  EXPECT_NEAR(white.l, 1.0, 1e-4);
  EXPECT_NEAR(std::hypot(white.a, white.b), 0.0, 1e-4);
  const Oklab red = seenAs({255, 0, 0}, Vision::NORMAL);
  EXPECT_NEAR(red.l, 0.62796, 1e-4);
  EXPECT_NEAR(red.a, 0.22486, 1e-4);
  EXPECT_NEAR(red.b, 0.12585, 1e-4);
}

TEST(ColourVisionTest, GraysStayGraysForEverybody)
{
  for (const Vision vision : VISIONS)
    for (const int gray : {0, 60, 128, 200, 255}) {
      const auto level = static_cast<std::uint8_t>(gray);
      const Oklab seen = seenAs({level, level, level}, vision);
      EXPECT_LT(std::hypot(seen.a, seen.b), 0.002) << "gray " << gray;
    }
}

TEST(ColourVisionTest, DichromatsConfuseWhatTheyShould)
{
  const Rgb red = {200, 60, 40};
  const Rgb green = {110, 120, 40};
  const double normal =
      distance(seenAs(red, Vision::NORMAL), seenAs(green, Vision::NORMAL));
  const double deutan =
      distance(seenAs(red, Vision::DEUTERANOPIA), seenAs(green, Vision::DEUTERANOPIA));
  EXPECT_LT(deutan, 0.5 * normal);
}

TEST(LabelColoursTest, EveryLabelOfAnImageHasItsOwn)
{
  std::set<Rgb> colours;
  for (std::uint32_t label = 0; label < MOST_COLOURS; ++label)
    colours.insert(labelColour(label));
  EXPECT_EQ(colours.size(), MOST_COLOURS);
  EXPECT_NO_THROW(labelColour(std::numeric_limits<std::uint32_t>::max()));
}

TEST(LabelColoursTest, FewPlanesAreFarApartForEverybody)
{
  // At 0.02 two colours side by side can just be told apart.
  struct Case {
    std::uint32_t labels;
    double normal, red_green, tritan; ///< distances at least
  };
  for (const Case& c : {Case{2, 0.3, 0.17, 0.2}, Case{4, 0.25, 0.14, 0.13},
                        Case{8, 0.16, 0.09, 0.07}, Case{16, 0.11, 0.06, 0.05},
                        Case{32, 0.075, 0.04, 0.028}, Case{64, 0.05, 0.027, 0.02}}) {
    EXPECT_GE(smallestDistance(c.labels, Vision::NORMAL), c.normal) << c.labels;
    EXPECT_GE(smallestDistance(c.labels, Vision::PROTANOPIA), c.red_green) << c.labels;
    EXPECT_GE(smallestDistance(c.labels, Vision::DEUTERANOPIA), c.red_green)
        << c.labels;
    EXPECT_GE(smallestDistance(c.labels, Vision::TRITANOPIA), c.tritan) << c.labels;
  }
}

TEST(LabelColoursTest, NoPlaneIsTheOnlyGray)
{
  const Oklab none = seenAs(labelColour(0), Vision::NORMAL);
  EXPECT_LT(std::hypot(none.a, none.b), 0.002);
  for (std::uint32_t label = 1; label < 2000; ++label) {
    const Oklab seen = seenAs(labelColour(label), Vision::NORMAL);
    EXPECT_GT(std::hypot(seen.a, seen.b), 0.075) << "label " << label;
  }
}

TEST(LabelColoursTest, AllAreReadableOnDarkAndOnLight)
{
  for (std::uint32_t label = 1; label < 2000; ++label) {
    EXPECT_GE(contrast(labelColour(label), BLACK), 3.0) << "label " << label;
    EXPECT_GE(contrast(labelColour(label), WHITE), 1.7) << "label " << label;
  }
}

Plane plane(double x, double y, double z, double d)
{
  return {Eigen::Vector3d(x, y, z).normalized(), d};
}

TEST(ColourTrackTest, FirstPlanesAreNumberedInTheirOrder)
{
  ColourTrack track;
  const auto numbers = track.update(
      {plane(0, 0, -1, 2), plane(0, -1, 0, 1), plane(1, 0, 0, 1)}, {1, 1, 2, 3});
  EXPECT_EQ(numbers, (std::vector<std::uint32_t>{1, 2, 3}));
}

TEST(ColourTrackTest, AWallKeepsItsNumberWhenTheOrderTurnsAround)
{
  ColourTrack track;
  track.update({plane(0, 0, -1, 2), plane(0, -1, 0, 1)}, {1, 1, 1, 2, 2, 0});
  const auto numbers = track.update(
      {plane(0, -1, 0.02, 1.01), plane(0.01, 0, -1, 2.02)}, {2, 2, 0, 1, 1, 1});
  EXPECT_EQ(numbers, (std::vector<std::uint32_t>{2, 1}));
}

TEST(ColourTrackTest, OfTwoAlikePlanesTheOneInTheSamePlaceIsIt)
{
  ColourTrack track; // the tops of two tables of one height
  track.update({plane(0, -1, 0, 1), plane(0, -1, 0, 1)}, {1, 1, 0, 2, 2});
  const auto numbers =
      track.update({plane(0, -1, 0, 1), plane(0, -1, 0, 1)}, {2, 2, 0, 1, 1});
  EXPECT_EQ(numbers, (std::vector<std::uint32_t>{2, 1}));
}

TEST(ColourTrackTest, APlaneOfAnotherTiltInTheSamePlaceIsNew)
{
  ColourTrack track;
  track.update({plane(0, 0, -1, 2)}, {1, 1, 1});
  EXPECT_EQ(track.update({plane(0, -1, 0, 2)}, {1, 1, 1}),
            (std::vector<std::uint32_t>{2}));
}

TEST(ColourTrackTest, APlaneThatWasGoneComesBackWithItsNumber)
{
  ColourTrack track;
  const Plane wall = plane(0, 0, -1, 2);
  const Plane floor = plane(0, -1, 0, 1);
  const Plane door = plane(1, 0, 0, 1);
  track.update({wall, floor}, {1, 1, 2, 2});
  EXPECT_EQ(track.update({floor, door}, {2, 2, 1, 1}),
            (std::vector<std::uint32_t>{2, 3}))
      << "1 is kept for the wall";
  EXPECT_EQ(track.update({floor, wall}, {2, 2, 1, 1}),
            (std::vector<std::uint32_t>{2, 1}));
}

TEST(ColourTrackTest, NumbersOfPlanesLongGoneAreGivenAgain)
{
  ColourTrack::Tolerances tolerances;
  tolerances.frames = 3;
  ColourTrack track(tolerances);
  track.update({plane(0, 0, -1, 2)}, {1});
  for (int frame = 0; frame < 5; ++frame)
    track.update({}, {0});
  EXPECT_EQ(track.update({plane(1, 0, 0, 1)}, {1}), (std::vector<std::uint32_t>{1}));
}

TEST(ColourTrackTest, NumbersOfAFrameAreAllDifferentAndStayFew)
{
  ColourTrack track;
  for (int frame = 0; frame < 200; ++frame) {
    std::vector<Plane> planes;
    std::vector<std::uint16_t> labels;
    for (int k = 0; k < 10; ++k) { // all new every time
      planes.push_back(plane(1, 0.01 * (frame + 1), 0, 5.0 * k + frame));
      labels.push_back(static_cast<std::uint16_t>(k + 1));
    }
    const auto numbers = track.update(planes, labels);
    EXPECT_EQ(std::set<std::uint32_t>(numbers.begin(), numbers.end()).size(), 10U);
    EXPECT_LE(*std::max_element(numbers.begin(), numbers.end()), 10U * 32U);
  }
}

TEST(ColourTrackTest, TakesAnotherSizeOfImageAndLabelsOfNoPlane)
{
  ColourTrack track;
  track.update({plane(0, 0, -1, 2)}, {1, 1});
  EXPECT_EQ(track.update({plane(0, 0, -1, 2)}, {1, 7, 65535}),
            (std::vector<std::uint32_t>{1}))
      << "the planes agree";
  track.reset();
  EXPECT_TRUE(track.update({}, {}).empty());
}

} // namespace
} // namespace pcl_mrf_planes::apps
