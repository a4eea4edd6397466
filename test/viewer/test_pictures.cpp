// SPDX-License-Identifier: BSD-3-Clause
/** \file Pictures that the viewer makes without a display. */
#include "label_colours.h"
#include "viewer_test.h"

#include <cmath>
#include <regex>

namespace pcl_mrf_planes::test {

namespace {

constexpr std::size_t TEXT = 150; // pixels of a line of text, at least

/// Contrast of WCAG 2.
double contrast(const io::Colour& a, const io::Colour& b)
{
  const auto luminance = [](const io::Colour& c) {
    const auto linear = [](double v) {
      return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(c[0] / 255.0) + 0.7152 * linear(c[1] / 255.0) +
           0.0722 * linear(c[2] / 255.0);
  };
  const double x = luminance(a), y = luminance(b);
  return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
}

class Pictures : public ViewerTest {
protected:
  io::ColourImage picture(const std::string& input, const std::string& keys,
                          const std::string& profile = "default")
  {
    const std::string file = path("picture.png");
    const Outcome seen = view({input, "--screenshot", file, "--keys", keys, "--log",
                               "--window", "800x600", "--profile", profile});
    EXPECT_EQ(seen.status, 0) << seen.err;
    EXPECT_EQ(seen.err, "");
    log_ = seen.out;
    const io::ColourImage read = readPicture(file);
    EXPECT_EQ(read.width, 800);
    EXPECT_EQ(read.height, 600);
    return read;
  }

  /// A picture after each of the keys, one after the other in one window.
  std::vector<io::ColourImage> pictures(const std::string& input,
                                        const std::vector<std::string>& keys,
                                        const std::string& size = "800x600")
  {
    std::string all;
    for (const std::string& some : keys)
      all += some + " k ";
    const Outcome seen = view({input, "--screenshot", path("last.png"), "--keys", all,
                               "--pictures", path("seen"), "--window", size});
    EXPECT_EQ(seen.status, 0) << seen.err;
    std::vector<io::ColourImage> read;
    for (std::size_t k = 1; k <= keys.size(); ++k)
      read.push_back(readPicture(path("seen_" + std::to_string(k) + ".png")));
    return read;
  }

  std::string log_;
};

TEST_F(Pictures, HaveAColourForEveryPlane)
{
  const io::ColourImage seen = picture(room("room.pcd"), "f");
  std::smatch found;
  ASSERT_TRUE(std::regex_search(log_, found, std::regex("planes ([0-9]+)")));
  const int planes = std::stoi(found[1]);
  ASSERT_GT(planes, 5);
  int visible = 0;
  for (int k = 1; k <= planes; ++k)
    visible += countColour(seen, apps::labelColour(static_cast<std::uint32_t>(k))) > 20;
  EXPECT_EQ(visible, planes);
  EXPECT_EQ(
      countColour(seen, apps::labelColour(static_cast<std::uint32_t>(planes + 1))), 0u);
}

TEST_F(Pictures, ChangeWithEveryColourAndLayerAndBack)
{
  // Keys, what they must change, and keys that bring back the view.
  const std::vector<std::pair<std::string, std::string>> pairs = {
      {"2", "1"},       {"3", "1"},
      {"4", "1"},       {"5", "1"},
      {"6", "1"},       {"7", "1"},
      {"8", "1"},       {"c", "c"},
      {"n", "n"},       {"g", "g"},
      {"x", "x x"},     {"x x", "x"},
      {"t", "t"},       {"i", "i i i"},
      {"i i i", "i"},   {"v", "v v v v"},
      {"a", "a"},       {"s", "s"},
      {"b", "b"},       {"h", "h"},
      {"y", "r"},       {"y j", "r j"},
      {"tab", "esc"},   {"tab d", "u"},
      {"tab o", "esc"}, {"tab tab y", "esc r"}};
  std::vector<std::string> keys = {"f"};
  for (const auto& pair : pairs) {
    keys.push_back(pair.first);
    keys.push_back(pair.second);
  }
  const std::vector<io::ColourImage> seen = pictures(room("room.pcd"), keys);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    EXPECT_GT(countDifferences(seen[0], seen[2 * k + 1]), TEXT) << pairs[k].first;
    EXPECT_EQ(countDifferences(seen[0], seen[2 * k + 2]), 0u)
        << pairs[k].first << ' ' << pairs[k].second;
  }
}

TEST_F(Pictures, PointsOnTheirPlanesMakeThinWallsFromAbove)
{
  // Ceiling and floor are hidden: what is left is seen edge-on, but for tables.
  const std::vector<io::ColourImage> seen =
      pictures(room("room.pcd"), {"f tab d tab tab y d", "j"});
  const auto covered = [&](std::uint32_t plane) {
    return std::make_pair(countColour(seen[0], apps::labelColour(plane)),
                          countColour(seen[1], apps::labelColour(plane)));
  };
  for (const std::uint32_t wall : {3u, 4u, 5u}) {
    const auto [measured, moved] = covered(wall);
    EXPECT_GT(moved, 50u) << wall;
    EXPECT_LT(static_cast<double>(moved), 0.8 * static_cast<double>(measured)) << wall;
  }
}

TEST_F(Pictures, CoarseImagesHaveNoGaps)
{
  ASSERT_EQ(run(PCL_MRF_PLANES_SCENE_APP, {path("coarse.pcd"), "--noise", "0",
                                           "--width", "160", "--height", "120"})
                .status,
            0);
  const io::ColourImage seen = picture(path("coarse.pcd"), "f");
  const io::Colour background = seen.pixels[0];
  std::size_t gaps = 0;
  for (int y = 150; y < 300; ++y) // what the middle of the image saw
    for (int x = 200; x < 500; ++x)
      gaps += seen.pixels[static_cast<std::size_t>(y * seen.width + x)] == background;
  EXPECT_LT(gaps, 150u * 300u / 50u);
}

TEST_F(Pictures, HelpIsWholeInAnyWindow)
{
  const std::string input = room("room.pcd");
  for (const char* size : {"640x480", "1280x800"}) {
    const std::vector<io::ColourImage> seen = pictures(input, {"f", "h"}, size);
    const auto width = static_cast<std::size_t>(seen[0].width);
    const std::size_t last_row = seen[0].pixels.size() - width;
    EXPECT_GT(countDifferences(seen[0], seen[1]), 100u * TEXT) << size;
    for (std::size_t i = 0; i < seen[0].pixels.size(); ++i)
      if (i < width || i >= last_row || i % width == 0 || i % width + 1 == width) {
        ASSERT_EQ(seen[0].pixels[i], seen[1].pixels[i]) << size << ": cut off at " << i;
      }
  }
}

TEST_F(Pictures, TextIsReadableOnDarkAndOnLight)
{
  const std::vector<io::ColourImage> seen =
      pictures(room("room.pcd"), {"f", "f", "f b", "f"});
  for (const bool dark : {true, false}) {
    const io::ColourImage& without = seen[dark ? 0 : 2];
    const io::ColourImage& with = seen[dark ? 1 : 3];
    const io::Colour text = dark ? io::Colour{255, 255, 255} : io::Colour{0, 0, 0};
    // What the text adds is strokes and, but for the strokes' soft edges, the plate
    // behind them.
    std::size_t strokes = 0, others = 0, readable = 0;
    for (std::size_t i = 0; i < with.pixels.size(); ++i) {
      if (with.pixels[i] == without.pixels[i])
        continue;
      const bool is_stroke = with.pixels[i] == text;
      strokes += is_stroke;
      others += !is_stroke;
      readable += !is_stroke && contrast(text, with.pixels[i]) > 7.0; // WCAG 2, AAA
    }
    EXPECT_GT(strokes, 300u) << dark;
    EXPECT_GT(others, 3000u) << dark;
    EXPECT_GT(static_cast<double>(readable), 0.8 * static_cast<double>(others)) << dark;
  }
}

TEST_F(Pictures, NothingHidesTheNumbersOfThePlanes)
{
  const io::Colour stroke = {0, 0, 0};
  // All, then each of five alone.
  const std::vector<io::ColourImage> seen =
      pictures(room("room.pcd"), {"f b n", "tab o", "tab", "tab", "tab", "tab"});
  const io::ColourImage& all = seen[0];
  for (std::size_t plane = 1; plane < seen.size(); ++plane) {
    const io::ColourImage& alone = seen[plane];
    std::size_t strokes = 0, visible = 0;
    for (std::size_t i = 0; i < alone.pixels.size() * 4 / 5; ++i) // text is below
      if (alone.pixels[i] == stroke) {
        ++strokes;
        visible += all.pixels[i] == stroke;
      }
    EXPECT_GT(strokes, 10u) << plane;
    EXPECT_EQ(visible, strokes) << plane;
  }
}

TEST_F(Pictures, CreasesAreConvexOrConcaveByColour)
{
  const std::vector<io::ColourImage> seen = pictures(room("room.pcd"), {"f", "g"});
  for (const io::Colour& colour : {io::Colour{213, 94, 0}, io::Colour{0, 114, 178}}) {
    EXPECT_EQ(countColour(seen[0], colour), 0u);
    EXPECT_GT(countColour(seen[1], colour), 100u);
  }
}

TEST_F(Pictures, SlidersStayWhenTheViewChanges)
{
  const io::Colour knob = {230, 158, 0};
  const std::vector<io::ColourImage> seen =
      pictures(room("room.pcd"), {"f 2", "1 s 2"});
  EXPECT_EQ(countColour(seen[0], knob), 0u);
  EXPECT_GT(countColour(seen[1], knob), 500u);
}

TEST_F(Pictures, FilmShowsEveryStep)
{
  const Outcome seen = view({room("room.pcd"), "--profile", "paper", "--keys", "a",
                             "--film", path("film"), "--window", "640x480"});
  ASSERT_EQ(seen.status, 0) << seen.err;
  EXPECT_EQ(seen.err, "");
  // Tiles, merged planes, 0 to 5 iterations, the result.
  std::vector<io::ColourImage> steps;
  for (int k = 0; k < 9; ++k)
    steps.push_back(readPicture(path("film/frame_0000" + std::to_string(k) + ".png")));
  for (std::size_t k = 1; k < steps.size(); ++k) {
    ASSERT_EQ(steps[k].width, 640) << k;
    EXPECT_GT(countDifferences(steps[k - 1], steps[k]), TEXT) << k;
  }
  EXPECT_TRUE(readPicture(path("film/frame_00009.png")).pixels.empty());
}

TEST_F(Pictures, FilmOfASequenceHasAPictureForEachFrame)
{
  room("a.pcd", 1);
  room("b.pcd", 2);
  const Outcome seen = view({path(""), "--film", path("film"), "--window", "320x240"});
  ASSERT_EQ(seen.status, 0) << seen.err;
  const io::ColourImage first = readPicture(path("film/frame_00000.png"));
  const io::ColourImage second = readPicture(path("film/frame_00001.png"));
  ASSERT_EQ(first.width, 320);
  ASSERT_EQ(second.width, 320);
  EXPECT_GT(countDifferences(first, second), 1000u);
}

TEST_F(Pictures, FilmHasNoPictureOfAFrameThatCannotBeRead)
{
  std::filesystem::create_directories(path("frames"));
  room("frames/a.pcd", 1);
  brokenFrame("frames/b.pcd");
  room("frames/c.pcd", 2);
  const Outcome seen =
      view({path("frames"), "--film", path("film"), "--window", "320x240"});
  EXPECT_EQ(seen.status, 0);
  EXPECT_NE(seen.err.find("b.pcd"), std::string::npos) << seen.err;
  EXPECT_EQ(readPicture(path("film/frame_00000.png")).width, 320);
  EXPECT_FALSE(std::filesystem::exists(path("film/frame_00001.png")));
  EXPECT_EQ(readPicture(path("film/frame_00002.png")).width, 320);
}

TEST_F(Pictures, OutputThatIsNotTakenIsAnError)
{
  if (!std::filesystem::is_character_file("/dev/full"))
    GTEST_SKIP() << "no /dev/full here";
  const Outcome seen =
      run("/bin/sh", {"-c", "'" PCL_MRF_PLANES_VIEWER_APP "' --help >/dev/full"});
  EXPECT_EQ(seen.status, 1);
  EXPECT_NE(seen.err.find("cannot write to standard output"), std::string::npos);
}

TEST_F(Pictures, BadInputIsAMessageAndAStatus)
{
  brokenFrame("broken.pcd");
  std::filesystem::create_directories(path("empty"));
  for (const std::string name : {"broken.pcd", "empty", "missing.pcd"}) {
    const Outcome seen = view({path(name), "--screenshot", path("picture.png")});
    EXPECT_EQ(seen.status, 1) << name;
    EXPECT_NE(seen.err.find(name), std::string::npos) << seen.err;
    EXPECT_FALSE(std::filesystem::exists(path("picture.png")));
  }
  const std::string input = room("room.pcd");
  std::ofstream(path("file")) << "no folder\n";
  const Outcome no_folder = view({input, "--film", path("file")});
  EXPECT_EQ(no_folder.status, 1);
  EXPECT_NE(no_folder.err.find("--film"), std::string::npos) << no_folder.err;
  const Outcome unwritable = view({input, "--screenshot", path("no/such/folder.png")});
  EXPECT_EQ(unwritable.status, 1);
  EXPECT_NE(unwritable.err.find("folder.png"), std::string::npos) << unwritable.err;
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{},
                                             {input, "--keys", "nonsense"},
                                             {input, "--window", "1x1"},
                                             {input, "--profile", "best"},
                                             {input, "--wrap"}})
    EXPECT_EQ(view(words).status, 2);
}

TEST_F(Pictures, WithoutADisplayAWindowIsRefused)
{
  const Outcome seen = view({room("room.pcd")});
  EXPECT_EQ(seen.status, 1);
  EXPECT_NE(seen.err.find("--screenshot"), std::string::npos) << seen.err;
}

} // namespace

} // namespace pcl_mrf_planes::test
