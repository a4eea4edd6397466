// SPDX-License-Identifier: BSD-3-Clause
// Inputs that are no frames, alone and among others; disks that are full.
#include "batch_test.h"

#include <gmock/gmock.h>

namespace pcl_mrf_planes::test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class BadInputs : public BatchTest {
protected:
  /// One line that has the file's name and all of \a parts; alone and in a batch.
  void expectBad(const std::string& name, const std::vector<std::string>& parts,
                 const std::vector<std::string>& options = {}) const
  {
    SCOPED_TRACE(name);
    std::vector<std::string> single = {path(name), path("out.pcd")};
    std::vector<std::string> many = {path(name), "--output-folder", path("out")};
    single.insert(single.end(), options.begin(), options.end());
    many.insert(many.end(), options.begin(), options.end());
    for (const auto& arguments : {single, many}) {
      const bool batch = arguments[1] == "--output-folder";
      const Outcome outcome = segment(arguments);
      EXPECT_EQ(outcome.status, batch ? 3 : 1) << outcome.err;
      EXPECT_THAT(outcome.err, HasSubstr(name));
      for (const std::string& part : parts)
        EXPECT_THAT(outcome.err, HasSubstr(part));
      EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << outcome.err;
      EXPECT_FALSE(exists("out.pcd"));
      EXPECT_THAT(partialFiles(), IsEmpty());
    }
  }
};

TEST_F(BadInputs, DepthImagesThatCannotBe)
{
  writeDepth("depth.png");
  expectBad("depth.png", {"without a camera", "--camera", "camera.json"});
  expectBad("depth.png", {"does not fit its camera", "outside"},
            {"--camera", "525,525,319.5,239.5"});
  expectBad("depth.png", {"does not fit its camera", "160 x 120", "512 x 424"},
            {"--camera", "kinect2"});
  write("depth.camera.json", R"({"fx": 150, "fy": 150, "cx": 80, "cy": 60,
                                 "width": 320, "height": 240})");
  expectBad("depth.png", {"320 x 240", "depth.camera.json"});
  write("depth.camera.json", "{\"fx\": 150");
  expectBad("depth.png", {"camera file", "cannot be understood"});
  write("depth.camera.json", R"({"fx": 150, "fy": 150, "cx": 80, "cy": 60})");
  write("cut.png", read("depth.png").substr(0, 200));
  expectBad("cut.png", {"truncated"}, {"--camera", "150,150,80,60"});
}

TEST_F(BadInputs, ADepthImageIsNotOverwrittenByACloud)
{
  writeDepth("depth.png");
  const std::string before = read("depth.png");
  const Outcome outcome =
      segment({path("depth.png"), path("depth.png"), "--camera", "150,150,80,60"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, HasSubstr("name another file"));
  EXPECT_EQ(read("depth.png"), before);
}

TEST_F(BadInputs, EightBitsWhereSixteenAreDue)
{
  std::vector<unsigned char> values(64 * 48, 100);
  pcl::io::saveCharPNGFile(path("depth8.png"), values.data(), 64, 48, 1);
  expectBad("depth8.png", {"8 bits a point", "have 16"}, {"--camera", "60,60,32,24"});
  write("depth8.pgm", "P5 2 2 255\n1234");
  expectBad("depth8.pgm", {"8 bits a point", "have 16"});
  std::vector<unsigned char> colours(3 * 64 * 48, 100);
  pcl::io::saveRgbPNGFile(path("rgb.png"), colours.data(), 64, 48);
  expectBad("rgb.png", {"colour", "gray"});
}

TEST_F(BadInputs, TruncatedFilesOfEveryKind)
{
  write("a.mat", std::string("\x89HDF\r\n\x1a\n") + std::string(100, '\0'));
  expectBad("a.mat", {"HDF5", "truncated or damaged"});
  write("a.pclzf", "PCLZF 123");
  expectBad("a.pclzf", {"truncated or damaged"});
  write("a.pgm", "P5 100 100 65535\n12345");
  expectBad("a.pgm", {"truncated", "20000 bytes"});
  write("a.ply", "ply\nformat ascii 1.0\nelement vertex 100\nproperty float x\n"
                 "end_header\n1\n");
  expectBad("a.ply", {"truncated"});
  write("a.pcd", "");
  expectBad("a.pcd", {"empty"});
  write("scene_1.depth", "1.5 2.5 3.5\n");
  expectBad("scene_1.depth", {"3 numbers", "640 x 480"});
  write("perc.test.1", "Rows: 512\nColumns: 512\n");
  expectBad("perc.test.1", {"ten lines"});
  write("x.pcd.gz", "\x1f\x8b\x08");
  expectBad("x.pcd.gz", {"unpack"});
  write("x.txt", "hello");
  expectBad("x.txt", {"none of the files that can be read"});
}

TEST_F(BadInputs, UnorganizedCloudsAreToldWhatWouldFit)
{
  write("a.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
                 "property float y\nproperty float z\nend_header\n"
                 "0 0 1\n1 0 1\n0 1 1\n1 1 1\n");
  expectBad("a.ply", {"is not organized", "num_cols", "--size"});
  write("a.pcd",
        "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
        "WIDTH 4\nHEIGHT 1\nPOINTS 4\nDATA ascii\n0 0 1\n1 0 1\n0 1 1\n1 1 1\n");
  expectBad("a.pcd", {"is not organized", "NaN", "--size"});
  expectBad("a.pcd", {"has 4 points", "3 x 3"}, {"--size", "3x3"});
  EXPECT_EQ(segment({path("a.pcd"), path("out.pcd"), "--size", "2x2"}).status, 0);
}

TEST_F(BadInputs, MixedFoldersAndLoopsOfLinks)
{
  writeScene("in/good.pcd");
  write("in/notes.txt", "hello");
  write("in/cut.mat", std::string("\x89HDF\r\n\x1a\n"));
  fs::create_directory_symlink(path("in"), path("in/loop"));
  fs::create_symlink(path("in/loop2"), path("in/loop2"));
  const Outcome outcome = batch({});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.out, HasSubstr("1 files that are no frames passed over"));
  EXPECT_THAT(outcome.out, HasSubstr("2 frames: 1 done, 1 failed"));
  EXPECT_TRUE(exists("out/good.json"));
  EXPECT_FALSE(exists("out/loop/good.json"));
}

TEST_F(BadInputs, AFolderNeedsAPlaceForItsResults)
{
  writeScene("in/good.pcd");
  const Outcome outcome = segment({path("in"), path("out.pcd")});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, HasSubstr("give --output-folder"));
  fs::create_directory(path("empty"));
  EXPECT_THAT(segment({path("empty"), "--output-folder", path("out")}).err,
              HasSubstr("has no file that can be read"));
  EXPECT_THAT(segment({path("*.nothing"), "--output-folder", path("out")}).err,
              HasSubstr("fits no file"));
}

TEST_F(BadInputs, AFullDiskLeavesNoHalfFiles)
{
  // A limit on the size of files stands for a full disk: root has no other without
  // mounting one.
  writeScene("in/1.pcd");
  writeScene("in/2.pcd");
  for (const char* output : {"cloud", "ply", "overlay"}) {
    SCOPED_TRACE(output);
    fs::remove_all(path("out"));
    const std::string command = std::string("trap '' XFSZ; ulimit -f 2; '") +
                                PCL_MRF_PLANES_SEGMENTATION_APP + "' '" + path("in") +
                                "' --output-folder '" + path("out") + "' --write " +
                                output;
    const Outcome outcome = run("/bin/bash", {"-c", command});
    EXPECT_EQ(outcome.status, 3) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("cannot write '"));
    EXPECT_THAT(outcome.out, HasSubstr("2 failed"));
    EXPECT_FALSE(exists("out/1.json")) << "not all files of the frame are there";
    EXPECT_THAT(partialFiles(), IsEmpty());
    EXPECT_TRUE(exists("out/summary.csv"));
  }
}

} // namespace pcl_mrf_planes::test
