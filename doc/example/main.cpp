// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/mrf_plane_segmentation.h>

#include <pcl/io/pcd_io.h>

#include <iostream>

int main(int argc, char** argv)
{
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  if (argc < 2 || pcl::io::loadPCDFile(argv[1], *cloud) < 0)
    return 1;

  pcl::MRFPlaneSegmentation<pcl::PointXYZ> segmentation;
  segmentation.setInputCloud(cloud);
  std::vector<pcl::ModelCoefficients> planes;
  std::vector<pcl::PointIndices> inliers;
  segmentation.segment(planes, inliers);

  for (std::size_t k = 0; k < planes.size(); ++k)
    std::cout << inliers[k].indices.size() << " points on " << planes[k] << '\n';
}
