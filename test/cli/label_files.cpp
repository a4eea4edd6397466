// SPDX-License-Identifier: BSD-3-Clause
#include "label_files.h"

#include <pcl/io/pcd_io.h>
#include <pcl/io/png_io.h>
#include <pcl/point_types.h>

#include <filesystem>

namespace pcl_mrf_planes::test {

namespace {

void makeFolder(const std::string& path)
{
  std::filesystem::create_directories(std::filesystem::path(path).parent_path());
}

} // namespace

void writeLabels(const std::string& path, const evaluation::LabelImage& image)
{
  makeFolder(path);
  pcl::io::saveShortPNGFile(path, image.labels.data(), image.width, image.height, 1);
}

void writeLabelCloud(const std::string& path, const evaluation::LabelImage& image)
{
  makeFolder(path);
  pcl::PointCloud<pcl::PointXYZL> cloud(static_cast<std::uint32_t>(image.width),
                                        static_cast<std::uint32_t>(image.height));
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto width = static_cast<std::size_t>(image.width);
    cloud[i].x = 0.01f * static_cast<float>(i % width);
    cloud[i].y = 0.01f * static_cast<float>(i / width);
    cloud[i].z = 2.0f;
    cloud[i].label = image.labels[i];
  }
  pcl::io::savePCDFileBinary(path, cloud);
}

} // namespace pcl_mrf_planes::test
