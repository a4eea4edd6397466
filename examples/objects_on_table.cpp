// SPDX-License-Identifier: BSD-3-Clause
/** \file Finds the things on a table: objects_on_table IN.pcd [mrf|pcl [OUT.pcd]]
 *
 * OUT.pcd is the cloud with the number of the object in a field label, 0 for none. */
#include "objects_on_table.h"

#include <pcl/common/centroid.h>
#include <pcl/common/io.h>
#include <pcl/io/pcd_io.h>

#include <cstdint>
#include <exception>
#include <iostream>
#include <string>

namespace {

void print(const Cloud& cloud, const TableScene& scene)
{
  std::cout << scene.models.size() << " planes\n";
  for (const pcl::PointIndices& object : scene.objects) {
    Eigen::Vector4f centroid;
    pcl::compute3DCentroid(cloud, object, centroid);
    std::cout << "object of " << object.indices.size() << " points at "
              << centroid.head<3>().transpose() << " m\n";
  }
}

/// The cloud with a label for each point: k of the k-th object.
pcl::PointCloud<pcl::PointXYZL> label(const Cloud& cloud, const TableScene& scene)
{
  pcl::PointCloud<pcl::PointXYZL> labelled;
  pcl::copyPointCloud(cloud, labelled);
  std::uint32_t number = 0;
  for (const pcl::PointIndices& object : scene.objects) {
    ++number;
    for (const auto i : object.indices)
      labelled[static_cast<std::size_t>(i)].label = number;
  }
  return labelled;
}

int run(int argc, char** argv)
{
  const std::string method = argc > 2 ? argv[2] : "mrf";
  Cloud::Ptr cloud(new Cloud);
  if (argc < 2 || (method != "mrf" && method != "pcl")) {
    std::cerr << "usage: objects_on_table IN.pcd [mrf|pcl [OUT.pcd]]\n";
    return 2;
  }
  if (pcl::io::loadPCDFile(argv[1], *cloud) < 0 || !cloud->isOrganized()) {
    std::cerr << "objects_on_table: '" << argv[1]
              << "' is no organized cloud; give it one with rows and columns\n";
    return 1;
  }
  const TableScene scene =
      method == "pcl" ? findObjects<PclPlanes>(cloud) : findObjects<MrfPlanes>(cloud);
  print(*cloud, scene);
  if (argc > 3 && pcl::io::savePCDFileBinary(argv[3], label(*cloud, scene)) < 0) {
    std::cerr << "objects_on_table: cannot write '" << argv[3] << "'\n";
    return 1;
  }
  return 0;
}

} // namespace

int main(int argc, char** argv)
{
  try {
    return run(argc, argv);
  }
  catch (const std::exception& error) {
    std::cerr << "objects_on_table: " << error.what() << '\n';
    return 1;
  }
}
