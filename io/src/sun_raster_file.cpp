// SPDX-License-Identifier: BSD-3-Clause
#include "file_text.h"

#include <pcl_mrf_planes/io/image_file.h>

#include <stdexcept>

namespace pcl_mrf_planes::io {

namespace {

constexpr std::uint32_t MAGIC = 0x59a66a95; // rasterfile(5) of SunOS
constexpr std::size_t HEADER_BYTES = 32;
constexpr std::uint32_t OLD_TYPE = 0;
constexpr std::uint32_t STANDARD_TYPE = 1;

/// Number \a k of the header, most significant byte first.
std::uint32_t headerWord(const std::string& bytes, std::size_t k)
{
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value = 256 * value + static_cast<std::uint8_t>(bytes[4 * k + i]);
  return value;
}

} // namespace

Image16 readSunRaster(const std::string& path)
{
  const std::string bytes = readBytes(path);
  if (bytes.size() < HEADER_BYTES || headerWord(bytes, 0) != MAGIC)
    throw std::runtime_error("is not a Sun raster file");
  const std::uint32_t width = headerWord(bytes, 1);
  const std::uint32_t height = headerWord(bytes, 2);
  const std::uint32_t type = headerWord(bytes, 5);
  if (headerWord(bytes, 3) != 8 || (type != OLD_TYPE && type != STANDARD_TYPE))
    throw std::runtime_error(
        "is compressed or has not 8 bits a point; convert it to an "
        "8-bit PGM");
  if (width < 1 || height < 1 || width > MOST_PIXELS / height)
    throw std::runtime_error("has a damaged header; copy it again");
  // Rows are filled up to an even number of bytes; a map of colours comes first.
  const std::size_t row = width + width % 2;
  const std::size_t start = HEADER_BYTES + headerWord(bytes, 7);
  if (bytes.size() < start || (bytes.size() - start) / row < height)
    throw std::runtime_error("is truncated; copy it again");
  Image16 image(static_cast<int>(width), static_cast<int>(height));
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] =
        static_cast<std::uint8_t>(bytes[start + row * (i / width) + i % width]);
  return image;
}

} // namespace pcl_mrf_planes::io
