// SPDX-License-Identifier: BSD-3-Clause
// Cameras: presets, options, files, and what their depth values mean.
#include "io_files.h"

#include <cmath>

namespace pcl_mrf_planes::test {

class CameraFile : public IoTest {
protected:
  io::CameraModel camera(const std::string& name, const std::string& text) const
  {
    write(name, text);
    return io::readCameraFile(path(name));
  }
};

namespace {

void expectNumbers(const io::CameraModel& camera, double fx, double fy, double cx,
                   double cy)
{
  EXPECT_EQ(camera.fx, fx);
  EXPECT_EQ(camera.fy, fy);
  EXPECT_EQ(camera.cx, cx);
  EXPECT_EQ(camera.cy, cy);
}

} // namespace

TEST(CameraPreset, AllFitTheImagesThatTheyAreFor)
{
  EXPECT_GE(io::cameraPresetNames().size(), 8u);
  for (const std::string& name : io::cameraPresetNames()) {
    const io::CameraModel camera = io::cameraPreset(name);
    ASSERT_TRUE(camera.size.stated()) << name;
    EXPECT_NO_THROW(io::fittedTo(camera, camera.size)) << name;
    EXPECT_EQ(camera.source, name);
  }
  EXPECT_THROW(io::cameraPreset("kinect3"), std::runtime_error);
}

TEST(CameraPreset, IsScaledToSmallerImagesOfTheSameShapeOnly)
{
  const io::CameraModel half = io::fittedTo(io::cameraPreset("kinect1"), {320, 240});
  EXPECT_EQ(half.fx, 262.5);
  EXPECT_EQ(half.cx, 159.5) << "the middle of the image stays in the middle";
  EXPECT_THROW(io::fittedTo(io::cameraPreset("kinect1"), {512, 424}),
               std::runtime_error);
}

TEST(CameraOption, IsNumbersOrAName)
{
  const io::CameraModel camera = io::parseCamera("500,510,319.5,239.5,5000");
  expectNumbers(camera, 500, 510, 319.5, 239.5);
  EXPECT_EQ(camera.depth_scale, 5000);
  EXPECT_EQ(io::parseCamera("500,510,319.5,239.5").depth_scale, 1000);
  EXPECT_EQ(io::parseCamera("tum").depth_scale, 5000);
  for (const char* wrong : {"1,2,3", "1,2,3,4,5,6", "1,2,x,4", "0,500,1,1", "1,-2,3,4",
                            "500,500,320,240,0", "nothing"})
    EXPECT_THROW(io::parseCamera(wrong), std::runtime_error) << wrong;
}

TEST(CameraFit, RefusesWhatCannotBeTheCameraOfTheImage)
{
  io::CameraModel camera = io::parseCamera("525,525,319.5,239.5");
  EXPECT_NO_THROW(io::fittedTo(camera, {640, 480}));
  EXPECT_THROW(io::fittedTo(camera, {160, 120}), std::runtime_error)
      << "centre outside";
  camera = io::parseCamera("5,5,319.5,239.5");
  EXPECT_THROW(io::fittedTo(camera, {640, 480}), std::runtime_error) << "178 degrees";
  camera = io::parseCamera("525,525,319.5,239.5");
  camera.size = {1280, 960};
  EXPECT_THROW(io::fittedTo(camera, {640, 480}), std::runtime_error)
      << "a calibration is not scaled";
}

TEST_F(CameraFile, FlatJsonAndYaml)
{
  const io::CameraModel json = camera(
      "a.json", "{\"fx\": 1.5, \"fy\": 2, \"cx\": 3, \"cy\": 4, \"width\": 640,\n"
                "\"height\": 480, \"depth_scale\": 8000.25, \"invalid\": [0, 7]}");
  expectNumbers(json, 1.5, 2, 3, 4);
  EXPECT_EQ(json.depth_scale, 8000.25);
  EXPECT_EQ(json.size.width, 640);
  EXPECT_EQ(json.invalid, (std::vector<std::uint16_t>{0, 7}));
  expectNumbers(camera("a.yaml", "fx: 1.5\nfy: 2\ncx: 3\ncy: 4\n"), 1.5, 2, 3, 4);
}

TEST_F(CameraFile, OfRosOfOpen3dAndOfOrbSlam)
{
  expectNumbers(camera("ros.yaml", "image_width: 640\nimage_height: 480\n"
                                   "camera_matrix:\n  rows: 3\n  cols: 3\n"
                                   "  data: [10, 0, 30, 0, 20, 40, 0, 0, 1]\n"),
                10, 20, 30, 40);
  expectNumbers(camera("open3d.json", "{\"width\": 640, \"height\": 480, "
                                      "\"intrinsic_matrix\": "
                                      "[10, 0, 0, 0, 20, 0, 30, 40, 1]}"),
                10, 20, 30, 40);
  const io::CameraModel orb =
      camera("orb.yaml", "%YAML:1.0\n---\nCamera.fx: 10.0\nCamera.fy: 20.0\n"
                         "Camera.cx: 30.0\nCamera.cy: 40.0\nDepthMapFactor: 5000.0\n");
  expectNumbers(orb, 10, 20, 30, 40);
  EXPECT_EQ(orb.depth_scale, 5000);
}

TEST_F(CameraFile, WhatIsWrongIsSaidWithTheFilesName)
{
  for (const char* text : {"", "[1, 2]", "{\"fx\": 1}", "{\"fx\": \"wide\", \"fy\": 1}",
                           "{", "fx: [", "{\"camera_matrix\": {\"data\": [1, 2, 3]}}",
                           "{\"K\": [\"a\",2,3,4,5,6,7,8,9]}"})
    try {
      camera("bad.json", text);
      ADD_FAILURE() << text << " was read";
    }
    catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find("bad.json"), std::string::npos)
          << error.what();
    }
}

TEST_F(CameraFile, TheOneOfTheImageComesBeforeTheOneOfTheFolder)
{
  EXPECT_EQ(io::findCameraFile(path("a.depth.png")), "");
  write("camera.json", "{}");
  EXPECT_EQ(io::findCameraFile(path("a.depth.png")), path("camera.json"));
  write("a.camera.yaml", "{}");
  EXPECT_EQ(io::findCameraFile(path("a.depth.png")), path("a.camera.yaml"));
  EXPECT_EQ(io::findCameraFile(path("a.png")), path("a.camera.yaml"));
  EXPECT_EQ(io::findCameraFile(path("b.png")), path("camera.json"));
}

TEST(DepthValues, AreMetresByScale)
{
  io::Image16 values(3, 1);
  values.pixels = {0, 5000, 65535};
  const io::DepthMap tum = io::toMetres(values, io::cameraPreset("tum"));
  EXPECT_TRUE(std::isnan(tum.pixels[0]));
  EXPECT_EQ(tum.pixels[1], 1.0f);
  EXPECT_FLOAT_EQ(tum.pixels[2], 13.107f);
  EXPECT_TRUE(std::isnan(io::toMetres(values, io::cameraPreset("7scenes")).pixels[2]))
      << "65535 is 7-Scenes' invalid value";
}

TEST(DepthValues, AreMetresByDisparity)
{
  io::Image16 values(4, 1);
  values.pixels = {2047, 700, 1000, 1093};
  const io::DepthMap nyu = io::toMetres(values, io::cameraPreset("nyu-raw"));
  EXPECT_TRUE(std::isnan(nyu.pixels[0])) << "not measured";
  EXPECT_FLOAT_EQ(nyu.pixels[1], 351.3f / 392.5f);
  EXPECT_FLOAT_EQ(nyu.pixels[2], 351.3f / 92.5f);
  EXPECT_TRUE(std::isnan(nyu.pixels[3])) << "behind infinity";
  const io::DepthMap raw = io::toMetres(values, io::cameraPreset("kinect1-raw"));
  EXPECT_TRUE(std::isnan(raw.pixels[0]));
  EXPECT_NEAR(raw.pixels[1], 1.0 / (700 * -0.0030711016 + 3.3309495161), 1e-6);
}

TEST(DepthCloud, PutsPointsOnTheRaysOfTheirPlaces)
{
  const io::CameraModel camera = io::parseCamera("50,60,3.25,2.5");
  io::DepthMap depth(8, 6, 2.0f);
  depth.pixels[9] = NAN;
  io::Frame frame;
  frame.file = io::cloudFromDepth(depth, camera);
  std::vector<double> expected(depth.pixels.begin(), depth.pixels.end());
  expectSeenBy(frame, camera, expected);
}

TEST(DepthCloud, DistancesAlongTheRayAreDistances)
{
  io::CameraModel camera = io::parseCamera("50,60,3.25,2.5");
  camera.along_ray = true;
  const io::CloudFile file = io::cloudFromDepth(io::DepthMap(8, 6, 2.0f), camera);
  for (std::size_t i = 0; i < 48; ++i)
    EXPECT_NEAR(pointOf(file, i).norm(), 2.0f, 1e-6f);
}

} // namespace pcl_mrf_planes::test
