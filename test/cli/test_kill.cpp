// SPDX-License-Identifier: BSD-3-Clause
// Whatever moment a signal comes: each output is the old one, or the new one as a whole.
#include "cli_test.h"

#include <array>

namespace pcl_mrf_planes::test {

class Kill : public CliTest {
protected:
  static constexpr std::array<const char*, 3> OUTPUTS = {"out.pcd", "out.json",
                                                         "out.png"};

  void SetUp() override
  {
    CliTest::SetUp();
    const Outcome scene =
        run(PCL_MRF_PLANES_SCENE_APP,
            {path("in.pcd"), "--width", "320", "--height", "240", "--seed", "5"});
    ASSERT_EQ(scene.status, 0) << scene.err;
    ASSERT_EQ(segment(arguments()).status, 0);
    for (std::size_t k = 0; k < OUTPUTS.size(); ++k)
      whole_[k] = read(OUTPUTS[k]);
  }

  std::vector<std::string> arguments() const
  {
    return {path("in.pcd"),  path("out.pcd"), "--models", path("out.json"),
            "--label-image", path("out.png"), "--quiet"};
  }

  /// Runs the app for \a seconds at most.
  int runAndKill(const char* signal, double seconds) const
  {
    std::vector<std::string> timed = {"-s", signal, std::to_string(seconds),
                                      PCL_MRF_PLANES_SEGMENTATION_APP};
    const std::vector<std::string> rest = arguments();
    timed.insert(timed.end(), rest.begin(), rest.end());
    return run("/usr/bin/timeout", timed).status;
  }

  void expectWhole() const
  {
    for (std::size_t k = 0; k < OUTPUTS.size(); ++k) {
      const std::string now = read(OUTPUTS[k]);
      EXPECT_TRUE(now == "old" || now == whole_[k])
          << OUTPUTS[k] << " has " << now.size() << " bytes, neither the old ones nor "
          << whole_[k].size();
    }
  }

  std::array<std::string, OUTPUTS.size()> whole_;
};

TEST_F(Kill, LeavesNoHalfFile)
{
  for (const char* signal : {"INT", "TERM", "KILL"}) {
    int killed = 0;
    // Steps that fall on loading, segmenting and writing alike.
    for (int step = 1; step <= 40; ++step) {
      SCOPED_TRACE(std::string(signal) + " after step " + std::to_string(step));
      for (const char* output : OUTPUTS)
        write(output, "old");
      killed += runAndKill(signal, 0.004 * step) != 0 ? 1 : 0;
      expectWhole();
      // No one can catch KILL: its temporary files stay, under their own names.
      if (std::string(signal) != "KILL") {
        EXPECT_EQ(files(),
                  (std::set<std::string>{"in.pcd", "out.json", "out.pcd", "out.png"}));
      }
    }
    EXPECT_GT(killed, 0) << signal << " never came in time";
  }
}

} // namespace pcl_mrf_planes::test
