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

TEST_F(Pictures, ChangeWithEveryColourAndLayer)
{
  const std::string input = room("room.pcd");
  const io::ColourImage plain = picture(input, "1");
  // The second half of a pair: what the key adds must be there.
  for (const char* keys :
       {"2",     "3", "4", "5", "6", "c", "n", "g",   "t",     "i",
        "i i i", "v", "a", "s", "f", "b", "h", "tab", "tab d", "tab o"})
    EXPECT_GT(countDifferences(plain, picture(input, keys)), TEXT) << keys;
}

TEST_F(Pictures, KeysTwiceBringBackTheView)
{
  const std::string input = room("room.pcd");
  const io::ColourImage plain = picture(input, "f");
  for (const char* keys :
       {"f c c", "f n n", "f g g", "f t t", "f i i i i", "f v v v v v", "f a a",
        "f s s", "f b b", "f h h", "f tab d u", "f tab o esc"})
    EXPECT_EQ(countDifferences(plain, picture(input, keys)), 0u) << keys;
}

TEST_F(Pictures, TextIsReadableOnDarkAndOnLight)
{
  const std::string input = room("room.pcd");
  for (const std::string background : {"", " b"}) {
    const io::ColourImage without = picture(input, "f" + background);
    const io::ColourImage with = picture(input, "2 1" + background);
    const io::Colour text =
        background.empty() ? io::Colour{255, 255, 255} : io::Colour{0, 0, 0};
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
    EXPECT_GT(strokes, 300u) << background;
    EXPECT_GT(others, 3000u) << background;
    EXPECT_GT(static_cast<double>(readable), 0.8 * static_cast<double>(others))
        << background;
  }
}

TEST_F(Pictures, NothingHidesTheNumbersOfThePlanes)
{
  const std::string input = room("room.pcd");
  const io::Colour stroke = {0, 0, 0};
  const io::ColourImage all = picture(input, "f b n");
  std::string tabs;
  for (int plane = 1; plane <= 5; ++plane) {
    tabs += " tab";
    const io::ColourImage alone = picture(input, "f b n" + tabs + " o");
    std::size_t strokes = 0, seen = 0;
    for (std::size_t i = 0; i < alone.pixels.size() * 4 / 5; ++i) // text is below
      if (alone.pixels[i] == stroke) {
        ++strokes;
        seen += all.pixels[i] == stroke;
      }
    EXPECT_GT(strokes, 10u) << plane;
    EXPECT_EQ(seen, strokes) << plane;
  }
}

TEST_F(Pictures, CreasesAreConvexOrConcaveByColour)
{
  const io::ColourImage seen = picture(room("room.pcd"), "f g");
  const io::ColourImage without = picture(room("room.pcd"), "f");
  for (const io::Colour& colour : {io::Colour{213, 94, 0}, io::Colour{0, 114, 178}}) {
    EXPECT_GT(countColour(seen, colour), 100u);
    EXPECT_EQ(countColour(without, colour), 0u);
  }
}

TEST_F(Pictures, SlidersStayWhenTheViewChanges)
{
  const std::string input = room("room.pcd");
  const io::Colour knob = {230, 158, 0};
  EXPECT_EQ(countColour(picture(input, "f 2"), knob), 0u);
  EXPECT_GT(countColour(picture(input, "f s 2"), knob), 500u);
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
  std::ofstream(path("frames/b.pcd")) << "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\n";
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
  std::ofstream(path("broken.pcd")) << "VERSION 0.7\nFIELDS x y z\n";
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
