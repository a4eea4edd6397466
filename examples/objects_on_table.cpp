// SPDX-License-Identifier: BSD-3-Clause
/** \file Finds the things on a table: objects_on_table IN.pcd [mrf|pcl] */
#include "objects_on_table.h"

#include <pcl/common/centroid.h>
#include <pcl/io/pcd_io.h>

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

} // namespace

int main(int argc, char** argv)
{
  const std::string method = argc > 2 ? argv[2] : "mrf";
  Cloud::Ptr cloud(new Cloud);
  if (argc < 2 || (method != "mrf" && method != "pcl")) {
    std::cerr << "usage: objects_on_table IN.pcd [mrf|pcl]\n";
    return 2;
  }
  if (pcl::io::loadPCDFile(argv[1], *cloud) < 0 || !cloud->isOrganized()) {
    std::cerr << "objects_on_table: '" << argv[1]
              << "' is no organized cloud; give it one with rows and columns\n";
    return 1;
  }
  print(*cloud, method == "pcl" ? findObjects<PclPlanes>(cloud)
                                : findObjects<MrfPlanes>(cloud));
  return 0;
}
