// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/io/cloud_file.h>

#include "pcd_header.h"
#include "quiet_pcl.h"

#include <pcl_mrf_planes/io/output_file.h>

#include <pcl/io/pcd_io.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <limits>
#include <locale>
#include <new>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <vector>

namespace pcl_mrf_planes::io {

namespace fs = std::filesystem;

namespace {

/// Opens a regular file and finds its size.
std::uint64_t openFile(const std::string& path, std::ifstream& stream)
{
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status))
    throw std::runtime_error("does not exist; check the name");
  if (!fs::is_regular_file(status))
    throw std::runtime_error("is not a file; name a PCD file");
  errno = 0;
  stream.open(path, std::ios::binary);
  if (!stream)
    throw std::runtime_error(std::string("cannot be opened: ") + std::strerror(errno));
  return fs::file_size(path);
}

void rewind(std::ifstream& stream, const PcdHeader& header)
{
  stream.clear();
  stream.seekg(static_cast<std::streamoff>(header.body_start));
}

/// Whether there is a line with all its numbers for each point: PCL takes short ones.
bool hasAllLines(std::ifstream& stream, const PcdHeader& header)
{
  std::uint64_t needed = 0;
  for (const auto& field : header.cloud.fields)
    needed += field.count;
  rewind(stream, header);
  std::uint64_t lines = 0;
  for (std::string line; lines < header.points() && std::getline(stream, line);) {
    std::uint64_t words = 0;
    bool blank = true;
    for (const char c : line) {
      const bool is_blank = c == ' ' || c == '\t' || c == '\r';
      words += blank && !is_blank ? 1 : 0;
      blank = is_blank;
    }
    if (words > 0 && words < needed)
      return false;
    lines += words > 0 ? 1 : 0;
  }
  return lines == header.points();
}

bool readAscii(std::ifstream& stream, PcdHeader& header)
{
  if (!hasAllLines(stream, header))
    return false;
  rewind(stream, header);
  try {
    return pcl::PCDReader().readBodyASCII(stream, header.cloud, header.version) >= 0;
  }
  catch (const std::bad_alloc&) {
    throw;
  }
  catch (const std::exception&) { // words that are no numbers
    return false;
  }
}

void readBody(std::ifstream& stream, PcdHeader& header)
{
  if (header.format == PcdFormat::ASCII) {
    if (!readAscii(stream, header))
      throw std::runtime_error("is truncated or damaged: fewer than " +
                               std::to_string(header.points()) +
                               " complete lines of points; copy or record it again");
    return;
  }
  rewind(stream, header);
  // PCL unpacks a byte before it looks whether there is one: of nothing, that behind it.
  std::vector<unsigned char> body(header.body_size + 1);
  if (!stream.read(reinterpret_cast<char*>(body.data()),
                   static_cast<std::streamsize>(header.body_size)))
    throw std::runtime_error("cannot be read to its end; copy or record it again");
  const bool compressed = header.format == PcdFormat::BINARY_COMPRESSED;
  if (pcl::PCDReader().readBodyBinary(body.data(), header.cloud, header.version,
                                      compressed, 0) < 0)
    throw std::runtime_error(
        "is damaged: its points cannot be unpacked; copy or record it again");
}

/// Digits after which a number of the cloud is the same when read back.
int asciiPrecision(const pcl::PCLPointCloud2& cloud)
{
  const bool has_double =
      std::any_of(cloud.fields.begin(), cloud.fields.end(), [](const auto& field) {
        return field.datatype == pcl::PCLPointField::FLOAT64;
      });
  return has_double ? std::numeric_limits<double>::max_digits10
                    : std::numeric_limits<float>::max_digits10;
}

/// Through a stream: PCL maps the binary files that it writes itself into memory, and a disk
/// that fills up then ends the program by a signal.
int writeByPcl(const std::string& path, const CloudFile& file, PcdFormat format)
{
  pcl::PCDWriter writer;
  if (format == PcdFormat::ASCII)
    return writer.writeASCII(path, file.cloud, file.origin, file.orientation,
                             asciiPrecision(file.cloud));
  std::ofstream stream(path, std::ios::binary);
  stream.imbue(std::locale::classic());
  if (format == PcdFormat::BINARY) {
    stream << writer.generateHeaderBinary(file.cloud, file.origin, file.orientation)
           << "DATA binary\n";
    stream.write(reinterpret_cast<const char*>(file.cloud.data.data()),
                 static_cast<std::streamsize>(file.cloud.data.size()));
  }
  else if (writer.writeBinaryCompressed(stream, file.cloud, file.origin,
                                        file.orientation) != 0)
    return -1;
  return stream.flush() ? 0 : -1;
}

/// Checks that a file just written is whole, which PCL does not when a disk is full.
PcdHeader checkWhole(const std::string& path, const CloudFile& file)
{
  std::ifstream stream;
  PcdHeader header = readPcdHeader(stream, openFile(path, stream), {});
  if (header.format == PcdFormat::ASCII && !hasAllLines(stream, header))
    throw std::runtime_error("is incomplete");
  if (header.cloud.width != file.cloud.width ||
      header.cloud.height != file.cloud.height)
    throw std::runtime_error("is incomplete");
  return header;
}

/// PCL writes the sensor pose with six digits; puts all of them in.
void writeExactPose(const std::string& path, const CloudFile& file)
{
  std::ostringstream all;
  all << std::ifstream(path, std::ios::binary).rdbuf();
  std::string content = all.str();
  const std::size_t start = content.find("VIEWPOINT");
  const std::size_t end = content.find('\n', start);
  if (start == std::string::npos || end == std::string::npos)
    return;
  std::ostringstream line;
  line.imbue(std::locale::classic());
  line.precision(std::numeric_limits<float>::max_digits10);
  const auto& q = file.orientation;
  line << "VIEWPOINT " << file.origin[0] << ' ' << file.origin[1] << ' '
       << file.origin[2] << ' ' << q.w() << ' ' << q.x() << ' ' << q.y() << ' '
       << q.z();
  content.replace(start, end - start, line.str());
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  if (!out.flush())
    throw std::runtime_error("is incomplete");
}

bool samePose(const PcdHeader& header, const CloudFile& file)
{
  return header.origin.head<3>() == file.origin.head<3>() &&
         header.orientation.coeffs() == file.orientation.coeffs();
}

} // namespace

CloudFile readOrganizedCloud(const std::string& path, ImageSize size)
{
  try {
    const QuietPcl quiet;
    std::ifstream stream;
    const std::uint64_t bytes = openFile(path, stream);
    PcdHeader header = readPcdHeader(stream, bytes, size);
    readBody(stream, header);
    CloudFile file;
    file.cloud = std::move(header.cloud);
    file.origin = header.origin;
    file.orientation = header.orientation;
    file.format = header.format;
    return file;
  }
  catch (const std::bad_alloc&) {
    throw std::runtime_error("'" + path +
                             "' does not fit into memory; cut it into parts");
  }
  catch (const std::exception& error) {
    throw std::runtime_error("'" + path + "' " + error.what());
  }
}

void writeCloud(const std::string& path, const CloudFile& file, PcdFormat format)
{
  writeAtomically(path, [&](const std::string& temporary) {
    try {
      const QuietPcl quiet;
      if (writeByPcl(temporary, file, format) < 0)
        throw std::runtime_error("was refused by PCL");
      if (!samePose(checkWhole(temporary, file), file)) {
        writeExactPose(temporary, file);
        checkWhole(temporary, file);
      }
    }
    catch (const std::bad_alloc&) {
      throw;
    }
    catch (const std::exception&) {
      throw std::runtime_error("cannot write '" + path + "' as " + formatName(format) +
                               "; check the space on the disk, or choose another file "
                               "or --format");
    }
  });
}

} // namespace pcl_mrf_planes::io
