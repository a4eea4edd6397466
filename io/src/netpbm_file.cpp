// SPDX-License-Identifier: BSD-3-Clause
#include "netpbm_file.h"

#include "file_text.h"

#include <pcl_mrf_planes/io/image_file.h>

#include <cctype>
#include <stdexcept>

namespace pcl_mrf_planes::io {

namespace {

constexpr int LARGEST_VALUE = 65535;

[[noreturn]] void failHeader()
{
  throw std::runtime_error("has a damaged header; write it again");
}

/// The next number of a header, comments passed over.
int nextNumber(const std::string& text, std::size_t& at)
{
  while (at < text.size() &&
         (std::isspace(static_cast<unsigned char>(text[at])) != 0 || text[at] == '#'))
    at = text[at] == '#' ? text.find('\n', at) : at + 1;
  int value = 0;
  const std::size_t start = at;
  for (; at < text.size() && std::isdigit(static_cast<unsigned char>(text[at])) != 0;
       ++at) {
    if (value > (1 << 24))
      failHeader();
    value = 10 * value + (text[at] - '0');
  }
  if (at == start || at >= text.size())
    failHeader();
  return value;
}

std::uint8_t byteAt(const std::string& bytes, std::size_t i)
{
  return static_cast<std::uint8_t>(bytes[i]);
}

void checkLength(const std::string& bytes, const NetpbmHeader& header,
                 std::size_t bytes_a_point)
{
  const std::size_t needed = static_cast<std::size_t>(header.width) *
                             static_cast<std::size_t>(header.height) * bytes_a_point;
  if (bytes.size() - header.size < needed)
    throw std::runtime_error("is truncated: " + std::to_string(needed) +
                             " bytes of points are due, " +
                             std::to_string(bytes.size() - header.size) +
                             " are there; copy or record it again");
}

} // namespace

NetpbmHeader parseNetpbmHeader(const std::string& start)
{
  NetpbmHeader header;
  std::size_t at = 2;
  header.width = nextNumber(start, at);
  header.height = nextNumber(start, at);
  header.maximum = nextNumber(start, at);
  header.size = at + 1;
  if (header.width < 1 || header.height < 1 || header.maximum < 1 ||
      header.maximum > LARGEST_VALUE)
    failHeader();
  if (static_cast<std::size_t>(header.width) * static_cast<std::size_t>(header.height) >
      MOST_PIXELS)
    throw std::runtime_error("claims " + std::to_string(header.width) + " x " +
                             std::to_string(header.height) +
                             " points, which is too many; cut it into parts");
  return header;
}

Image16 readPgm(const std::string& path, ByteOrder order, int* maximum)
{
  const std::string bytes = readBytes(path);
  if (bytes.compare(0, 2, "P5") != 0)
    throw std::runtime_error("is not a binary PGM file (P5)");
  const NetpbmHeader header = parseNetpbmHeader(bytes);
  if (maximum != nullptr)
    *maximum = header.maximum;
  const std::size_t bytes_a_point = header.maximum > 255 ? 2 : 1;
  checkLength(bytes, header, bytes_a_point);
  Image16 image(header.width, header.height);
  const std::size_t high = order == ByteOrder::BIG_ENDIAN_FIRST ? 0 : 1;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const std::size_t at = header.size + bytes_a_point * i;
    image.pixels[i] = bytes_a_point == 1
                          ? byteAt(bytes, at)
                          : static_cast<std::uint16_t>(256 * byteAt(bytes, at + high) +
                                                       byteAt(bytes, at + 1 - high));
  }
  return image;
}

ColourImage readPpm(const std::string& path)
{
  const std::string bytes = readBytes(path);
  if (bytes.compare(0, 2, "P6") != 0)
    throw std::runtime_error("is not a binary PPM file (P6)");
  const NetpbmHeader header = parseNetpbmHeader(bytes);
  if (header.maximum > 255)
    throw std::runtime_error("has 16 bits a channel; write it with 8");
  checkLength(bytes, header, 3);
  ColourImage image(header.width, header.height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      image.pixels[i][c] = byteAt(bytes, header.size + 3 * i + c);
  return image;
}

} // namespace pcl_mrf_planes::io
