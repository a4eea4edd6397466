// SPDX-License-Identifier: BSD-3-Clause
/** \file The real window: keys, mouse and resizing as the X server sends them. */
#include "viewer_test.h"

#include <regex>

namespace pcl_mrf_planes::test {

namespace {

class Window : public ViewerTest {};

/// Lines of the viewer's log.
std::vector<std::string> lines(const std::string& log)
{
  std::vector<std::string> all;
  std::istringstream stream(log);
  for (std::string line; std::getline(stream, line);)
    all.push_back(line);
  return all;
}

bool holds(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

TEST_F(Window, TakesKeysAndEnds)
{
  const Outcome seen =
      drive(room("room.pcd"), "xdotool key 2\nxdotool key p\nxdotool key p\n"
                              "xdotool key k\nxdotool key q");
  EXPECT_EQ(seen.status, 0) << seen.err;
  const std::vector<std::string> log = lines(seen.out);
  ASSERT_EQ(log.size(), 6u) << seen.out;
  EXPECT_TRUE(holds(log[0], "profile default")) << log[0];
  EXPECT_TRUE(holds(log[1], "mode 1")) << log[1];
  EXPECT_TRUE(holds(log[2], "profile fast")) << log[2];
  EXPECT_TRUE(holds(log[3], "profile paper")) << log[3];
  EXPECT_EQ(readPicture(path("view_1.png")).width, 1000);
}

TEST_F(Window, PicksThePlaneUnderThePointer)
{
  const Outcome seen =
      drive(room("room.pcd"), "xdotool mousemove 450 180 click 1\nsleep 0.3\n"
                              "xdotool key d\nxdotool key u\nxdotool key q");
  const std::vector<std::string> log = lines(seen.out);
  ASSERT_EQ(log.size(), 5u) << seen.out << seen.err;
  EXPECT_EQ(seen.status, 0) << seen.err;
  EXPECT_TRUE(std::regex_search(log[1], std::regex("selected [1-9]"))) << log[1];
  EXPECT_TRUE(holds(log[2], "hidden 1")) << log[2];
  EXPECT_TRUE(holds(log[3], "hidden 0")) << log[3];
}

TEST_F(Window, TurnsWhenItIsDraggedAndPicksNothing)
{
  const Outcome seen = drive(room("room.pcd"),
                             "xdotool key k\nsleep 0.3\n"
                             "xdotool mousemove 500 350 mousedown 1\nsleep 0.2\n"
                             "xdotool mousemove 600 400\nsleep 0.2\nxdotool mouseup 1\n"
                             "sleep 0.2\nxdotool key k\nxdotool key q");
  EXPECT_EQ(lines(seen.out).size(), 4u) << seen.out << seen.err;
  EXPECT_GT(countDifferences(readPicture(path("view_1.png")),
                             readPicture(path("view_2.png"))),
            10000u);
}

TEST_F(Window, DraggedSliderChangesTheResult)
{
  // The lowest slider, the smallest plane: from none to some thousand points.
  const Outcome seen =
      drive(room("room.pcd"), "xdotool key s\nsleep 0.5\n"
                              "xdotool mousemove 31 622 mousedown 1\nsleep 0.2\n"
                              "xdotool mousemove 100 622\nsleep 0.3\n"
                              "xdotool mousemove 160 622\nsleep 0.3\n"
                              "xdotool mouseup 1\nsleep 0.2\nxdotool key q");
  const std::vector<std::string> log = lines(seen.out);
  ASSERT_GE(log.size(), 4u) << seen.out << seen.err;
  const auto planes = [](const std::string& line) {
    std::smatch found;
    return std::regex_search(line, found, std::regex("planes ([0-9]+)"))
               ? std::stoi(found[1])
               : -1;
  };
  EXPECT_GT(planes(log.front()), planes(log.back())) << seen.out;
  EXPECT_GT(planes(log.back()), 0) << seen.out;
}

TEST_F(Window, FollowsItsSize)
{
  const Outcome seen =
      drive(room("room.pcd"), "xdotool windowsize --sync $window 640 480\nsleep 0.5\n"
                              "xdotool mousemove 300 200\n"
                              "xdotool key r\nxdotool key k\nxdotool key q");
  const io::ColourImage picture = readPicture(path("view_1.png"));
  EXPECT_EQ(picture.width, 640) << seen.out << seen.err;
  EXPECT_EQ(picture.height, 480);
}

TEST_F(Window, PlaysPausesAndLoops)
{
  std::filesystem::create_directories(path("frames"));
  for (int k = 0; k < 3; ++k)
    room("frames/" + std::to_string(k) + ".pcd", k);
  const Outcome seen =
      drive(path("frames"), "xdotool key plus\nxdotool key space\nsleep 2\n"
                            "xdotool key space\nsleep 0.3\nxdotool key Right\n"
                            "xdotool key q");
  for (const char* frame : {"frame 1/3", "frame 2/3", "frame 3/3", "playing 1"})
    EXPECT_TRUE(holds(seen.out, frame)) << frame << '\n' << seen.out << seen.err;
  EXPECT_GT(lines(seen.out).size(), 7u) << seen.out; // beyond the last one: a loop
  EXPECT_TRUE(holds(lines(seen.out).back(), "playing 0")) << seen.out;
}

TEST_F(Window, PassesOverABrokenFrame)
{
  std::filesystem::create_directories(path("frames"));
  room("frames/0.pcd", 0);
  brokenFrame("frames/1.pcd");
  room("frames/2.pcd", 2);
  const Outcome seen =
      drive(path("frames"), "xdotool key Right\nxdotool key Right\nxdotool key q");
  EXPECT_EQ(seen.status, 0) << seen.err;
  EXPECT_TRUE(holds(seen.out, "1.pcd")) << seen.out; // said why
  EXPECT_TRUE(holds(seen.out, "frame 3/3")) << seen.out;
}

TEST_F(Window, WritesAndReadsParameters)
{
  const Outcome seen = drive(
      room("room.pcd"), "xdotool key p\nxdotool key p\nxdotool key w\nxdotool key p\n"
                        "sleep 0.3\nxdotool key e\nxdotool key q");
  const std::vector<std::string> log = lines(seen.out);
  ASSERT_EQ(log.size(), 7u) << seen.out << seen.err;
  EXPECT_TRUE(holds(log[4], "profile default")) << log[4];
  EXPECT_TRUE(holds(log[5], "profile paper")) << log[5];
  const Outcome taken = segment({path("room.pcd"), path("out.pcd"), "--parameters",
                                 path("viewer_parameters.txt")});
  EXPECT_EQ(taken.status, 0) << taken.err;
}

} // namespace

} // namespace pcl_mrf_planes::test
