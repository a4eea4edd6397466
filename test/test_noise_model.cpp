// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/noise_model.h>

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

namespace pcl_mrf_planes {
namespace {

TEST(NoiseModelTest, SigmaIsThePolynomial)
{
  const NoiseModel model = {0.5, 0.25, 2.0};
  for (const double z : {0.0, 1.0, 3.5, 100.0})
    EXPECT_DOUBLE_EQ(model.sigma(z), 0.5 + 0.25 * z + 2.0 * z * z)
        << "sigma(z) is not a + b z + c z^2 at z = " << z;
}

TEST(NoiseModelTest, PresetsSayWhatTheirSourcesSay)
{
  const NoiseModel kinect = NoiseModel::kinect();
  EXPECT_NEAR(kinect.sigma(1.0), 1.4e-3, 1e-4)
      << "Khoshelham and Elberink: 1.4 mm at 1 m";
  EXPECT_NEAR(kinect.sigma(4.0), 23e-3, 1e-3)
      << "Khoshelham and Elberink: 2.3 cm at 4 m";
  const NoiseModel light = NoiseModel::structuredLight();
  for (const double z : {0.4, 1.0, 3.0})
    EXPECT_NEAR(light.sigma(z), 1.2e-3 + 1.9e-3 * (z - 0.4) * (z - 0.4), 1e-12)
        << "Nguyen et al.: the expansion of their formula is wrong at z = " << z;
  EXPECT_NEAR(NoiseModel::timeOfFlight().sigma(0.0), 1.5e-3, 1e-12);
  EXPECT_NEAR(NoiseModel::lidar().sigma(80.0), NoiseModel::lidar().sigma(1.0), 1e-12)
      << "a lidar's noise does not grow with the range";
  EXPECT_TRUE(std::isinf(NoiseModel::none().sigma(0.0))) << "none must reject nothing";
  EXPECT_TRUE(std::isinf(NoiseModel::none().sigma(1e6))) << "none must reject nothing";
  EXPECT_DOUBLE_EQ(NoiseModel::fixed(0.03).sigma(0.0), 0.03);
  EXPECT_DOUBLE_EQ(NoiseModel::fixed(0.03).sigma(9.0), 0.03)
      << "a fixed threshold must not depend on the depth";
}

TEST(NoiseModelTest, NoPresetIsEverNegativeOrFallsFarAway)
{
  for (const std::string& name : NoiseModel::names()) {
    NoiseModel model;
    ASSERT_TRUE(NoiseModel::fromName(name, model)) << name << " is listed but unknown";
    for (int k = 0; k < 400; ++k) {
      const double z = 0.05 * k;
      EXPECT_GT(model.sigma(z) + (z == 0.0 ? 1e-300 : 0.0), 0.0)
          << name << " has no noise at " << z << " m";
      if (z > 0.5) {
        EXPECT_GE(model.sigma(z + 0.05), model.sigma(z))
            << name << " gets better with distance at " << z << " m";
      }
    }
  }
}

TEST(NoiseModelTest, NamesAreUniqueAndUnknownOnesChangeNothing)
{
  const auto names = NoiseModel::names();
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  for (const char* expected :
       {"kinect", "structured_light", "time_of_flight", "lidar", "none"}) {
    NoiseModel model;
    EXPECT_TRUE(NoiseModel::fromName(expected, model)) << expected << " is missing";
  }
  for (const char* unknown : {"", "Kinect", "kinect ", "sonar"}) {
    NoiseModel model = {1.0, 2.0, 3.0};
    EXPECT_FALSE(NoiseModel::fromName(unknown, model))
        << "'" << unknown << "' was taken";
    EXPECT_EQ(model.a, 1.0) << "an unknown name must leave the model alone";
    EXPECT_EQ(model.b, 2.0) << "an unknown name must leave the model alone";
    EXPECT_EQ(model.c, 3.0) << "an unknown name must leave the model alone";
  }
}

} // namespace
} // namespace pcl_mrf_planes
