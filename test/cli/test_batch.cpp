// SPDX-License-Identifier: BSD-3-Clause
// Many frames in one call: trees, tables, threads, parts, broken frames, interruption.
#include "batch_test.h"

#include <gmock/gmock.h>

#include <cstdlib>

namespace pcl_mrf_planes::test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

class Batch : public BatchTest {};

TEST_F(Batch, MirrorsTheTreeAndSumsUp)
{
  writeScene("in/a/1.pcd");
  writeScene("in/a/b/2.pcd");
  writeDepth("in/3.depth.png");
  write("in/camera.json", R"({"fx": 150, "fy": 150, "cx": 80, "cy": 60})");
  const Outcome outcome = batch({"--write", "cloud,labels,overlay,masks,ply"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "") << "no bar where there is no terminal";
  EXPECT_THAT(outcome.out, HasSubstr("3 frames: 3 done"));
  for (const std::string start : {"out/a/1", "out/a/b/2", "out/3"}) {
    for (const char* end : {".json", ".pcd", ".labels.png", ".overlay.png", ".ply",
                            ".masks/plane_001.png"})
      EXPECT_TRUE(exists(start + end)) << start << end;
  }
  EXPECT_TRUE(exists("out/a/1.masks/plane_002.png"));
  EXPECT_FALSE(exists("out/a/1.masks/plane_003.png")) << "two planes";
  EXPECT_FALSE(exists("out/3.masks/plane_002.png")) << "one wall";
  const auto table = rows("out/summary.csv");
  ASSERT_THAT(table, SizeIs(3));
  EXPECT_EQ(table[0].compare(0, 23, "3,done,depth-image,1,19"), 0) << table[0];
  EXPECT_EQ(table[1].compare(0, 15, "a/1,done,pcd,2,"), 0) << table[1];

  const Json report = Json::parse(read("out/3.json"));
  EXPECT_EQ(report["reader"], "depth-image");
  EXPECT_EQ(report["camera"]["fx"], 150.0);
  EXPECT_TRUE(report.contains("timing"));
  EXPECT_NEAR(report["planes"][0]["coefficients"][3], 2.0, 1e-3)
      << "the wall is 2 m away";
}

TEST_F(Batch, ResultsAreThoseOfSingleRunsForAnyNumberOfJobs)
{
  for (const char* name : {"in/1.pcd", "in/2.pcd", "in/3.pcd", "in/4.pcd"})
    writeScene(name);
  ASSERT_EQ(batch({"--write", "labels,ply,cloud,overlay", "--jobs", "3"}).status, 0);
  ASSERT_EQ(
      segment({path("in/3.pcd"), path("one.pcd"), "--label-image", path("one.png"),
               "--ply", path("one.ply"), "--overlay", path("over.png")})
          .status,
      0);
  EXPECT_EQ(read("out/3.labels.png"), read("one.png"));
  EXPECT_EQ(read("out/3.ply"), read("one.ply"));
  EXPECT_EQ(read("out/3.pcd"), read("one.pcd"));
  EXPECT_EQ(read("out/3.overlay.png"), read("over.png"));
  EXPECT_EQ(read("out/1.labels.png"), read("out/4.labels.png"));
}

TEST_F(Batch, BrokenFramesAreReportedAndTheOthersGoOn)
{
  writeScene("in/1.pcd");
  writeScene("in/3.pcd");
  write("in/2.pcd", read("in/1.pcd").substr(0, 3000));
  writeDepth("in/no_camera.depth.png");
  const Outcome outcome = batch({"--jobs", "2"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, HasSubstr("in/2.pcd' is truncated"));
  EXPECT_THAT(outcome.err,
              HasSubstr("in/no_camera.depth.png' is a depth image without"));
  EXPECT_THAT(outcome.out, HasSubstr("4 frames: 2 done, 2 failed"));
  EXPECT_TRUE(exists("out/1.json"));
  EXPECT_TRUE(exists("out/3.json"));
  EXPECT_FALSE(exists("out/2.json"));
  EXPECT_FALSE(exists("out/2.labels.png"));
  EXPECT_THAT(rows("out/summary.csv")[1], HasSubstr("2,failed,pcd,,,,,"));
}

TEST_F(Batch, ResumeDoesWhatIsMissingOrWasDoneOtherwise)
{
  for (const char* name : {"in/1.pcd", "in/2.pcd", "in/3.pcd"})
    writeScene(name);
  ASSERT_EQ(batch({}).status, 0);
  EXPECT_THAT(batch({"--resume"}).out, HasSubstr("0 done, 3 there before"));
  fs::remove(path("out/2.labels.png"));
  write("out/3.json", read("out/3.json").substr(0, 200)); // of another's making
  const Outcome outcome = batch({"--resume"});
  EXPECT_THAT(outcome.out, HasSubstr("2 done, 1 there before"));
  EXPECT_TRUE(exists("out/2.labels.png"));
  EXPECT_THAT(rows("out/summary.csv")[0], HasSubstr("1,there before,pcd,2,"))
      << "the table is whole all the same";
  EXPECT_THAT(batch({"--resume", "--min-points", "77"}).out, HasSubstr("3 done"))
      << "other parameters give other results";
  EXPECT_THAT(batch({"--resume", "--min-points", "77", "--outlines"}).out,
              HasSubstr("3 done"))
      << "a report without outlines is not the one that is asked for";
  EXPECT_THAT(batch({"--resume", "--min-points", "77", "--outlines"}).out,
              HasSubstr("0 done, 3 there before"));
  EXPECT_THAT(batch({"--resume", "--write", "ply"}).out, HasSubstr("3 done"))
      << "an output that is not there yet";
}

TEST_F(Batch, PartsMakeUpTheWhole)
{
  std::vector<std::string> all;
  for (int i = 1; i <= 7; ++i) {
    all.push_back(std::to_string(i));
    writeScene("in/" + all.back() + ".pcd");
  }
  std::vector<std::string> names;
  for (int part = 1; part <= 3; ++part) {
    const Outcome list =
        segment({path("in"), "--list", "--shard", std::to_string(part) + "/3"});
    std::istringstream lines(list.out);
    for (std::string line; std::getline(lines, line);)
      names.push_back(line.substr(0, line.find('\t')));
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, all) << "each frame in one part";
  ASSERT_EQ(batch({"--shard", "2/3"}).status, 0);
  EXPECT_TRUE(exists("out/2.json"));
  EXPECT_TRUE(exists("out/5.json"));
  EXPECT_FALSE(exists("out/1.json"));
  EXPECT_THAT(rows("out/summary-2-of-3.csv"), SizeIs(2));
  ASSERT_EQ(
      segment({path("in/1.pcd"), "--output-folder", path("none"), "--shard", "2/2"})
          .status,
      0)
      << "a part may have no frame";
}

TEST_F(Batch, GnuParallelSpreadsTheParts)
{
  const std::string script = PCL_MRF_PLANES_SOURCE "/doc/cluster/parallel.sh";
  if (!fs::exists("/usr/bin/parallel"))
    GTEST_SKIP() << "GNU parallel is not installed";
  for (int i = 1; i <= 5; ++i)
    writeScene("in/it's " + std::to_string(i) +
               ".pcd"); // names that a shell would split
  const std::vector<std::pair<std::string, std::string>> environment = {
      {"APP", PCL_MRF_PLANES_SEGMENTATION_APP}, {"OPTIONS", "--write labels,ply"}};
  const auto spread = [&] {
    return run("/bin/bash", {script, "3", path("out"), path("in")}, environment);
  };
  const Outcome outcome = spread();
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(rows("out/summary.csv"), SizeIs(5));
  for (int i = 1; i <= 5; ++i)
    EXPECT_TRUE(exists("out/it's " + std::to_string(i) + ".ply"));
  write("in/it's 6.pcd", "broken");
  EXPECT_EQ(spread().status, 1) << "one part has a broken frame";
  EXPECT_THAT(rows("out/summary.csv"), SizeIs(6));
}

TEST_F(Batch, AnInterruptedRunFinishesItsFramesAndIsContinued)
{
  for (int i = 100; i < 140; ++i)
    writeScene("in/" + std::to_string(i) + ".pcd");
  const std::string command = std::string("'") + PCL_MRF_PLANES_SEGMENTATION_APP +
                              "' '" + path("in") + "' --output-folder '" + path("out") +
                              "' --jobs 2 --repeat 200 & pid=$!; " + "until [ -e '" +
                              path("out/101.json") + "' ]; do sleep 0.01; done; " +
                              "kill -INT $pid; wait $pid";
  const Outcome outcome = run("/bin/bash", {"-c", command});
  EXPECT_EQ(outcome.status, 130) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("not reached"));
  EXPECT_THAT(partialFiles(), IsEmpty());
  EXPECT_THAT(rows("out/summary.csv"), SizeIs(40));
  const Outcome rest = batch({"--resume"});
  EXPECT_EQ(rest.status, 0);
  EXPECT_THAT(rest.out, HasSubstr("there before"));
  EXPECT_FALSE(exists("out/140.json"));
  for (int i = 100; i < 140; ++i)
    EXPECT_TRUE(exists("out/" + std::to_string(i) + ".json"));
}

TEST_F(Batch, ASecondInterruptionEndsAtOnceWithoutHalfFiles)
{
  for (int i = 100; i < 140; ++i)
    writeScene("in/" + std::to_string(i) + ".pcd");
  const std::string command = std::string("'") + PCL_MRF_PLANES_SEGMENTATION_APP +
                              "' '" + path("in") + "' --output-folder '" + path("out") +
                              "' --write cloud,labels,overlay,ply --jobs 2 --repeat "
                              "400 & pid=$!; until [ -e '" +
                              path("out/103.json") + "' ]; do sleep 0.01; done; " +
                              "kill -INT $pid; kill -TERM $pid; wait $pid";
  const Outcome outcome = run("/bin/bash", {"-c", command});
  EXPECT_GT(outcome.status, 128);
  EXPECT_THAT(partialFiles(), IsEmpty());
}

TEST_F(Batch, ABarIsDrawnOnATerminal)
{
  if (!fs::exists("/usr/bin/script"))
    GTEST_SKIP() << "script(1) is not installed";
  writeScene("in/1.pcd");
  writeScene("in/2.pcd");
  const std::string command = std::string("'") + PCL_MRF_PLANES_SEGMENTATION_APP +
                              "' '" + path("in") + "' --output-folder '" + path("out") +
                              "'";
  const Outcome shown = run("/usr/bin/script", {"-qec", command, "/dev/null"});
  EXPECT_EQ(shown.status, 0);
  EXPECT_THAT(shown.out, HasSubstr("] 1/2"));
  EXPECT_THAT(shown.out, HasSubstr("frames/s, "));
  EXPECT_THAT(shown.out, HasSubstr(" left"));
  const Outcome quiet =
      run("/usr/bin/script", {"-qec", command + " --quiet", "/dev/null"});
  EXPECT_THAT(quiet.out, Not(HasSubstr("frames/s")));
}

TEST_F(Batch, TruthOfADataSetIsWrittenForTheEvaluation)
{
  // SynPEB has it in the field intensity.
  for (std::size_t i = 0; i < TwoPlanes::POINTS; ++i)
    setField(scene_.cloud, i, "label", static_cast<float>(9 + TwoPlanes::label(i)));
  std::find_if(scene_.cloud.fields.begin(), scene_.cloud.fields.end(),
               [](const auto& f) { return f.name == "label"; })
      ->name = "intensity";
  writeScene("in/synpeb/pc_01.pcd");
  writeScene("in/other.pcd");
  ASSERT_EQ(batch({"--write", "labels,truth"}).status, 0);
  EXPECT_FALSE(exists("out/other.gt.png"));
  const Outcome scores =
      run(PCL_MRF_PLANES_EVALUATION_APP,
          {"--truth", path("out"), "--labels", path("out"), "--json", path("s.json")});
  ASSERT_EQ(scores.status, 0) << scores.err;
  EXPECT_THAT(scores.out, HasSubstr("synpeb"));
  const Json score = Json::parse(read("s.json"));
  EXPECT_EQ(score["frames"][0]["truth"], 2);
  EXPECT_EQ(score["frames"][0]["correct"], 2) << "wall and floor are found";
}

TEST_F(Batch, RealFramesAllHavePlanes)
{
  const char* data = std::getenv("PCL_MRF_PLANES_DATA");
  if (data == nullptr)
    GTEST_SKIP() << "PCL_MRF_PLANES_DATA names no folder";
  const Outcome outcome = segment(
      {data, "--output-folder", path("out"), "--jobs", "2", "--write", "overlay"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const auto table = rows("out/summary.csv");
  EXPECT_GT(table.size(), 0u);
  for (const std::string& row : table)
    EXPECT_EQ(row.find(",0,"), std::string::npos) << "no plane: " << row;
}

TEST_F(Batch, InputsFromAFileAndByPattern)
{
  writeScene("in/x/1.pcd");
  writeScene("in/y/1.pcd");
  write("list.txt",
        "# two of them\n" + path("in/x/1.pcd") + "\n\n" + path("in/y") + "\n");
  const Outcome list = segment({"--inputs-from", path("list.txt"), "--list"});
  EXPECT_EQ(std::count(list.out.begin(), list.out.end(), '\n'), 2) << list.out;
  const Outcome pattern = segment({path("in") + "/*/1.pcd", "--list"});
  EXPECT_THAT(pattern.out, HasSubstr("x/1\tpcd\t"));
  EXPECT_THAT(pattern.out, HasSubstr("y/1\tpcd\t"));
}

TEST_F(Batch, WrongOptionsAreSaid)
{
  writeScene("in/1.pcd");
  const auto expectUsage = [&](const std::vector<std::string>& arguments,
                               const std::string& message) {
    const Outcome outcome = segment(arguments);
    EXPECT_EQ(outcome.status, 2) << message;
    EXPECT_THAT(outcome.err, HasSubstr(message));
    EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << outcome.err;
  };
  const std::string in = path("in"), out = path("out");
  expectUsage({in, "--output-folder", out, "--write", "labels,stars"}, "'stars'");
  expectUsage({in, "--output-folder", out, "--shard", "0/3"}, "--shard");
  expectUsage({in, "--output-folder", out, "--shard", "4/3"}, "--shard");
  expectUsage({in, "--output-folder", out, "--shard", "2"}, "2/8");
  expectUsage({in, "--output-folder", out, "--jobs", "-1"}, "--jobs");
  expectUsage({in, "--output-folder", out, "--models", "m.json"}, "--write");
  expectUsage({"--output-folder", out}, "no input");
  expectUsage({in, out, "--jobs", "2"}, "--output-folder");
  expectUsage({in, out, "--resume"}, "--output-folder");
  expectUsage({in, out, "third.pcd"}, "--output-folder");
  expectUsage({in, "--output-folder", out, "--camera", "kinect7"}, "known are");
  expectUsage({in, "--output-folder", out, "--size", "640"}, "640x480");
  expectUsage({in, "--output-folder", out, "--inputs-from", path("no")}, "cannot read");
  write("file", "");
  const Outcome outcome = segment({in, "--output-folder", path("file")});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, HasSubstr("cannot create the folder"));
}

} // namespace pcl_mrf_planes::test
