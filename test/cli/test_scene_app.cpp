// SPDX-License-Identifier: BSD-3-Clause
// The scene generator as a program, and its scenes through the segmentation.
#include "cli_test.h"

#include <nlohmann/json.hpp>
#include <pcl/PCLPointCloud2.h>
#include <pcl/io/pcd_io.h>

namespace pcl_mrf_planes::test {

class SceneApp : public CliTest {
protected:
  Outcome scene(const std::vector<std::string>& arguments) const
  {
    return run(PCL_MRF_PLANES_SCENE_APP, arguments);
  }
};

TEST_F(SceneApp, WritesACloudAndItsTruth)
{
  const Outcome outcome =
      scene({path("scene.pcd"), "--truth", path("truth.png"), "--planes",
             path("planes.json"), "--seed", "3", "--width", "160", "--height", "120"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(files(), (std::set<std::string>{"planes.json", "scene.pcd", "truth.png"}));
  pcl::PCLPointCloud2 cloud;
  ASSERT_GE(pcl::PCDReader().readHeader(path("scene.pcd"), cloud), 0);
  EXPECT_EQ(cloud.width, 160u);
  EXPECT_EQ(cloud.height, 120u);
  EXPECT_FALSE(nlohmann::json::parse(read("planes.json"))["planes"].empty());
}

TEST_F(SceneApp, IsTheSameForASeed)
{
  const std::vector<std::string> size = {"--width", "80", "--height", "60", "--seed"};
  const auto bits = [&](const std::string& seed) {
    std::vector<std::string> arguments = {path("scene.pcd")};
    arguments.insert(arguments.end(), size.begin(), size.end());
    arguments.push_back(seed);
    EXPECT_EQ(scene(arguments).status, 0);
    return read("scene.pcd");
  };
  const std::string first = bits("1");
  EXPECT_TRUE(bits("1") == first);
  EXPECT_FALSE(bits("2") == first);
}

TEST_F(SceneApp, ItsScenesCanBeSegmented)
{
  ASSERT_EQ(scene({path("scene.pcd"), "--seed", "1"}).status, 0);
  const Outcome outcome =
      segment({path("scene.pcd"), path("out.pcd"), "--models", path("m.json"),
               "--overlay", path("o.png"), "--label-image", path("l.png")});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_GE(nlohmann::json::parse(read("m.json"))["planes"].size(), 3u)
      << "a room has at least three planes";
}

TEST_F(SceneApp, WrongUseIsStatusTwoAndFailureOne)
{
  const std::string out = path("scene.pcd");
  for (const std::vector<std::string>& wrong :
       std::vector<std::vector<std::string>>{{},
                                             {out, "--no-such-option"},
                                             {out, "--width", "0"},
                                             {out, "--seed", "-1"},
                                             {out, "--noise", "loud"},
                                             {out, "--scene", "no such scene"}}) {
    const Outcome outcome = scene(wrong);
    EXPECT_EQ(outcome.status, 2) << outcome.err;
    EXPECT_EQ(outcome.err.find("pcl_mrf_plane_scene: "), 0u) << outcome.err;
  }
  const Outcome outcome = scene({path("missing/scene.pcd")});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("there is no folder"), std::string::npos) << outcome.err;
  EXPECT_TRUE(files().empty());
  EXPECT_NE(scene({"--help"}).out.find("--truth"), std::string::npos);
}

} // namespace pcl_mrf_planes::test
