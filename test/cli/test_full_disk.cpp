// SPDX-License-Identifier: BSD-3-Clause
// A disk that is full, or fills up, while a folder is written.
#include "batch_test.h"

#include <gmock/gmock.h>

namespace pcl_mrf_planes::test {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

class FullDisk : public BatchTest {
protected:
  /// The app, where no file may grow beyond so many half kilobytes. What it says goes
  /// through a pipe, for which there is no limit.
  Outcome runWithin(const std::string& limit, std::vector<std::string> arguments) const
  {
    arguments.insert(arguments.begin(),
                     {"-c",
                      "set -o pipefail; trap '' XFSZ; (ulimit -f " + limit +
                          "; exec \"$0\" \"$@\") 2>&1 | cat; exit \"${PIPESTATUS[0]}\"",
                      PCL_MRF_PLANES_SEGMENTATION_APP});
    return run("/bin/bash", arguments);
  }
};

TEST_F(FullDisk, IsReportedForEachKindOfOutputOfAFrame)
{
  writeScene("in/1.pcd");
  for (const std::string kind : {"cloud", "labels", "overlay", "masks", "ply"}) {
    const Outcome outcome = runWithin(
        "0", {path("in"), "--output-folder", path("out-" + kind), "--write", kind});
    EXPECT_NE(outcome.status, 0) << kind;
    EXPECT_THAT(outcome.out, HasSubstr("cannot write '" + path("out-" + kind) + "/1."));
    EXPECT_THAT(outcome.out, HasSubstr("check the space on the disk"));
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(path("out-" + kind)))
      EXPECT_TRUE(entry.is_directory()) << entry.path();
  }
}

TEST_F(FullDisk, LeavesNoReportOfAFrameThatIsNotThereAsAWhole)
{
  writeScene("in/1.pcd");
  writeScene("in/2.pcd");
  // The report and the table have their room, a hundred kilobytes of points have not.
  const Outcome outcome = runWithin("60", {path("in"), "--output-folder", path("out"),
                                           "--write", "ply", "--jobs", "2"});
  EXPECT_EQ(outcome.status, 3) << outcome.out;
  EXPECT_THAT(outcome.out, HasSubstr("2 frames: 0 done, 2 failed"));
  EXPECT_THAT(partialFiles(), IsEmpty());
  EXPECT_FALSE(exists("out/1.json")) << "--resume would leave the frame out";
  EXPECT_FALSE(exists("out/1.ply"));
  EXPECT_THAT(rows("out/summary.csv"), ::testing::SizeIs(2));
  EXPECT_EQ(batch({"--write", "ply", "--resume"}).status, 0);
  EXPECT_TRUE(exists("out/1.json"));
  EXPECT_TRUE(exists("out/2.ply"));
}

TEST_F(FullDisk, IsReportedForAFolderOfMasks)
{
  scene_.write(path("in.pcd"), "binary");
  const Outcome outcome = runWithin("0", {path("in.pcd"), "--masks", path("masks")});
  EXPECT_EQ(outcome.status, 1) << outcome.out;
  EXPECT_THAT(outcome.out, HasSubstr("masks/plane_001.png"));
  EXPECT_THAT(outcome.out, HasSubstr("check the space on the disk"));
  EXPECT_THAT(partialFiles(), IsEmpty());
  EXPECT_FALSE(exists("masks/plane_001.png"));
}

} // namespace pcl_mrf_planes::test
