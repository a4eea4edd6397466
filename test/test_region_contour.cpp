// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/random.h"

#include <pcl_mrf_planes/region_contour.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <set>
#include <string>
#include <vector>

namespace pcl_mrf_planes {
namespace {

/// A label image from text: '.' is background, a digit is a label.
struct Picture {
  explicit Picture(const std::vector<std::string>& rows)
  : width(static_cast<int>(rows.front().size()))
  , height(static_cast<int>(rows.size()))
  {
    for (const std::string& row : rows)
      for (const char c : row)
        labels.push_back(static_cast<std::uint16_t>(c == '.' ? 0 : c - '0'));
  }
  Picture(int w, int h)
  : width(w)
  , height(h)
  {
    labels.resize(static_cast<std::size_t>(w * h));
  }
  int width, height;
  std::vector<std::uint16_t> labels;
};

/// Points of a part that a walk along the outside of it has to visit: those from which
/// a 4-neighbour leads into the background that reaches the border of the image.
std::set<int> outerBoundary(const ConnectedParts& parts, int part, int width,
                            int height)
{
  const int w = width + 2; // with a frame of outside around the image
  std::vector<int> outside(static_cast<std::size_t>(w * (height + 2)), 0);
  const auto inside = [&](int x, int y) {
    return x >= 1 && y >= 1 && x <= width && y <= height &&
           parts.part_of_point[static_cast<std::size_t>((y - 1) * width + x - 1)] ==
               part;
  };
  std::vector<std::pair<int, int>> open = {{0, 0}};
  outside[0] = 1;
  while (!open.empty()) {
    const auto [x, y] = open.back();
    open.pop_back();
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const int u = x + dx;
        const int v = y + dy;
        // An outer boundary of an 8-connected walk has an 4-connected outside.
        if (std::abs(dx) + std::abs(dy) != 1 || u < 0 || v < 0 || u >= w ||
            v >= height + 2 || inside(u, v))
          continue;
        int& seen = outside[static_cast<std::size_t>(v * w + u)];
        if (seen == 0) {
          seen = 1;
          open.emplace_back(u, v);
        }
      }
  }
  std::set<int> boundary;
  for (int y = 1; y <= height; ++y)
    for (int x = 1; x <= width; ++x)
      if (inside(x, y) && (outside[static_cast<std::size_t>(y * w + x - 1)] != 0 ||
                           outside[static_cast<std::size_t>(y * w + x + 1)] != 0 ||
                           outside[static_cast<std::size_t>((y - 1) * w + x)] != 0 ||
                           outside[static_cast<std::size_t>((y + 1) * w + x)] != 0))
        boundary.insert((y - 1) * width + x - 1);
  return boundary;
}

void expectGoodContour(const Picture& picture, const ConnectedParts& parts, int part)
{
  const int width = picture.width;
  const std::vector<int> contour = traceContour(parts, part, width, picture.height);
  ASSERT_FALSE(contour.empty());
  EXPECT_EQ(contour.front(), parts.first[static_cast<std::size_t>(part)]);
  for (std::size_t i = 0; i < contour.size(); ++i) {
    EXPECT_EQ(parts.part_of_point[static_cast<std::size_t>(contour[i])], part)
        << "the contour leaves the part";
    const int next = contour[(i + 1) % contour.size()];
    const int dx = std::abs(next % width - contour[i] % width);
    const int dy = std::abs(next / width - contour[i] / width);
    EXPECT_LE(dx, 1) << "a step is to an 8-neighbour";
    EXPECT_LE(dy, 1) << "a step is to an 8-neighbour";
    if (contour.size() > 1) {
      EXPECT_GE(dx + dy, 1) << "a step must move";
    }
  }
  const std::set<int> expected = outerBoundary(parts, part, width, picture.height);
  const std::set<int> visited(contour.begin(), contour.end());
  EXPECT_EQ(visited, expected) << "the walk must visit the outer boundary and no more";
}

std::vector<int> contourOf(const Picture& picture)
{
  const ConnectedParts parts =
      findConnectedParts(picture.labels, picture.width, picture.height);
  EXPECT_EQ(parts.size.size(), 1U);
  expectGoodContour(picture, parts, 0);
  return traceContour(parts, 0, picture.width, picture.height);
}

TEST(ConnectedPartsTest, AreFourConnectedAndKeepLabelsApart)
{
  const Picture picture({"11.2", //
                         "1.22", //
                         ".1..", //
                         "33.1"});
  const ConnectedParts parts =
      findConnectedParts(picture.labels, picture.width, picture.height);
  ASSERT_EQ(parts.size.size(), 5U) << "diagonal neighbours are not connected";
  EXPECT_EQ(parts.size, (std::vector<int>{3, 3, 1, 2, 1}));
  EXPECT_EQ(parts.label, (std::vector<std::uint16_t>{1, 2, 1, 3, 1}));
  EXPECT_EQ(parts.first, (std::vector<int>{0, 3, 9, 12, 15}));
  for (std::size_t i = 0; i < picture.labels.size(); ++i)
    EXPECT_EQ(parts.part_of_point[i] == ConnectedParts::NONE, picture.labels[i] == 0)
        << "background belongs to no part, everything else does";
}

TEST(ConnectedPartsTest, NothingButBackground)
{
  const Picture picture(4, 3);
  const ConnectedParts parts = findConnectedParts(picture.labels, 4, 3);
  EXPECT_TRUE(parts.size.empty());
}

TEST(RegionContourTest, SquareIsWalkedClockwiseOnce)
{
  const std::vector<int> contour = contourOf(Picture({".....", //
                                                      ".111.", //
                                                      ".111.", //
                                                      ".111.", //
                                                      "....."}));
  EXPECT_EQ(contour, (std::vector<int>{6, 7, 8, 13, 18, 17, 16, 11}));
}

TEST(RegionContourTest, OnePointIsItsOwnContour)
{
  EXPECT_EQ(contourOf(Picture({"...", ".1.", "..."})), std::vector<int>{4});
  EXPECT_EQ(contourOf(Picture({"1"})), std::vector<int>{0});
}

TEST(RegionContourTest, NarrowPartsAreWalkedThereAndBack)
{
  EXPECT_EQ(contourOf(Picture({".111."})), (std::vector<int>{1, 2, 3, 2}));
  EXPECT_EQ(contourOf(Picture({"1", "1", "1"})), (std::vector<int>{0, 1, 2, 1}));
  EXPECT_EQ(contourOf(Picture({"11"})), (std::vector<int>{0, 1}));
  const std::vector<int> plus = contourOf(Picture({"..1..", //
                                                   "..1..", //
                                                   "11111", //
                                                   "..1..", //
                                                   "..1.."}));
  const std::set<int> visited(plus.begin(), plus.end());
  EXPECT_EQ(visited.size(), 8U) << "all of the plus but its hidden centre";
}

TEST(RegionContourTest, HolesAreNotWalkedAndTheImageMayBeFull)
{
  const std::vector<int> ring = contourOf(Picture({"11111", //
                                                   "11111", //
                                                   "11.11", //
                                                   "11111", //
                                                   "11111"}));
  EXPECT_EQ(ring.size(), 16U) << "the outer boundary only";
  const std::vector<int> full = contourOf(Picture({"1111", //
                                                   "1111", //
                                                   "1111"}));
  EXPECT_EQ(full.size(), 10U) << "the border of the image is a boundary";
}

TEST(RegionContourTest, PinchedPartsAreWalkedWholly)
{
  // Passing the start again must not end the walk early.
  contourOf(Picture({"..1..", //
                     ".111.", //
                     "11.11"}));
  contourOf(Picture({"1.1", //
                     "111", //
                     "1.1"}));
  contourOf(Picture({".1...", //
                     "11111", //
                     ".1.1.", //
                     ".111."}));
}

TEST(RegionContourTest, RandomPartsOfEverySize)
{
  scenes::Random random(6);
  for (int round = 0; round < 60; ++round) {
    Picture picture(random.integer(1, 14), random.integer(1, 14));
    for (auto& label : picture.labels)
      label =
          static_cast<std::uint16_t>(random.chance(0.75) ? random.integer(1, 2) : 0);
    const ConnectedParts parts =
        findConnectedParts(picture.labels, picture.width, picture.height);
    for (int part = 0; part < static_cast<int>(parts.size.size()); ++part)
      expectGoodContour(picture, parts, part);
  }
}

} // namespace
} // namespace pcl_mrf_planes
