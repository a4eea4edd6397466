// SPDX-License-Identifier: BSD-3-Clause
#include "pcd_header.h"

#include <pcl/common/io.h>
#include <pcl/io/pcd_io.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <locale>
#include <sstream>
#include <stdexcept>

namespace pcl_mrf_planes::io {

namespace {

constexpr std::size_t LONGEST_HEADER = 1 << 16;  // bytes; comments included
constexpr std::uint64_t LARGEST_POINT = 1 << 24; // bytes, all fields
/// LZF turns 3 bytes into at most 264.
constexpr std::uint64_t BEST_COMPRESSION = 88;

[[noreturn]] void fail(const std::string& message)
{
  throw std::runtime_error(message);
}

/// The header as text, in two parts: PCL allocates memory when it meets POINTS.
struct HeaderText {
  std::string all_but_points;
  std::string points_line;
  std::string data_line;
  std::uint64_t length = 0;
};

HeaderText splitHeader(std::istream& stream)
{
  HeaderText text;
  std::string line;
  const auto begins = [&](const char* word) {
    const std::size_t start = std::min(line.find_first_not_of(" \t"), line.size());
    return line.compare(start, std::strlen(word), word) == 0;
  };
  for (char c = 0; stream.get(c);) {
    if (++text.length > LONGEST_HEADER)
      break;
    line += c;
    if (c != '\n')
      continue;
    if (begins("DATA")) {
      text.data_line = line;
      return text;
    }
    (begins("POINTS") ? text.points_line : text.all_but_points) += line;
    line.clear();
  }
  fail("is not a PCD file, or its header is damaged (no line DATA); convert it to PCD, "
       "for example with pcl_ply2pcd or pcl_converter");
}

/// PCL's reading of a header in memory; false when it refuses.
bool parse(const std::string& text, PcdHeader& header)
{
  std::istringstream stream(text);
  pcl::PCDReader reader;
  int data_type = 0;
  unsigned int data_start = 0;
  const int status =
      reader.readHeader(stream, header.cloud, header.origin, header.orientation,
                        header.version, data_type, data_start);
  if (data_type >= 0 && data_type <= 2)
    header.format = static_cast<PcdFormat>(data_type);
  return status >= 0;
}

std::uint64_t claimedPoints(const HeaderText& text)
{
  std::istringstream stream(text.points_line);
  stream.imbue(std::locale::classic());
  std::string word;
  std::int64_t points = -1;
  if (!(stream >> word >> points) || points < 0)
    fail("has a damaged header (POINTS); write the file anew");
  return static_cast<std::uint64_t>(points);
}

/// Rows and columns that the user knows, for a file that has its points in one row.
void takeSize(PcdHeader& header, std::uint64_t points, ImageSize size)
{
  if (!size.stated() || (header.cloud.width > 1 && header.cloud.height > 1))
    return;
  if (points != size.points())
    fail("has " + std::to_string(points) + " points, not the " +
         std::to_string(size.width) + " x " + std::to_string(size.height) +
         " that --size says; check it");
  header.cloud.width = static_cast<std::uint32_t>(size.width);
  header.cloud.height = static_cast<std::uint32_t>(size.height);
  header.cloud.row_step = header.cloud.width * header.cloud.point_step;
}

void checkShape(const PcdHeader& header, std::uint64_t points)
{
  const auto& cloud = header.cloud;
  const std::string shape = "width " + std::to_string(cloud.width) + ", height " +
                            std::to_string(cloud.height) + ", points " +
                            std::to_string(points);
  if (points == 0)
    fail("has no points (" + shape + "); give it a cloud with points");
  if (cloud.width != 0 && cloud.height != 0 && header.points() != points)
    fail("has a damaged header: width times height is not the number of points (" +
         shape + "); write the file anew");
  if (cloud.width <= 1 || cloud.height <= 1)
    fail("is not organized (" + shape +
         "); rows and columns as the sensor measured them are needed: save it before "
         "points "
         "are dropped (invalid ones as NaN), or give --size WIDTHxHEIGHT when all are "
         "there, row by row");
  if (points > static_cast<std::uint64_t>(std::numeric_limits<int>::max()))
    fail("has more points than the 2^31 - 1 that can be segmented (" + shape +
         "); cut it into parts");
}

/// Fields of known types that lie one after another and make up a point.
void checkFields(const pcl::PCLPointCloud2& cloud)
{
  std::uint64_t offset = 0;
  for (const auto& field : cloud.fields) {
    const auto size =
        static_cast<std::uint64_t>(pcl::getFieldSize(field.datatype)) * field.count;
    if (size == 0 || field.offset != offset)
      fail("has a field '" + field.name +
           "' whose SIZE, TYPE or COUNT PCL does not know; write the file anew with "
           "sizes 1, 2, 4 or 8 and types I, U or F");
    offset += size;
  }
  if (offset == 0 || offset != cloud.point_step)
    fail("has a damaged header (FIELDS, SIZE, TYPE, COUNT do not agree); write the "
         "file anew");
  // PCL counts the bytes of a row in 32 bits, with the label to come. No product below
  // overflows.
  if (offset > LARGEST_POINT ||
      (offset + 4) * cloud.width > std::numeric_limits<std::uint32_t>::max())
    fail("has rows of more than 2^32 bytes; drop fields or cut it into parts");
}

[[noreturn]] void failTruncated(std::uint64_t needed, std::uint64_t there)
{
  fail("is truncated: its header asks for at least " + std::to_string(needed) +
       " bytes of points, the file holds " + std::to_string(there) +
       "; copy or record it again");
}

/// What the points take in the file at least.
std::uint64_t leastBodySize(const PcdHeader& header)
{
  std::uint64_t numbers = 0;
  for (const auto& field : header.cloud.fields)
    numbers += field.count;
  const std::uint64_t bytes = header.points() * header.cloud.point_step;
  switch (header.format) {
  case PcdFormat::ASCII:
    return 2 * numbers * header.points() - 1; // a digit and a blank each
  case PcdFormat::BINARY:
    return bytes;
  case PcdFormat::BINARY_COMPRESSED:
    break;
  }
  return 8 + bytes / BEST_COMPRESSION;
}

/// Reads the two sizes in front of compressed points; returns the bytes they take.
std::uint64_t compressedBodySize(std::istream& stream, const PcdHeader& header)
{
  for (const auto& field : header.cloud.fields)
    if (field.name == "_")
      fail("has padding fields in compressed points, which PCL cannot read; convert "
           "it with pcl_convert_pcd_ascii_binary");
  std::uint32_t sizes[2] = {0, 0};
  char raw[sizeof sizes];
  stream.read(raw, sizeof raw);
  std::memcpy(sizes, raw, sizeof raw);
  if (sizes[1] != header.points() * header.cloud.point_step)
    fail("is damaged: its compressed points do not have the size that its header "
         "says; copy or record it again");
  return sizes[0] + std::uint64_t{8};
}

} // namespace

const char* formatName(PcdFormat format)
{
  switch (format) {
  case PcdFormat::ASCII:
    return "ascii";
  case PcdFormat::BINARY:
    return "binary";
  case PcdFormat::BINARY_COMPRESSED:
    break;
  }
  return "binary_compressed";
}

PcdHeader readPcdHeader(std::istream& stream, std::uint64_t file_size, ImageSize size)
{
  if (file_size == 0)
    fail("is an empty file; give it a PCD file with points");
  const HeaderText text = splitHeader(stream);
  PcdHeader header;
  // Without POINTS PCL refuses the header, but only after it has read the rest.
  parse(text.all_but_points + text.data_line, header);
  if (header.cloud.fields.empty())
    fail("is not a PCD file, or its header is damaged (no line FIELDS)");
  takeSize(header, claimedPoints(text), size);
  checkShape(header, claimedPoints(text));
  checkFields(header.cloud);

  header.body_start = text.length;
  const std::uint64_t rest = file_size - text.length;
  const std::uint64_t least = leastBodySize(header);
  if (rest < least)
    failTruncated(least, rest);
  header.body_size = rest;
  if (header.format == PcdFormat::BINARY)
    header.body_size = least;
  if (header.format == PcdFormat::BINARY_COMPRESSED) {
    header.body_size = compressedBodySize(stream, header);
    if (rest < header.body_size)
      failTruncated(header.body_size, rest);
  }
  const std::string points = "POINTS " + std::to_string(header.points()) + "\n";
  if (!parse(text.all_but_points + points + text.data_line, header))
    fail("has a header that PCL cannot read; write the file anew");
  takeSize(header, claimedPoints(text), size);
  return header;
}

} // namespace pcl_mrf_planes::io
