// SPDX-License-Identifier: BSD-3-Clause
#include "file_kind.h"

#include "file_text.h"
#include "netpbm_file.h"

#include <algorithm>
#include <cctype>
#include <exception>
#include <filesystem>

namespace pcl_mrf_planes::io {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t START = 4096;
constexpr std::size_t PNG_BIT_DEPTH = 24; // bytes from the start, in IHDR
constexpr std::size_t PNG_COLOUR_TYPE = 25;

/// 512 by 512 words of range and reflectance, behind a header of text.
constexpr std::uintmax_t PERCEPTRON_BYTES = std::uintmax_t{4} * 512 * 512;

bool begins(const std::string& text, const std::string& with, std::size_t at = 0)
{
  return text.compare(at, with.size(), with) == 0;
}

FileKind pngKind(const std::string& start)
{
  const bool gray16 = start.size() > PNG_COLOUR_TYPE && start[PNG_BIT_DEPTH] == 16 &&
                      start[PNG_COLOUR_TYPE] == 0;
  return gray16 ? FileKind::DEPTH_PNG : FileKind::OTHER_PNG;
}

FileKind pgmKind(const std::string& start)
{
  try {
    return parseNetpbmHeader(start).maximum > 255 ? FileKind::DEPTH_PGM
                                                  : FileKind::OTHER_PGM;
  }
  catch (const std::exception&) {
    return FileKind::OTHER_PGM;
  }
}

/// HDF5 may follow a block of the user's, as MATLAB's 512 bytes.
bool isHdf5(const std::string& start)
{
  const std::string signature("\x89HDF\r\n\x1a\n");
  for (const std::size_t at : {0u, 512u, 1024u, 2048u})
    if (start.size() > at && begins(start, signature, at))
      return true;
  return false;
}

bool isNumbers(const std::string& start)
{
  return !start.empty() && std::all_of(start.begin(), start.end(), [](char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0 ||
           std::isspace(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' ||
           c == '+' || c == 'e' || c == 'E';
  });
}

FileKind kindByEnding(const fs::path& path)
{
  const std::string ending = path.extension().string();
  if (ending == ".pcd")
    return FileKind::PCD;
  if (ending == ".ply")
    return FileKind::PLY;
  if (ending == ".pclzf")
    return FileKind::PCLZF;
  if (ending == ".mat")
    return FileKind::HDF5;
  if (ending == ".pgm")
    return FileKind::OTHER_PGM;
  return FileKind::OTHER;
}

} // namespace

FileKind fileKind(const std::string& path)
{
  const std::string start = readStart(path, START);
  const std::string name = fs::path(path).filename().string();
  if (begins(start, "\x89PNG\r\n\x1a\n"))
    return pngKind(start);
  if (begins(start, "P5"))
    return pgmKind(start);
  if (begins(start, "ply\n") || begins(start, "ply\r"))
    return FileKind::PLY;
  if (begins(start, "PCLZF"))
    return FileKind::PCLZF;
  if (begins(start, "\x59\xa6\x6a\x95"))
    return FileKind::SUN_RASTER;
  if (isHdf5(start))
    return FileKind::HDF5;
  if (begins(start, "\x1f\x8b") || begins(start, "\x1f\x9d") ||
      begins(start, "PK\x03\x04"))
    return FileKind::COMPRESSED;
  if (start.find("FIELDS") != std::string::npos &&
      start.find("WIDTH") != std::string::npos)
    return FileKind::PCD;
  if (begins(name, "perc.") && !endsIn(name, "gt-ang") &&
      (start.find(':') < start.find('\n') || fs::file_size(path) > PERCEPTRON_BYTES))
    return FileKind::PERCEPTRON;
  if (endsIn(name, ".depth") && isNumbers(start))
    return FileKind::TEXT_DEPTH;
  return kindByEnding(path);
}

} // namespace pcl_mrf_planes::io
