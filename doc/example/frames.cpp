// SPDX-License-Identifier: BSD-3-Clause
// Planes of every frame of the inputs: clouds, depth images, folders, data sets.
#include <pcl_mrf_planes/io/cloud_fields.h>
#include <pcl_mrf_planes/io/frame.h>
#include <pcl_mrf_planes/mrf_plane_segmentation.h>

#include <exception>
#include <iostream>

int main(int argc, char** argv)
try {
  const std::vector<std::string> inputs(argv + 1, argv + argc);
  for (const auto& source : pcl_mrf_planes::io::listFrames(inputs, {}).frames) {
    const pcl_mrf_planes::io::Frame frame = source.read();
    pcl::MRFPlaneSegmentation<pcl::PointXYZ> segmentation;
    segmentation.setInputCloud(pcl_mrf_planes::io::coordinates(frame.file));
    std::vector<pcl::ModelCoefficients> planes;
    std::vector<pcl::PointIndices> inliers;
    segmentation.segment(planes, inliers);
    std::cout << source.name << ": " << planes.size() << " planes\n";
  }
}
catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
