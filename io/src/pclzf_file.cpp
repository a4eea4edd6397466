// SPDX-License-Identifier: BSD-3-Clause
#include "file_text.h"
#include "readers.h"

#include <pcl/io/lzf.h>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>

#include <cstring>
#include <filesystem>
#include <stdexcept>

namespace pcl_mrf_planes::io {

namespace fs = std::filesystem;

namespace {

/// PCL's lzf_image_io.cpp: "PCLZF", width, height, name of the type, compressed and
/// uncompressed size.
constexpr std::size_t HEADER_BYTES = 5 + 4 + 4 + 16 + 4 + 4;
constexpr std::size_t BEST_COMPRESSION = 88; // LZF turns 3 bytes into at most 264

struct Blob {
  ImageSize size;
  std::string type;
  std::string bytes;
};

std::uint32_t wordAt(const std::string& bytes, std::size_t at)
{
  std::uint32_t value = 0;
  std::memcpy(&value, &bytes[at], sizeof value);
  return value;
}

[[noreturn]] void failDamaged()
{
  throw std::runtime_error("is truncated or damaged; copy or record it again");
}

std::size_t bytesAPoint(const std::string& type)
{
  return type == "rgb24" ? 3 : type == "bayer8" ? 1 : 2; // depth16, yuv422
}

Blob readBlob(const std::string& path)
{
  const std::string file = readBytes(path);
  if (file.size() < HEADER_BYTES || file.compare(0, 5, "PCLZF") != 0)
    failDamaged();
  Blob blob;
  const std::size_t width = wordAt(file, 5);
  const std::size_t height = wordAt(file, 9);
  blob.type = file.substr(13, 16);
  blob.type.resize(blob.type.find_last_not_of(std::string(" \0", 2)) + 1); // padding
  const std::size_t packed = wordAt(file, 29);
  const std::size_t size = wordAt(file, 33);
  if (width < 1 || height < 1 || width > MOST_PIXELS / height ||
      size != width * height * bytesAPoint(blob.type) ||
      packed > file.size() - HEADER_BYTES || size / BEST_COMPRESSION > packed)
    failDamaged();
  blob.size = {static_cast<int>(width), static_cast<int>(height)};
  blob.bytes.resize(size);
  if (packed == size) { // as it is: it could not be made smaller
    blob.bytes = file.substr(HEADER_BYTES, size);
    return blob;
  }
  if (pcl::lzfDecompress(&file[HEADER_BYTES], static_cast<unsigned int>(packed),
                         &blob.bytes[0], static_cast<unsigned int>(size)) != size)
    failDamaged();
  return blob;
}

CameraModel readXml(const std::string& path)
{
  namespace pt = boost::property_tree;
  try {
    pt::ptree tree;
    pt::read_xml(path, tree);
    CameraModel camera;
    camera.fx = tree.get<double>("depth.focal_length_x");
    camera.fy = tree.get<double>("depth.focal_length_y");
    camera.cx = tree.get<double>("depth.principal_point_x");
    camera.cy = tree.get<double>("depth.principal_point_y");
    camera.depth_scale = 1.0 / tree.get<double>("depth.z_multiplication_factor", 0.001);
    camera.source = path;
    return camera;
  }
  catch (const pt::ptree_error&) {
    throw std::runtime_error("has no camera that can be understood in '" + path +
                             "'; give it by --camera");
  }
}

/// NAME.xml for NAME_depth.pclzf or NAME.pclzf.
CameraModel cameraOf(const std::string& path, const ReadOptions& options)
{
  if (options.camera)
    return *options.camera;
  std::string start = fs::path(path).replace_extension().string();
  std::error_code error;
  for (const std::string& end : {std::string(), std::string("_depth")})
    if (endsIn(start, end)) {
      const std::string xml = start.substr(0, start.size() - end.size()) + ".xml";
      if (fs::is_regular_file(xml, error))
        return readXml(xml);
    }
  const std::string file = findCameraFile(path);
  return file.empty() ? cameraPreset("kinect1") : readCameraFile(file);
}

/// The colours of NAME_rgb.pclzf, which has all reds, then greens, then blues.
std::vector<Colour> coloursBeside(const std::string& path, ImageSize size)
{
  const std::string end = "_depth.pclzf";
  if (!endsIn(path, end))
    return {};
  const std::string other = path.substr(0, path.size() - end.size()) + "_rgb.pclzf";
  std::error_code error;
  if (!fs::is_regular_file(other, error))
    return {};
  try {
    const Blob blob = readBlob(other);
    if (blob.type != "rgb24" || blob.size.width != size.width ||
        blob.size.height != size.height)
      return {};
    std::vector<Colour> colours(size.points());
    for (std::size_t i = 0; i < colours.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c)
        colours[i][c] = static_cast<std::uint8_t>(blob.bytes[c * colours.size() + i]);
    return colours;
  }
  catch (const std::runtime_error&) { // only pictures would have shown it
    return {};
  }
}

} // namespace

Frame readPclzf(const std::string& path, const ReadOptions& options)
{
  const Blob blob = readBlob(path);
  if (blob.type != "depth16")
    throw std::runtime_error("is a PCLZF image of type '" + blob.type +
                             "'; name the one with depth (depth16)");
  Image16 values(blob.size.width, blob.size.height);
  std::memcpy(values.pixels.data(), blob.bytes.data(), blob.bytes.size());
  Frame frame;
  frame.camera = fittedTo(cameraOf(path, options), blob.size);
  frame.file = cloudFromDepth(toMetres(values, *frame.camera), *frame.camera);
  frame.colours = coloursBeside(path, blob.size);
  return frame;
}

} // namespace pcl_mrf_planes::io
