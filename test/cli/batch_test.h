// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cli_test.h"
#include "two_planes.h"

#include <pcl/io/png_io.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace pcl_mrf_planes::test {

/** \brief The app with many frames, run in a folder of its own. */
class BatchTest : public CliTest {
protected:
  using Json = nlohmann::json;

  /// An organized cloud in folders that are made for it.
  void writeScene(const std::string& name) const
  {
    makeFolderOf(name);
    scene_.write(path(name), "binary_compressed");
  }

  /// A wall 2 m away, as a depth image of 160 x 120 points in millimetres.
  void writeDepth(const std::string& name) const
  {
    makeFolderOf(name);
    std::vector<unsigned short> values(160 * 120, 2000);
    pcl::io::saveShortPNGFile(path(name), values.data(), 160, 120, 1);
  }

  void makeFolderOf(const std::string& name) const
  {
    std::filesystem::create_directories(
        std::filesystem::path(path(name)).parent_path());
  }

  bool exists(const std::string& name) const
  {
    return std::filesystem::exists(path(name));
  }

  /// Runs "in" into "out" with more options.
  Outcome batch(std::vector<std::string> options) const
  {
    options.insert(options.begin(), {path("in"), "--output-folder", path("out")});
    return segment(options);
  }

  /// Lines of a table, without its head.
  std::vector<std::string> rows(const std::string& name) const
  {
    std::istringstream stream(read(name));
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);)
      lines.push_back(line);
    EXPECT_FALSE(lines.empty()) << name;
    if (!lines.empty())
      lines.erase(lines.begin());
    return lines;
  }

  /// The files that an unfinished run would leave.
  std::vector<std::string> partialFiles() const
  {
    std::vector<std::string> names;
    for (const std::string& name : files())
      if (name.find("partial") != std::string::npos)
        names.push_back(name);
    return names;
  }

  TwoPlanes scene_;
};

} // namespace pcl_mrf_planes::test
