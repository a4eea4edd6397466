// SPDX-License-Identifier: BSD-3-Clause
//
// cv::rgbd::RgbdPlane: square blocks with a small error grow into planes, with or
// without cv::rgbd::RgbdNormals.
#include "peer_list.h"
#include "pinhole_fit.h"

#include <opencv2/core.hpp>
#include <opencv2/rgbd.hpp>

#include <algorithm>
#include <cmath>

namespace pcl_mrf_planes::benchmarks {

namespace {

constexpr std::uint8_t NO_PLANE = 255;

/// The points as OpenCV has them: three channels, NaN where invalid.
cv::Mat toMat(const Cloud& cloud)
{
  cv::Mat points(static_cast<int>(cloud.height), static_cast<int>(cloud.width),
                 CV_32FC3);
  auto* to = points.ptr<cv::Vec3f>();
  for (const pcl::PointXYZ& point : cloud)
    *to++ = cv::Vec3f(point.x, point.y, point.z);
  return points;
}

cv::Mat cameraMatrix(const Cloud& cloud)
{
  const PinholeFit fit = fitPinhole(cloud);
  return (cv::Mat_<float>(3, 3) << static_cast<float>(fit.fx), 0.0f,
          static_cast<float>(fit.cx), 0.0f, static_cast<float>(fit.fy),
          static_cast<float>(fit.cy), 0.0f, 0.0f, 1.0f);
}

cv::rgbd::RgbdPlane makePlanes(const Values& values)
{
  return cv::rgbd::RgbdPlane(cv::rgbd::RgbdPlane::RGBD_PLANE_METHOD_DEFAULT,
                             static_cast<int>(values.at("block_size")),
                             static_cast<int>(values.at("min_size")),
                             values.at("threshold"), values.at("sensor_error_a"),
                             values.at("sensor_error_b"), values.at("sensor_error_c"));
}

Labels segment(const Cloud::ConstPtr& cloud, const Values& values, double& milliseconds)
{
  cv::setNumThreads(1);
  const cv::Mat points = toMat(*cloud);
  cv::rgbd::RgbdPlane planes = makePlanes(values);
  cv::Mat mask, coefficients;
  const bool with_normals = values.at("normals") != 0.0;
  cv::rgbd::RgbdNormals estimation(points.rows, points.cols, CV_32F,
                                   cameraMatrix(*cloud), 5);
  if (with_normals) // tables that a program makes once for its camera
    estimation.initialize();
  const Stopwatch watch;
  if (with_normals) {
    cv::Mat normals;
    estimation(points, normals);
    planes(points, normals, mask, coefficients);
  }
  else {
    planes(points, mask, coefficients);
  }
  milliseconds = watch.milliseconds();

  Labels labels(cloud->size(), 0);
  if (!mask.empty())
    std::transform(mask.begin<std::uint8_t>(), mask.end<std::uint8_t>(), labels.begin(),
                   [](std::uint8_t plane) {
                     return static_cast<std::uint16_t>(plane == NO_PLANE ? 0
                                                                         : plane + 1);
                   });
  return labels;
}

} // namespace

Peer makeOpencvPlane()
{
  // Sizes in points, the threshold in metres; sensor errors a z^2 + b z + c.
  return {"opencv_rgbd_plane",
          "cv::rgbd::RgbdPlane",
          {{"published",
            "defaults of the class, with RgbdNormals",
            {{"block_size", 40},
             {"min_size", 1600},
             {"threshold", 0.01},
             {"sensor_error_a", 0},
             {"sensor_error_b", 0},
             {"sensor_error_c", 0},
             {"normals", 1}}},
           {"tuned",
            "best of tune_peers.py",
            {{"block_size", 20},
             {"min_size", 800},
             {"threshold", 0.007},
             {"sensor_error_a", 0},
             {"sensor_error_b", 0.002},
             {"sensor_error_c", 0.001},
             {"normals", 1}}}},
          segment};
}

} // namespace pcl_mrf_planes::benchmarks
