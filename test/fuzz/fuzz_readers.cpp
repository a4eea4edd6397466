// SPDX-License-Identifier: BSD-3-Clause
//
// Every reader of files: the first byte says which, the rest is the file. The only
// exception that may come out is std::runtime_error, with a message.
#include "fuzz_bytes.h"

#include "readers.h"

#include <pcl_mrf_planes/io/camera_model.h>
#include <pcl_mrf_planes/io/cloud_fields.h>
#include <pcl_mrf_planes/io/cloud_file.h>
#include <pcl_mrf_planes/io/image_file.h>

#include <pcl/console/print.h>

#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace pcl_mrf_planes::fuzz {
namespace {

/// A folder of this process in memory where there is one, for the readers take names.
struct Folder {
  std::string name;

  Folder()
  : name(std::filesystem::is_directory("/dev/shm") ? "/dev/shm" : "/tmp")
  {
    name += "/fuzz_readers." + std::to_string(getpid());
    std::filesystem::create_directories(name);
  }
  ~Folder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(name, ignored);
  }
};

std::string store(const char* name, const std::string& bytes)
{
  static const Folder folder;
  const std::string path = folder.name + "/" + name;
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

void requireWhole(const io::CloudFile& file)
{
  const std::size_t points = std::size_t{file.cloud.width} * file.cloud.height;
  require(file.cloud.data.size() >= points * file.cloud.point_step,
          "a cloud with fewer bytes than its points need");
  io::coordinates(file);
  io::colours(file);
}

void readPclzfOf(const std::string& content)
{
  const std::string path = store("frame_20150101T000000_depth.pclzf", content);
  store("frame_20150101T000000.xml",
        "<?xml version=\"1.0\"?><pcl_image_metadata><parameters>"
        "<width>4</width></parameters></pcl_image_metadata>");
  io::ReadOptions options;
  options.camera = io::cameraPreset("kinect1");
  options.camera->size = {};
  requireWhole(io::readPclzf(path, options).file);
}

void readDepth(const std::string& path)
{
  io::ReadOptions options;
  options.camera = io::cameraPreset("kinect1");
  options.camera->size = {};
  requireWhole(io::readDepthImage(path, options, nullptr, {}).file);
}

void read(int kind, const std::string& content)
{
  io::ReadOptions options;
  options.camera = io::parseCamera("10,10,4,3,1000");
  options.camera->size = {8, 6};
  switch (kind % 13) {
  case 0:
    requireWhole(io::readOrganizedCloud(store("a.pcd", content)));
    break;
  case 1:
    requireWhole(io::readPly(store("a.ply", content), {}));
    break;
  case 2:
    readPclzfOf(content);
    break;
  case 3:
    readDepth(store("a.png", content));
    break;
  case 4:
    readDepth(store("a.pgm", content));
    break;
  case 5:
    io::readPgm(store("b.pgm", content), io::ByteOrder::LITTLE_ENDIAN_FIRST);
    break;
  case 6:
    io::readSunRaster(store("a.ras", content));
    break;
  case 7:
    io::readColourImage(store("c.png", content));
    break;
  case 8:
    requireWhole(io::readAbw(store("abw.range", content)).file);
    break;
  case 9:
    requireWhole(io::readPerceptron(store("perc.0", content)).file);
    break;
  case 10:
    requireWhole(io::readTextDepth(store("a.depth", content), options).file);
    break;
  case 11:
    io::readCameraFile(store("camera.json", content));
    break;
  default:
    io::readCameraFile(store("camera.yaml", content));
    break;
  }
}

} // namespace
} // namespace pcl_mrf_planes::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  if (size == 0)
    return 0;
  try {
    pcl_mrf_planes::fuzz::read(
        data[0], std::string(reinterpret_cast<const char*>(data) + 1, size - 1));
  }
  catch (const std::runtime_error& error) {
    pcl_mrf_planes::fuzz::require(error.what()[0] != '\0',
                                  "an error without a message");
  }
  return 0;
}
