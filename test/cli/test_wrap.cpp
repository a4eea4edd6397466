// SPDX-License-Identifier: BSD-3-Clause
// A full turn of a lidar: planes do not end where its columns begin.
#include "batch_test.h"

#include <pcl/io/pcd_io.h>

#include <cmath>

namespace pcl_mrf_planes::test {

class Wrap : public BatchTest {
protected:
  static constexpr int WIDTH = 512;
  static constexpr int HEIGHT = 64;

  /// A room of 8 by 6 metres with a floor 1.5 m below, scanned from a place in it; column 0
  /// looks \a shift columns away from the middle of a wall.
  void writeRoom(const std::string& name, int shift) const
  {
    pcl::PointCloud<pcl::PointXYZ> cloud(WIDTH, HEIGHT);
    for (int row = 0; row < HEIGHT; ++row)
      for (int column = 0; column < WIDTH; ++column) {
        const double turn = 2.0 * M_PI * (column + shift) / WIDTH;
        const double tilt = (25.0 - row) * M_PI / 180.0;
        const Eigen::Vector3d ray(std::cos(turn) * std::cos(tilt),
                                  std::sin(turn) * std::cos(tilt), std::sin(tilt));
        double range = 1e9;
        for (const auto& wall : {std::make_pair(0, 4.0), std::make_pair(1, 3.0)})
          range =
              std::min(range, wall.second / std::max(1e-9, std::abs(ray[wall.first])));
        if (ray.z() < 0.0)
          range = std::min(range, 1.5 / -ray.z());
        // A little noise, the same wherever the scan starts.
        const int place = (column + shift) % WIDTH;
        range += 0.002 * (((place * 7919 + row * 104729) % 101) / 50.0 - 1.0);
        cloud.at(column, row).getVector3fMap() = (range * ray).cast<float>();
      }
    pcl::io::savePCDFileBinary(path(name), cloud);
  }

  Json planesOf(const std::string& name, std::vector<std::string> options) const
  {
    options.insert(options.begin(), {path(name), "--models", path("m.json"),
                                     "--join-coplanar", "false"});
    const Outcome outcome = segment(options);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return Json::parse(read("m.json"));
  }
};

TEST_F(Wrap, AWallAcrossTheSeamIsOnePlane)
{
  writeRoom("room.pcd", 0);
  EXPECT_EQ(planesOf("room.pcd", {})["planes"].size(), 6u) << "cut in two";
  const Json report = planesOf("room.pcd", {"--wrap"});
  ASSERT_EQ(report["planes"].size(), 5u);
  EXPECT_EQ(report["counts"]["points"], WIDTH * HEIGHT) << "no point counts twice";
  EXPECT_EQ(report["counts"]["valid_points"], WIDTH * HEIGHT);
  EXPECT_LE(report["counts"]["labelled_share"], 1.0);
  EXPECT_GT(report["counts"]["labelled_share"], 0.95);
  std::size_t points = 0;
  for (const Json& plane : report["planes"]) {
    points += plane["points"].get<std::size_t>();
    EXPECT_GT(plane["coefficients"][3], 0.0) << "turned to the sensor";
    EXPECT_LT(plane["rms_m"], 0.005);
  }
  EXPECT_LE(points, static_cast<std::size_t>(WIDTH * HEIGHT));
}

TEST_F(Wrap, PlanesDoNotDependOnWhereTheScanStarts)
{
  writeRoom("room.pcd", 0);
  const Json first = planesOf("room.pcd", {"--wrap"})["planes"];
  for (const int shift : {40, 128, 300, 500}) {
    SCOPED_TRACE(shift);
    writeRoom("turned.pcd", shift);
    const Json other = planesOf("turned.pcd", {"--wrap"})["planes"];
    ASSERT_EQ(other.size(), first.size());
    for (const Json& plane : first) {
      double best = 1e9, area = 0.0;
      for (const Json& candidate : other) {
        double apart = 0.0;
        for (std::size_t k = 0; k < 4; ++k)
          apart += std::abs(plane["coefficients"][k].get<double>() -
                            candidate["coefficients"][k].get<double>());
        if (apart < best) {
          best = apart;
          area = candidate["area_m2"];
        }
      }
      EXPECT_LT(best, 0.01);
      EXPECT_NEAR(area / plane["area_m2"].get<double>(), 1.0, 0.05);
    }
  }
}

TEST_F(Wrap, ChangesNothingWhereNothingCrossesTheSeam)
{
  scene_.write(path("in.pcd"), "binary"); // its sides are no neighbours
  const Json plain = planesOf("in.pcd", {})["planes"];
  const Json wrapped = planesOf("in.pcd", {"--wrap"})["planes"];
  ASSERT_EQ(plain.size(), wrapped.size());
  for (std::size_t k = 0; k < plain.size(); ++k)
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(plain[k]["coefficients"][i].get<double>(),
                  wrapped[k]["coefficients"][i].get<double>(), 1e-2);
}

} // namespace pcl_mrf_planes::test
