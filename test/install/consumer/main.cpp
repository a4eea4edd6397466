// SPDX-License-Identifier: BSD-3-Clause
// A program of somebody else: two walls in memory through the installed class, and a function
// of the installed readers.
#include <pcl_mrf_planes/mrf_plane_segmentation.h>

#include <pcl_mrf_planes/io/camera_model.h>

#include <iostream>

int main()
{
  constexpr int WIDTH = 160, HEIGHT = 120;
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(
      new pcl::PointCloud<pcl::PointXYZ>(WIDTH, HEIGHT));
  for (int v = 0; v < HEIGHT; ++v)
    for (int u = 0; u < WIDTH; ++u) {
      const float z = u < WIDTH / 2 ? 2.0f : 2.5f;
      const float x = (static_cast<float>(u) - 80.0f) / 130.0f;
      const float y = (static_cast<float>(v) - 60.0f) / 130.0f;
      cloud->at(u, v) = pcl::PointXYZ(x * z, y * z, z);
    }
  pcl::MRFPlaneSegmentation<pcl::PointXYZ> segmentation;
  segmentation.setInputCloud(cloud);
  std::vector<pcl::ModelCoefficients> planes;
  std::vector<pcl::PointIndices> inliers;
  segmentation.segment(planes, inliers);
  std::cout << planes.size() << " planes, " << __cplusplus / 100 << ", "
            << pcl_mrf_planes::io::cameraPresetNames().size() << " cameras\n";
  return planes.size() == 2 ? 0 : 1;
}
