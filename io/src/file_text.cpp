// SPDX-License-Identifier: BSD-3-Clause
#include "file_text.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <system_error>

namespace pcl_mrf_planes::io {

namespace fs = std::filesystem;

namespace {

std::ifstream open(const std::string& path)
{
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status))
    throw std::runtime_error("does not exist; check the name");
  if (!fs::is_regular_file(status))
    throw std::runtime_error("is not a file");
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream)
    throw std::runtime_error(std::string("cannot be opened: ") + std::strerror(errno));
  return stream;
}

} // namespace

std::string readBytes(const std::string& path)
{
  std::ifstream stream = open(path);
  std::ostringstream all;
  all << stream.rdbuf();
  return all.str();
}

std::string readStart(const std::string& path, std::size_t bytes)
{
  std::ifstream stream = open(path);
  std::string start(bytes, '\0');
  stream.read(start.data(), static_cast<std::streamsize>(bytes));
  start.resize(static_cast<std::size_t>(stream.gcount()));
  return start;
}

bool endsIn(const std::string& text, const std::string& end)
{
  return text.size() >= end.size() &&
         text.compare(text.size() - end.size(), end.size(), end) == 0;
}

std::vector<std::string> words(const std::string& line)
{
  std::istringstream stream(line);
  std::vector<std::string> result;
  for (std::string word; stream >> word;)
    result.push_back(word);
  return result;
}

bool parseNumber(const std::string& text, double& value)
{
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  return (stream >> value) && stream.peek() == std::istringstream::traits_type::eof();
}

} // namespace pcl_mrf_planes::io
