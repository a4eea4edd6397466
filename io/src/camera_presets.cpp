// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/io/camera_model.h>

#include <stdexcept>

namespace pcl_mrf_planes::io {

namespace {

struct Preset {
  const char* name;
  CameraModel camera;
};

CameraModel pinhole(double fx, double fy, double cx, double cy, int width, int height,
                    double depth_scale)
{
  CameraModel camera;
  camera.fx = fx;
  camera.fy = fy;
  camera.cx = cx;
  camera.cy = cy;
  camera.size = {width, height};
  camera.depth_scale = depth_scale;
  camera.scalable = true;
  return camera;
}

CameraModel withInvalid(CameraModel camera, std::vector<std::uint16_t> invalid)
{
  camera.invalid = std::move(invalid);
  return camera;
}

CameraModel withDisparity(CameraModel camera, double a, double b,
                          std::vector<std::uint16_t> invalid)
{
  camera.disparity_a = a;
  camera.disparity_b = b;
  return withInvalid(camera, std::move(invalid));
}

const std::vector<Preset>& presets()
{
  static const std::vector<Preset> all = {
      // The nominal Kinect v1 and PrimeSense camera of OpenNI and ROS (openni_camera),
      // millimetres, 0 where nothing was measured.
      {"kinect1", pinhole(525, 525, 319.5, 239.5, 640, 480, 1000)},
      // The same as raw 11-bit disparities (libfreenect's FREENECT_DEPTH_11BIT, 2047
      // where nothing was measured). Metres by N. Burrus (RGBDemo, kinect_calibration):
      // 1 / (3.3309495161 - 0.0030711016 d), with both divided by 0.0030711016.
      {"kinect1-raw",
       withDisparity(pinhole(525, 525, 319.5, 239.5, 640, 480, 1), 1 / 0.0030711016,
                     3.3309495161 / 0.0030711016, {2047})},
      // Depth camera of a Kinect v2 as its SDK reports it (ICoordinateMapper,
      // GetDepthCameraIntrinsics); devices differ by a few points.
      {"kinect2", pinhole(365.456, 365.456, 254.878, 205.395, 512, 424, 1000)},
      // RealSense D435 at 1280x720 as one device reports it (rs-enumerate-devices -c:
      // 637.6, principal point within 11 points of the middle; a D401 says 639.0).
      {"realsense", pinhole(637.6, 637.6, 639.5, 359.5, 1280, 720, 1000)},
      // The same at 640x480, which is no scaled 1280x720: 382.6.
      {"realsense-vga", pinhole(382.6, 382.6, 319.5, 239.5, 640, 480, 1000)},
      // TUM RGB-D, "File Formats": the values of ROS, recommended for all sequences, and
      // the calibrated colour cameras that depth is registered to; 5000 values a metre.
      {"tum", pinhole(525, 525, 319.5, 239.5, 640, 480, 5000)},
      {"tum-fr1", pinhole(517.3, 516.5, 318.6, 255.3, 640, 480, 5000)},
      {"tum-fr2", pinhole(520.9, 521.0, 325.1, 249.7, 640, 480, 5000)},
      {"tum-fr3", pinhole(535.4, 539.2, 320.1, 247.6, 640, 480, 5000)},
      // ICL-NUIM, "Camera parameters": K = (481.20, -480.00, 319.50, 239.50); the sign
      // is that of an upward y axis. The TUM-compatible PNGs have 5000 values a metre.
      {"icl-nuim", pinhole(481.2, 480, 319.5, 239.5, 640, 480, 5000)},
      // NYU Depth V2 toolbox, camera_params.m: colour camera, which the labeled set is
      // registered to (millimetres where it is exported as PNG) ...
      {"nyu", pinhole(518.85790117450188, 519.46961112127485, 325.58244941119034,
                      253.73616633400465, 640, 480, 1000)},
      // ... and depth camera of the raw dumps, depth_rel2depth_abs.m:
      // 351.3 / (1092.5 - d), 2047 where nothing was measured.
      {"nyu-raw",
       withDisparity(pinhole(582.62448167737955, 582.69103270988637, 313.04475870804731,
                             238.44389626620386, 640, 480, 1),
                     351.3, 1092.5, {0, 2047})},
      // 7-Scenes, page of the data set: focal length 585, principal point (320, 240),
      // millimetres, invalid 65535.
      {"7scenes", withInvalid(pinhole(585, 585, 320, 240, 640, 480, 1000), {0, 65535})},
      // Redwood, "camera parameters" of the indoor scenes and the scans: the nominal
      // PrimeSense, millimetres.
      {"redwood", pinhole(525, 525, 319.5, 239.5, 640, 480, 1000)}};
  return all;
}

} // namespace

std::vector<std::string> cameraPresetNames()
{
  std::vector<std::string> names;
  for (const Preset& preset : presets())
    names.emplace_back(preset.name);
  return names;
}

CameraModel cameraPreset(const std::string& name)
{
  std::string known;
  for (const Preset& preset : presets()) {
    if (name == preset.name) {
      CameraModel camera = preset.camera;
      camera.source = name;
      return camera;
    }
    known += (known.empty() ? "" : ", ") + std::string(preset.name);
  }
  throw std::runtime_error("there is no camera '" + name + "'; known are " + known);
}

} // namespace pcl_mrf_planes::io
