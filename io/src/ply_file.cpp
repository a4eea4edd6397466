// SPDX-License-Identifier: BSD-3-Clause
#include "file_text.h"
#include "quiet_pcl.h"
#include "readers.h"

#include <pcl/io/ply_io.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <sstream>
#include <stdexcept>

namespace pcl_mrf_planes::io {

namespace {

constexpr std::size_t LONGEST_HEADER = 1 << 16; // bytes
constexpr double MOST_BYTES = 1e18;             // what a message can name

struct Header {
  std::size_t size = 0; ///< bytes
  bool ascii = false;
  double vertices = -1.0;
  double columns = 0.0;
  double rows = 0.0;
  std::size_t vertex_bytes = 0; ///< least in the file
  bool has_grid = false;        ///< element range_grid: not every point has a vertex
};

[[noreturn]] void failHeader(const std::string& what)
{
  throw std::runtime_error("has a damaged header (" + what + "); write the file anew");
}

std::size_t sizeOfType(const std::string& type)
{
  static const std::map<std::string, std::size_t> sizes = {
      {"char", 1},  {"uchar", 1},   {"int8", 1},   {"uint8", 1},
      {"short", 2}, {"ushort", 2},  {"int16", 2},  {"uint16", 2},
      {"int", 4},   {"uint", 4},    {"int32", 4},  {"uint32", 4},
      {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};
  const auto found = sizes.find(type);
  if (found == sizes.end())
    failHeader("unknown type '" + type + "'");
  return found->second;
}

/// One line of the header; \a element is the one that properties belong to.
void readLine(const std::vector<std::string>& line, Header& header,
              std::string& element)
{
  if (line.size() >= 2 && line[0] == "format")
    header.ascii = line[1] == "ascii";
  if (line.size() >= 3 && line[0] == "obj_info" && line[1] == "num_cols")
    parseNumber(line[2], header.columns);
  if (line.size() >= 3 && line[0] == "obj_info" && line[1] == "num_rows")
    parseNumber(line[2], header.rows);
  if (line.size() >= 3 && line[0] == "element") {
    element = line[1];
    header.has_grid = header.has_grid || element == "range_grid";
    if (element == "vertex" && !parseNumber(line[2], header.vertices))
      failHeader("element vertex");
  }
  if (line.size() >= 3 && line[0] == "property" && element == "vertex")
    header.vertex_bytes += header.ascii ? 2 : sizeOfType(line[1]);
}

Header readHeader(const std::string& path)
{
  const std::string text = readStart(path, LONGEST_HEADER);
  Header header;
  std::istringstream stream(text);
  std::string element;
  for (std::string line; std::getline(stream, line);) {
    const std::vector<std::string> parts = words(line);
    if (parts.size() == 1 && parts[0] == "end_header") {
      header.size = static_cast<std::size_t>(stream.tellg());
      return header;
    }
    readLine(parts, header, element);
  }
  failHeader("no line end_header");
}

/// PCL allocates whatever a header claims, so its claims are held against the file.
void check(const Header& header, const std::string& path)
{
  if (!(header.vertices >= 1.0))
    throw std::runtime_error("has no points; give it a cloud with points");
  if (header.vertex_bytes == 0)
    failHeader("element vertex without properties");
  const double needed =
      header.vertices * static_cast<double>(header.vertex_bytes) - 1.0;
  const auto there =
      static_cast<double>(std::filesystem::file_size(path) - header.size);
  if (needed > there) // any number may stand there
    throw std::runtime_error(
        "is truncated: its header asks for at least " +
        std::to_string(static_cast<std::uint64_t>(std::min(needed, MOST_BYTES))) +
        " bytes of points, the file holds " +
        std::to_string(static_cast<std::uint64_t>(there)) +
        "; copy or record it again");
  const double claimed = header.columns * header.rows;
  if (claimed > static_cast<double>(MOST_PIXELS) ||
      (claimed > 0.0 && claimed < header.vertices) ||
      (claimed > 0.0 && !header.has_grid && claimed > header.vertices))
    failHeader("num_cols times num_rows is not the number of points");
}

void takeSize(pcl::PCLPointCloud2& cloud, ImageSize size)
{
  const std::size_t points = static_cast<std::size_t>(cloud.width) * cloud.height;
  if (cloud.width > 1 && cloud.height > 1)
    return;
  if (!size.stated())
    throw std::runtime_error(
        "is not organized (" + std::to_string(points) +
        " points in one row); rows and columns as the sensor measured them are needed: "
        "save it with obj_info num_cols and num_rows, or give --size WIDTHxHEIGHT when "
        "all points are there, row by row");
  if (points != size.points())
    throw std::runtime_error("has " + std::to_string(points) + " points, not the " +
                             std::to_string(size.width) + " x " +
                             std::to_string(size.height) +
                             " that --size says; check it");
  cloud.width = static_cast<std::uint32_t>(size.width);
  cloud.height = static_cast<std::uint32_t>(size.height);
  cloud.row_step = cloud.width * cloud.point_step;
}

} // namespace

CloudFile readPly(const std::string& path, ImageSize size)
{
  check(readHeader(path), path);
  const QuietPcl quiet;
  CloudFile file;
  int version = 0;
  pcl::PLYReader reader;
  if (reader.read(path, file.cloud, file.origin, file.orientation, version) < 0)
    throw std::runtime_error("is a PLY file that PCL cannot read; copy it again, or "
                             "convert it to PCD");
  takeSize(file.cloud, size);
  const std::size_t bytes = static_cast<std::size_t>(file.cloud.width) *
                            file.cloud.height * file.cloud.point_step;
  if (file.cloud.fields.empty() || file.cloud.data.size() != bytes)
    throw std::runtime_error("is a PLY file whose points are not as its header says; "
                             "write the file anew");
  file.format = PcdFormat::BINARY_COMPRESSED;
  return file;
}

} // namespace pcl_mrf_planes::io
