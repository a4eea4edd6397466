// SPDX-License-Identifier: BSD-3-Clause
//
// The examples: what they find is compared, and they are run as programs.
#include "cli/process.h"
#include "objects_on_table.h"
#include "reference/clouds.h"
#include "reference/inputs.h"
#include "scenes/furniture.h"

#include <pcl/common/centroid.h>
#include <pcl/io/pcd_io.h>

#include <gtest/gtest.h>

#include <png.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <string>

namespace pcl_mrf_planes {
namespace {

constexpr double TABLE_HEIGHT = 0.7; // below the sensor

/// Two boxes, a ball and a drum on a table.
scenes::SceneFrame table(double sigma)
{
  scenes::Scene scene;
  const scenes::Colour gray(0.5, 0.5, 0.5);
  scene.beginObject();
  scenes::addPatch(scene, {-0.8, 0.6, 0}, {1.6, 0, 0}, {0, 0.9, 0}, gray);
  scenes::addBox(scene, scenes::standAt({-0.45, 1.0, 0}, 0.4), {0.2, 0.2, 0.15}, gray);
  scenes::addBox(scene, scenes::standAt({0.05, 1.1, 0}, -0.3), {0.15, 0.1, 0.25}, gray);
  scenes::addBall(scene, scenes::standAt({0.45, 0.95, 0}), 0.08, gray);
  const auto camera = scenes::lookAt({0, 0, TABLE_HEIGHT}, {0, 1.0, 0.0});
  return scenes::render(scene, camera, scenes::SensorNoise::gaussian(sigma), 1);
}

Eigen::Vector3f middleOf(const Cloud& cloud, const pcl::PointIndices& object)
{
  Eigen::Vector4f centroid;
  pcl::compute3DCentroid(cloud, object, centroid);
  return centroid.head<3>();
}

/// Offset of the plane nearest to the true table.
double tableHeight(const TableScene& scene)
{
  double best = INFINITY;
  for (const pcl::ModelCoefficients& model : scene.models)
    if (std::abs(static_cast<double>(std::abs(model.values[3])) - TABLE_HEIGHT) <
        std::abs(best - TABLE_HEIGHT))
      best = static_cast<double>(std::abs(model.values[3]));
  return best;
}

TEST(ObjectsOnTableTest, OurPlanesServeInThePlaceOfPcls)
{
  const auto frame = table(0.001);
  const Cloud::ConstPtr cloud = reference::toCloud<Point>(frame);
  const TableScene of_pcl = findObjects<PclPlanes>(cloud);
  const TableScene ours = findObjects<MrfPlanes>(cloud);
  ASSERT_EQ(of_pcl.objects.size(), 3U) << "two boxes and a ball";
  ASSERT_EQ(ours.objects.size(), 3U);
  for (const pcl::PointIndices& object : of_pcl.objects) {
    const Eigen::Vector3f place = middleOf(*cloud, object);
    float nearest = INFINITY;
    std::size_t points = 0;
    for (const pcl::PointIndices& mine : ours.objects) {
      const float distance = (middleOf(*cloud, mine) - place).norm();
      if (distance < nearest) {
        nearest = distance;
        points = mine.indices.size();
      }
    }
    EXPECT_LT(nearest, 0.01f) << "the same object";
    EXPECT_NEAR(static_cast<double>(points), static_cast<double>(object.indices.size()),
                0.15 * static_cast<double>(object.indices.size()));
  }
  EXPECT_NEAR(tableHeight(of_pcl), TABLE_HEIGHT, 0.005);
  EXPECT_NEAR(tableHeight(ours), TABLE_HEIGHT, 0.001);
  for (const TableScene* scene : {&of_pcl, &ours}) {
    ASSERT_EQ(scene->regions.size(), scene->models.size());
    for (const auto& region : scene->regions) {
      EXPECT_GT(region.getContour().size(), 20U);
      EXPECT_GT(region.getCount(), 0U);
    }
  }
}

class ExamplePrograms : public testing::Test {
protected:
  ExamplePrograms()
  : folder_(std::filesystem::temp_directory_path() /
            ("pcl_mrf_planes_examples_" + std::to_string(::getpid())))
  {
    std::filesystem::create_directories(folder_);
  }
  ~ExamplePrograms() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  test::Outcome run(const char* program,
                    const std::vector<std::string>& arguments) const
  {
    return test::runProcess(program, arguments, folder_.string(), {});
  }

private:
  std::filesystem::path folder_;
};

TEST_F(ExamplePrograms, ObjectsOnTableRunsWithEither)
{
  ASSERT_EQ(pcl::io::savePCDFileBinary(path("table.pcd"),
                                       *reference::toCloud<Point>(table(0.001))),
            0);
  for (const char* method : {"mrf", "pcl"}) {
    const auto outcome = run(OBJECTS_ON_TABLE, {path("table.pcd"), method});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    std::size_t objects = 0;
    for (std::size_t at = outcome.out.find("object of"); at != std::string::npos;
         at = outcome.out.find("object of", at + 1))
      ++objects;
    EXPECT_EQ(objects, 3U) << outcome.out;
  }
  EXPECT_EQ(run(OBJECTS_ON_TABLE, {}).status, 2);
  EXPECT_EQ(run(OBJECTS_ON_TABLE, {path("none.pcd")}).status, 1);
}

using Gray = std::vector<std::uint8_t>;
constexpr int SIDE = 96;

void writeGray(const std::string& path, const Gray& pixels)
{
  png_image png;
  std::memset(&png, 0, sizeof png);
  png.version = PNG_IMAGE_VERSION;
  png.width = png.height = SIDE;
  png.format = PNG_FORMAT_GRAY;
  ASSERT_NE(png_image_write_to_file(&png, path.c_str(), 0, pixels.data(), 0, nullptr),
            0);
}

Gray readGray(const std::string& path)
{
  png_image png;
  std::memset(&png, 0, sizeof png);
  png.version = PNG_IMAGE_VERSION;
  Gray pixels;
  if (png_image_begin_read_from_file(&png, path.c_str()) == 0)
    return pixels;
  png.format = PNG_FORMAT_GRAY;
  pixels.resize(PNG_IMAGE_SIZE(png));
  png_image_finish_read(&png, nullptr, pixels.data(), 0, nullptr);
  return pixels;
}

TEST_F(ExamplePrograms, DenoiseLabelsRestoresAnImage)
{
  const std::uint8_t values[] = {10, 90, 200};
  Gray clean(std::size_t{SIDE} * SIDE);
  for (std::size_t i = 0; i < clean.size(); ++i) {
    const int x = static_cast<int>(i) % SIDE;
    const int y = static_cast<int>(i) / SIDE;
    clean[i] = values[std::hypot(x - 40, y - 50) < 25 ? 2 : x + y > 110 ? 1 : 0];
  }
  scenes::Random random(6);
  Gray noisy = clean;
  for (std::uint8_t& pixel : noisy)
    if (random.chance(0.2))
      pixel = values[random.integer(0, 2)];
  writeGray(path("noisy.png"), noisy);
  const auto wrong = [&](const Gray& pixels) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < clean.size(); ++i)
      count += pixels[i] != clean[i] ? 1 : 0;
    return count;
  };
  const auto outcome =
      run(DENOISE_LABELS, {path("noisy.png"), path("clean.png"), "0.6"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Gray found = readGray(path("clean.png"));
  ASSERT_EQ(found.size(), clean.size());
  EXPECT_GT(wrong(noisy), 1000U);
  EXPECT_LT(wrong(found), wrong(noisy) / 12);
  EXPECT_EQ(run(DENOISE_LABELS, {path("noisy.png")}).status, 2);
  EXPECT_EQ(run(DENOISE_LABELS, {path("none.png"), path("o.png")}).status, 1);
}

} // namespace
} // namespace pcl_mrf_planes
