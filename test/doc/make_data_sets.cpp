// SPDX-License-Identifier: BSD-3-Clause
/** \file Writes what the commands of README.md take as given, of generated rooms: depth.png,
 * a TUM RGB-D folder, and a labeled NYU file. One argument: the folder to write into. */
#include "io/matlab_array.h"
#include "scenes/render.h"
#include "scenes/scene_library.h"

#include <pcl/io/png_io.h>

#include <hdf5.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
namespace scenes = pcl_mrf_planes::scenes;
using pcl_mrf_planes::test::writeArray;

scenes::SceneFrame roomSeen(std::uint64_t seed)
{
  const scenes::View view = scenes::makeRoom(seed);
  return scenes::render(view.scene, view.camera, scenes::SensorNoise::kinect(), seed);
}

void writeDepth(const fs::path& path, const scenes::SceneFrame& frame,
                double values_per_metre)
{
  std::vector<std::uint16_t> values;
  for (const float depth : frame.z)
    values.push_back(static_cast<std::uint16_t>(
        std::isfinite(depth) ? std::lround(depth * values_per_metre) : 0));
  pcl::io::saveShortPNGFile(path, values.data(), frame.width, frame.height, 1);
}

void writeColours(const fs::path& path, const scenes::SceneFrame& frame)
{
  std::vector<unsigned char> bytes;
  for (std::size_t i = 0; i < frame.size(); ++i)
    for (const std::uint8_t channel : {frame.r[i], frame.g[i], frame.b[i]})
      bytes.push_back(channel);
  pcl::io::saveRgbPNGFile(path, bytes.data(), frame.width, frame.height);
}

/// TUM RGB-D: depth in 1/5000 m, lists of times and files.
void writeTum(const fs::path& folder)
{
  fs::create_directories(folder / "depth");
  fs::create_directories(folder / "rgb");
  std::ofstream depth(folder / "depth.txt");
  std::ofstream rgb(folder / "rgb.txt");
  for (const int k : {1, 2}) {
    const scenes::SceneFrame frame = roomSeen(static_cast<std::uint64_t>(k));
    const std::string name = std::to_string(k) + ".000000";
    writeDepth(folder / "depth" / (name + ".png"), frame, 5000.0);
    writeColours(folder / "rgb" / (name + ".png"), frame);
    depth << name << " depth/" << name << ".png\n";
    rgb << name << " rgb/" << name << ".png\n";
  }
}

/// One frame as MATLAB stores it: column by column, behind a header of 512 bytes.
void writeNyu(const fs::path& path)
{
  const scenes::SceneFrame frame = roomSeen(3);
  const auto width = static_cast<std::size_t>(frame.width);
  const auto height = static_cast<std::size_t>(frame.height);
  std::vector<float> depth;
  std::vector<std::uint8_t> colours;
  for (std::size_t x = 0; x < width; ++x)
    for (std::size_t y = 0; y < height; ++y) {
      const float metres = frame.z[y * width + x];
      depth.push_back(std::isfinite(metres) ? metres : 0.0f);
    }
  for (const auto* channel : {&frame.r, &frame.g, &frame.b})
    for (std::size_t x = 0; x < width; ++x)
      for (std::size_t y = 0; y < height; ++y)
        colours.push_back((*channel)[y * width + x]);
  const hid_t properties = H5Pcreate(H5P_FILE_CREATE);
  H5Pset_userblock(properties, 512);
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, properties, H5P_DEFAULT);
  writeArray(file, "rawDepths", H5T_NATIVE_FLOAT, {1, width, height}, depth.data());
  writeArray(file, "depths", H5T_NATIVE_FLOAT, {1, width, height}, depth.data());
  writeArray(file, "images", H5T_NATIVE_UINT8, {1, 3, width, height}, colours.data());
  H5Fclose(file);
  H5Pclose(properties);
}

} // namespace

int main(int argc, char** argv)
{
  if (argc != 2) {
    std::cerr << "make_data_sets FOLDER\n";
    return 2;
  }
  const fs::path folder = argv[1];
  writeDepth(folder / "depth.png", roomSeen(0), 1000.0);
  writeTum(folder / "rgbd_dataset_freiburg1_desk");
  writeNyu(folder / "nyu_depth_v2_labeled.mat");
}
