// SPDX-License-Identifier: BSD-3-Clause
// Inputs that cannot be segmented and outputs that cannot be written.
#include "cli_test.h"
#include "two_planes.h"

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>

namespace pcl_mrf_planes::test {

class BadFiles : public CliTest {
protected:
  void SetUp() override
  {
    CliTest::SetUp();
    for (const char* format : {"ascii", "binary", "binary_compressed"})
      scene_.write(path(std::string(format) + ".pcd"), format);
  }

  /// The run fails with one line that holds \a message, and leaves no trace.
  void expectFailure(const std::vector<std::string>& arguments,
                     const std::string& message) const
  {
    const auto before = files();
    const Outcome outcome = segment(arguments);
    EXPECT_EQ(outcome.status, 1) << message << "\n" << outcome.err;
    EXPECT_EQ(outcome.err.find("pcl_mrf_plane_segmentation: "), 0u) << outcome.err;
    EXPECT_NE(outcome.err.find(message), std::string::npos)
        << "expected '" << message << "' in: " << outcome.err;
    EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1)
        << "more than one line: " << outcome.err;
    EXPECT_EQ(outcome.out, "") << "PCL's own words get through";
    EXPECT_EQ(files(), before) << message << ": a file was left";
  }

  void expectBadInput(const std::string& name, const std::string& message) const
  {
    SCOPED_TRACE(name);
    expectFailure({path(name), path("out.pcd"), "--models", path("out.json"),
                   "--overlay", path("out.png"), "--label-image", path("labels.png")},
                  message);
  }

  /// A copy of a file with one line of its header exchanged.
  std::string withLine(const std::string& name, const std::string& word,
                       const std::string& line) const
  {
    std::string content = read(name);
    const auto start = content.find("\n" + word) + 1;
    content.replace(start, content.find('\n', start) - start, line);
    return content;
  }

  /// Where the points end: PCL fills compressed files up to a page.
  std::size_t bodyEnd(const std::string& whole) const
  {
    const auto body = whole.find('\n', whole.find("\nDATA ") + 1) + 1;
    if (whole.find("\nDATA ascii") != std::string::npos)
      return whole.rfind(' ');
    if (whole.find("\nDATA binary_compressed") == std::string::npos)
      return body + TwoPlanes::POINTS * scene_.cloud.point_step;
    std::uint32_t size = 0;
    std::memcpy(&size, &whole[body], sizeof size);
    return body + 8 + size;
  }

  TwoPlanes scene_;
};

TEST_F(BadFiles, MissingOrNoPcdAtAll)
{
  write("empty.pcd", "");
  write("words.pcd", "This is a letter to a friend.\nIt has two lines.\n");
  write("noise.pcd", std::string(300000, '\x93'));
  write("lines.pcd", std::string(300000, '\n'));
  write("only_data.pcd", "DATA binary\n1234");
  expectBadInput("none.pcd", "does not exist");
  expectBadInput("empty.pcd", "empty file");
  expectBadInput("words.pcd", "is not a PCD file");
  expectBadInput("noise.pcd", "is not a PCD file");
  expectBadInput("lines.pcd", "is not a PCD file");
  expectBadInput("only_data.pcd", "is not a PCD file");
  expectFailure({std::filesystem::temp_directory_path().string(), path("out.pcd")},
                "is not a file");
}

TEST_F(BadFiles, Truncated)
{
  for (const char* name : {"ascii.pcd", "binary.pcd", "binary_compressed.pcd"}) {
    const std::string whole = read(name);
    const auto header = whole.find('\n', whole.find("\nDATA ") + 1) + 1;
    const std::vector<std::size_t> lengths = {header, header + 3, header + 100,
                                              whole.size() / 2, bodyEnd(whole) - 1};
    for (const std::size_t length : lengths) {
      write("cut.pcd", whole.substr(0, length));
      expectBadInput("cut.pcd", "truncated");
    }
    write("cut.pcd", whole.substr(0, header / 2));
    expectBadInput("cut.pcd", "is not a PCD file");
  }
  std::string short_line = read("ascii.pcd");
  const auto end = short_line.find('\n', short_line.size() / 2);
  const auto blank = short_line.rfind(' ', end);
  short_line.erase(blank, end - blank);
  write("short_line.pcd", short_line);
  expectBadInput("short_line.pcd", "damaged");
}

TEST_F(BadFiles, DamagedCompressedPoints)
{
  const std::string whole = read("binary_compressed.pcd");
  const auto body = whole.find('\n', whole.find("\nDATA ") + 1) + 1;
  for (const std::size_t at : {body, body + 4}) {
    std::string wrong = whole;
    for (const std::uint32_t size : {0u, 1u, 1000u, 0x7fffffffu, 0xffffffffu}) {
      std::memcpy(&wrong[at], &size, sizeof size);
      write("wrong.pcd", wrong);
      expectBadInput("wrong.pcd", "'"); // truncated or damaged
    }
  }
  std::string wrong = whole;
  for (std::size_t i = body + 8; i < wrong.size(); i += 3)
    wrong[i] = '\xff';
  write("wrong.pcd", wrong);
  expectBadInput("wrong.pcd", "damaged");
}

TEST_F(BadFiles, HeadersThatClaimTooMuch)
{
  for (const char* name : {"ascii.pcd", "binary.pcd", "binary_compressed.pcd"}) {
    write("a.pcd", withLine(name, "WIDTH", "WIDTH 40000"));
    write("b.pcd", withLine("a.pcd", "HEIGHT", "HEIGHT 40000"));
    write("huge.pcd", withLine("b.pcd", "POINTS", "POINTS 1600000000"));
    expectBadInput("huge.pcd", "truncated");

    write("a.pcd", withLine(name, "WIDTH", "WIDTH 65536"));
    write("b.pcd", withLine("a.pcd", "HEIGHT", "HEIGHT 65536"));
    write("overflow.pcd", withLine("b.pcd", "POINTS", "POINTS 4294967296"));
    expectBadInput("overflow.pcd", "more points");
    write("overflow.pcd", withLine("b.pcd", "POINTS", "POINTS 0"));
    expectBadInput("overflow.pcd", "no points");
    write("overflow.pcd", withLine("b.pcd", "POINTS", "POINTS 99999999999999999999"));
    expectBadInput("overflow.pcd", "POINTS");

    write("count.pcd", withLine(name, "COUNT", "COUNT 1 1 1 1 1 1 1000000000 1"));
    expectBadInput("count.pcd", "'");
    write("count.pcd", withLine(name, "COUNT", "COUNT 1 1 1 1 1 1 -3 1"));
    expectBadInput("count.pcd", "'");
    write("size.pcd", withLine(name, "SIZE", "SIZE 4 4 4 4 2 8 1000000 4"));
    expectBadInput("size.pcd", "'");
    write("size.pcd", withLine(name, "SIZE", "SIZE 4 4 4 4 2 8 0 4"));
    expectBadInput("size.pcd", "'");
    write("type.pcd", withLine(name, "TYPE", "TYPE F F F F U F"));
    expectBadInput("type.pcd", "'");
    write("points.pcd", withLine(name, "POINTS", "POINTS 100"));
    expectBadInput("points.pcd", "is not the number of points");
  }
}

TEST_F(BadFiles, NotOrganizedOrEmpty)
{
  write("a.pcd", withLine("binary.pcd", "WIDTH", "WIDTH 19200"));
  write("unorganized.pcd", withLine("a.pcd", "HEIGHT", "HEIGHT 1"));
  expectBadInput("unorganized.pcd", "is not organized");
  write("a.pcd", withLine("binary.pcd", "WIDTH", "WIDTH 0"));
  write("b.pcd", withLine("a.pcd", "HEIGHT", "HEIGHT 0"));
  write("no_points.pcd", withLine("b.pcd", "POINTS", "POINTS 0"));
  expectBadInput("no_points.pcd", "no points");
}

TEST_F(BadFiles, WithoutCoordinates)
{
  write("no_z.pcd",
        withLine("binary.pcd", "FIELDS", "FIELDS x y depth rgb ring time tag label"));
  expectBadInput("no_z.pcd", "has no field 'z'");
  write("whole.pcd", withLine("binary.pcd", "TYPE", "TYPE F F I F U F U F"));
  expectBadInput("whole.pcd", "field 'z' that is not");
  for (std::size_t i = 0; i < TwoPlanes::POINTS; ++i)
    setField(scene_.cloud, i, "z", std::numeric_limits<float>::quiet_NaN());
  for (const char* format : {"ascii", "binary", "binary_compressed"}) {
    scene_.write(path("nan.pcd"), format);
    expectBadInput("nan.pcd", "no valid point");
  }
  for (std::size_t i = 0; i < TwoPlanes::POINTS; ++i)
    setField(scene_.cloud, i, "z", 3e7f);
  scene_.write(path("far.pcd"), "binary");
  expectBadInput("far.pcd", "metres");
}

TEST_F(BadFiles, OutputsThatCannotBeWritten)
{
  const std::string in = path("binary.pcd");
  std::filesystem::create_directory(path("folder.pcd"));
  expectFailure({in, path("missing/out.pcd")}, "there is no folder");
  expectFailure({in, path("folder.pcd")}, "it is a folder");
  for (const char* option : {"--models", "--label-image", "--overlay"}) {
    expectFailure({in, path("out.pcd"), option, path("missing/file")},
                  "there is no folder");
    expectFailure({in, path("out.pcd"), option, path("folder.pcd")}, "it is a folder");
  }
}

TEST_F(BadFiles, AFullDeviceIsAnErrorAndStaysWhereItIs)
{
  if (!std::filesystem::is_character_file("/dev/full"))
    GTEST_SKIP() << "no /dev/full here";
  std::filesystem::create_symlink("/dev/full", path("full"));
  for (const char* option :
       {"--models", "--label-image", "--overlay", "--ply", "--polygons",
        "--confidence-image", "--rest", "--save-parameters", "--figure"})
    expectFailure({path("binary.pcd"), option, path("full")}, "cannot write '");
  expectFailure({path("binary.pcd"), path("full")}, "cannot write '");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST_F(BadFiles, HelpThatIsNotTakenIsAnError)
{
  if (!std::filesystem::is_character_file("/dev/full"))
    GTEST_SKIP() << "no /dev/full here";
  for (const char* app : {PCL_MRF_PLANES_SEGMENTATION_APP,
                          PCL_MRF_PLANES_EVALUATION_APP, PCL_MRF_PLANES_SCENE_APP}) {
    const Outcome outcome =
        run("/bin/sh", {"-c", std::string("'") + app + "' --help >/dev/full"});
    EXPECT_EQ(outcome.status, 1) << app;
    EXPECT_NE(outcome.err.find("cannot write to standard output"), std::string::npos);
  }
}

TEST_F(BadFiles, WhatDoesNotFitOnTheDiskIsAnErrorInEveryFormat)
{
  for (const char* format : {"ascii", "binary", "binary_compressed"}) {
    write("out.pcd", "old");
    // No file may grow beyond a kilobyte, as on a disk that fills up.
    const Outcome outcome =
        run("/bin/sh", {"-c", "trap '' XFSZ; ulimit -f 2; exec \"$0\" \"$@\"",
                        PCL_MRF_PLANES_SEGMENTATION_APP, path("binary.pcd"),
                        path("out.pcd"), "--format", format});
    EXPECT_EQ(outcome.status, 1) << format << ": " << outcome.err;
    EXPECT_NE(outcome.err.find("check the space on the disk"), std::string::npos)
        << outcome.err;
    EXPECT_EQ(read("out.pcd"), "old") << "what was there before stays";
  }
}

TEST_F(BadFiles, AReadOnlyOutputStays)
{
  if (::geteuid() == 0)
    GTEST_SKIP() << "root may write everywhere";
  write("out.pcd", "old");
  std::filesystem::permissions(path("out.pcd"), std::filesystem::perms::owner_read);
  expectFailure({path("binary.pcd"), path("out.pcd")}, "ermission");
  EXPECT_EQ(read("out.pcd"), "old");
}

TEST_F(BadFiles, AFailureLeavesTheOldOutput)
{
  write("out.pcd", "old");
  write("out.json", "old");
  write("cut.pcd", read("binary.pcd").substr(0, 5000));
  const Outcome outcome =
      segment({path("cut.pcd"), path("out.pcd"), "--models", path("out.json")});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(read("out.pcd"), "old");
  EXPECT_EQ(read("out.json"), "old");
}

} // namespace pcl_mrf_planes::test
