// SPDX-License-Identifier: BSD-3-Clause
// Folders, patterns and lists of inputs become frames with names of their own.
#include "io_files.h"

#include <pcl/io/pcd_io.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

namespace pcl_mrf_planes::test {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

class FrameLists : public IoTest {
protected:
  void writeCloud(const std::string& name) const
  {
    pcl::PointCloud<pcl::PointXYZ> cloud(4, 3);
    pcl::io::savePCDFileBinary(path(name), cloud);
  }

  static Names namesOf(const io::FrameList& list)
  {
    Names names;
    for (const auto& frame : list.frames)
      names.push_back(frame.name);
    return names;
  }
};

TEST_F(FrameLists, FoldersAreWalkedInOrderAndOthersPassedOver)
{
  writeCloud("b/2.pcd");
  writeCloud("b/1.pcd");
  writeCloud("a.pcd");
  write("b/notes.txt", "no frame");
  write(".hidden.pcd", "no frame");
  const io::FrameList frames = list();
  EXPECT_EQ(namesOf(frames), (Names{"a", "b/1", "b/2"}));
  EXPECT_EQ(frames.passed_over.size(), 1u);
}

TEST_F(FrameLists, ContentCountsNotTheName)
{
  writeCloud("really_a_cloud.png");
  writePng16(path("depth.dat"), slantedWall(64, 48), 64, 48);
  EXPECT_EQ(namesOf(list()), (Names{"depth.dat", "really_a_cloud"}));
}

TEST_F(FrameLists, OfFilesForTheSameFrameTheCloudIsTaken)
{
  writeCloud("x.pcd");
  writePng16(path("x.depth.png"), slantedWall(64, 48), 64, 48);
  writePng16(path("x.gt.png"), slantedWall(64, 48), 64, 48); // labels are no depth
  const io::FrameList frames = list();
  ASSERT_EQ(namesOf(frames), (Names{"x"}));
  EXPECT_EQ(frames.frames[0].reader, "pcd");
  EXPECT_EQ(io::listFrames({path("x.depth.png")}, {}).frames[0].reader, "depth-image")
      << "but one that is named is taken";
}

TEST_F(FrameLists, LoopsOfLinksEnd)
{
  writeCloud("a/1.pcd");
  fs::create_directory_symlink(path(""), path("a/up"));
  fs::create_directory_symlink(path("a"), path("b"));
  fs::create_symlink(path("nowhere"), path("a/broken.pcd"));
  EXPECT_EQ(namesOf(list()), (Names{"a/1"}));
}

TEST_F(FrameLists, TheFolderOfTheResultsIsNoInput)
{
  writeCloud("1.pcd");
  writeCloud("results/1.pcd");
  EXPECT_EQ(io::listFrames({path("")}, {}, path("results")).frames.size(), 1u);
}

TEST_F(FrameLists, PatternsAndSeveralInputs)
{
  writeCloud("one/1.pcd");
  writeCloud("two/1.pcd");
  EXPECT_EQ(namesOf(list("*/1.pcd")), (Names{"one/1", "two/1"}));
  EXPECT_EQ(namesOf(io::listFrames({path("one"), path("two")}, {})),
            (Names{"one/1", "two/1"}));
  const Names whole = namesOf(
      io::listFrames({path("one/1.pcd"), path("two/1.pcd"), path("two/1.pcd")}, {}));
  ASSERT_EQ(whole.size(), 2u) << "a file that is named twice is one frame";
  EXPECT_NE(whole[0], whole[1]) << "and frames of the same name are kept apart";
}

TEST_F(FrameLists, NothingToReadIsAnError)
{
  EXPECT_THROW(list("*.pcd"), std::runtime_error);
  fs::create_directory(path("empty"));
  EXPECT_THROW(list("empty"), std::runtime_error);
  EXPECT_THROW(io::listFrames({path("empty")}, {}, path("empty")), std::runtime_error);
  expectError("missing.pcd", {"does not exist"});
  write("text.txt", "hello");
  expectError("text.txt", {"none of the files that can be read", "PCLZF"});
  write("a.pcd.gz", "\x1f\x8b 123");
  expectError("a.pcd.gz", {"compressed", "unpack"});
}

TEST_F(FrameLists, OneBadInputAmongSeveralIsOneBadFrame)
{
  writeCloud("good/1.pcd");
  fs::create_directory(path("empty"));
  const io::FrameList frames =
      io::listFrames({path("good"), path("empty"), path("no*.pcd")}, {});
  ASSERT_EQ(frames.frames.size(), 3u);
  EXPECT_NO_THROW(frames.frames[0].read());
  EXPECT_THROW(frames.frames[1].read(), std::runtime_error);
  EXPECT_THROW(frames.frames[2].read(), std::runtime_error);
}

} // namespace pcl_mrf_planes::test
