// SPDX-License-Identifier: BSD-3-Clause
// The evaluation as a program: files, folders, options and outputs.
#include "evaluation_test.h"

#include <algorithm>
#include <sstream>

namespace pcl_mrf_planes::test {

using reference::drawn;
using Json = nlohmann::json;

TEST_F(EvaluationApp, PairsOfFiles)
{
  writeLabels(path("truth.png"), TRUTH);
  writeLabels(path("merged.png"), MERGED);
  writeLabelCloud(path("merged.pcd"), MERGED);
  writeLabelCloud(path("truth.pcd"), TRUTH);
  const Json json = report({path("truth.png"), path("truth.png"), path("truth.png"),
                            path("merged.pcd"), path("truth.pcd"), path("merged.png")});
  ASSERT_EQ(json["frames"].size(), 3u);
  EXPECT_EQ(json["frames"][0]["pq"], 1.0);
  EXPECT_EQ(json["frames"][1]["under"], 1.0);
  EXPECT_EQ(json["frames"][1]["correct"], 1.0);
  EXPECT_EQ(json["frames"][1]["name"], "merged.pcd");
  EXPECT_EQ(json["frames"][2]["pq"], json["frames"][1]["pq"]);
  EXPECT_EQ(json["all"]["frames"], 3);
  EXPECT_NEAR(json["all"]["ratio"].get<double>(), 5.0 / 9.0, 1e-12);
  EXPECT_TRUE(json["sets"].empty());
  EXPECT_FALSE(json.contains("mean_of_sets"));
  const Outcome outcome = evaluate({path("truth.png"), path("merged.png"), "--each"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_NE(outcome.out.find("merged.png"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("all frames"), std::string::npos) << outcome.out;
}

TEST_F(EvaluationApp, FoldersOfSets)
{
  writeSets();
  const std::vector<std::string> folders = {"--truth", path("truth"), "--labels",
                                            path("result")};
  const Json json = report(folders);
  ASSERT_EQ(json["sets"].size(), 2u);
  EXPECT_EQ(json["sets"][0]["set"], "one");
  EXPECT_EQ(json["sets"][0]["frames"], 2);
  EXPECT_EQ(json["sets"][1]["set"], "two/deep");
  EXPECT_EQ(json["sets"][1]["pq"], 1.0);
  const double first = json["sets"][0]["pq"];
  EXPECT_NEAR(json["mean_of_sets"]["pq"].get<double>(), (first + 1.0) / 2.0, 1e-12);
  EXPECT_NEAR(json["all"]["pq"].get<double>(), (2.0 * first + 1.0) / 3.0, 1e-12);
  EXPECT_EQ(json["frames"][1]["name"], "b");
  EXPECT_TRUE(json["frames"][1]["files"]["labels"].is_null());
  EXPECT_EQ(json["frames"][1]["missed"], 3.0) << "no result counts as an empty one";
  EXPECT_EQ(json["frames"][1]["recall"], 0.0);

  const Outcome outcome = evaluate(folders);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  for (const char* text : {"one", "two/deep", "mean of sets", "all frames",
                           "1 of 3 frames have no result and count as empty: one/b"})
    EXPECT_NE(outcome.out.find(text), std::string::npos) << text << outcome.out;
  EXPECT_EQ(outcome.out.find("one/a"), std::string::npos) << "only with --each";
}

TEST_F(EvaluationApp, OneFolderIsOneSet)
{
  writeLabels(path("data/a.gt.png"), TRUTH);
  writeLabels(path("data/.hidden.gt.png"), MERGED);
  writeLabels(path("data/b.truth.png"), MERGED);
  writeLabelCloud(path("data/a.pcd"), MERGED);
  for (const char* folder : {"data", "data/"}) {
    const Json json = report({"--truth", path(folder), "--labels", path(folder)});
    EXPECT_EQ(json["frames"].size(), 1u);
    EXPECT_EQ(json["frames"][0]["under"], 1.0) << "a.pcd is the result";
    EXPECT_EQ(json["frames"][0]["set"], "");
    EXPECT_TRUE(json["sets"].empty());
  }
  const Json other = report({"--truth", path("data"), "--labels", path("data"),
                             "--suffix", "truth.png", "--suffix", "gt.png"});
  EXPECT_EQ(other["frames"].size(), 2u);
}

TEST_F(EvaluationApp, Options)
{
  // Plane 1: 7 of 10 points; plane 2: two points.
  writeLabels(path("a.gt.png"), drawn({"111111111122", "0000000000xx"}));
  writeLabels(path("a.png"), drawn({"111111100033", "4400000000xx"}));
  const std::vector<std::string> pair = {path("a.gt.png"), path("a.png")};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = pair;
    arguments.insert(arguments.end(), more.begin(), more.end());
    return report(arguments);
  };
  const Json plain = with({});
  EXPECT_EQ(plain["all"]["correct"], 1.0);
  EXPECT_EQ(plain["all"]["clutter"], 0.2);
  EXPECT_EQ(plain["options"]["tolerance"], 0.8);
  EXPECT_EQ(with({"--tolerance", "0.7"})["all"]["correct"], 2.0);
  EXPECT_EQ(with({"--min-points", "2"})["all"]["truth"], 1.0);
  EXPECT_TRUE(with({"--incomplete"})["all"]["clutter"].is_null());
  const Json borders = with({"--border", "0", "--border", "3"});
  EXPECT_LT(borders["all"]["border_0_recall"], 1.0);
  EXPECT_EQ(borders["all"]["border_3_recall"], 1.0);
  const Json curve = with({"--curve"})["all"]["curve"];
  ASSERT_EQ(curve.size(), 10u);
  EXPECT_EQ(curve[0]["tolerance"], 0.51);
  EXPECT_EQ(curve[0]["correct"], 2);
  EXPECT_EQ(curve[9]["correct"], 1);
  EXPECT_EQ(curve[9]["truth"], 2);
}

TEST_F(EvaluationApp, ErrorsOfPlanes)
{
  writeLabels(path("truth/a.gt.png"), TRUTH);
  writeLabels(path("truth/b.gt.png"), TRUTH);
  writeLabels(path("result/a.png"), TRUTH);
  writeLabels(path("result/b.png"), TRUTH);
  writeLabelCloud(path("clouds/a.pcd"), TRUTH);
  const std::vector<std::string> arguments = {
      "--truth", path("truth"), "--labels", path("result"), "--cloud", path("clouds")};
  expectFailure(arguments, 1, "b.pcd' does not exist");
  writeLabelCloud(path("clouds/b.pcd"), TRUTH);
  const Json json = report(arguments);
  EXPECT_EQ(json["all"]["matching_planes"], 4) << "row 3 of each is on a line";
  EXPECT_NEAR(json["all"]["angle_deg_most"].get<double>(), 0.0, 1e-4);
  ASSERT_EQ(json["frames"][0]["planes"].size(), 2u);
  EXPECT_EQ(json["frames"][0]["planes"][1]["truth"], 2);
  EXPECT_NE(evaluate(arguments).out.find("planes that match"), std::string::npos);
  EXPECT_EQ(report({path("truth/a.gt.png"), path("result/b.png"), "--cloud",
                    path("clouds")})["all"]["matching_planes"],
            2);
  writeLabelCloud(path("clouds/b.pcd"), drawn({"11", "11"}));
  expectFailure(arguments, 1, "does not belong to");
}

TEST_F(EvaluationApp, CommaSeparatedValues)
{
  writeSets();
  writeLabels(path("truth/one/odd, \"name\".gt.png"), TRUTH);
  const Outcome outcome =
      evaluate({"--truth", path("truth"), "--labels", path("result"), "--border", "1",
                "--csv", path("table.csv")});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  std::istringstream lines(read("table.csv"));
  std::vector<std::string> all;
  for (std::string line; std::getline(lines, line);)
    all.push_back(line);
  ASSERT_EQ(all.size(), 1u + 4u + 2u + 2u) << "header, frames, sets, means";
  EXPECT_EQ(all[0].find("kind,set,name,has_labels,frames,ratio,truth,correct,"), 0u);
  EXPECT_NE(all[0].find(",border_1_precision,"), std::string::npos);
  EXPECT_EQ(all[1].find("frame,one,a,1,1,"), 0u) << all[1];
  EXPECT_EQ(all[2].find("frame,one,b,0,1,"), 0u) << all[2];
  EXPECT_EQ(all[3].find("frame,one,\"odd, \"\"name\"\"\",0,1,"), 0u) << all[3];
  EXPECT_EQ(all[8].find("all frames,,,"), 0u) << all[8];
  const auto commas = [](const std::string& line) {
    return std::count(line.begin(), line.end(), ',');
  };
  EXPECT_EQ(commas(all[1]), commas(all[0]));
  EXPECT_EQ(commas(all[8]), commas(all[0]));
}

TEST_F(EvaluationApp, HelpAndVersion)
{
  for (const char* option : {"--help", "-h"})
    for (const char* text : {"--truth", "--labels", "--suffix", "--cloud", "--border",
                             "--curve", "--each", "--csv", "--json", "Exit status"})
      EXPECT_NE(evaluate({option}).out.find(text), std::string::npos) << text;
  EXPECT_EQ(evaluate({"--version"}).out.find("pcl_mrf_plane_evaluation "), 0u);
}

TEST_F(EvaluationApp, ScoresTheSegmentation)
{
  ASSERT_EQ(run(PCL_MRF_PLANES_SCENE_APP,
                {path("room.pcd"), "--truth", path("room.gt.png"), "--seed", "3"})
                .status,
            0);
  ASSERT_EQ(
      segment({path("room.pcd"), path("out.pcd"), "--label-image", path("out.png")})
          .status,
      0);
  const Json json = report(
      {path("room.gt.png"), path("out.png"), path("room.gt.png"), path("out.pcd")});
  EXPECT_GT(json["all"]["pq"], 0.5) << "a generated room is no hard case";
  Json first = json["frames"][0], second = json["frames"][1];
  for (Json* frame : {&first, &second}) {
    frame->erase("name");
    frame->erase("files");
  }
  EXPECT_EQ(first, second) << "picture and cloud carry the same labels";
}

} // namespace pcl_mrf_planes::test
