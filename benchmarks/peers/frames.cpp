// SPDX-License-Identifier: BSD-3-Clause
#include "frames.h"

#include "evaluation/png_labels.h"

#include <pcl/io/pcd_io.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace pcl_mrf_planes::benchmarks {

namespace fs = std::filesystem;

namespace {

std::string truthOf(const fs::path& cloud)
{
  for (const char* ending : {".gt.png", ".faces.png", ".pgt.png"}) {
    fs::path truth = cloud;
    truth.replace_extension(ending);
    if (fs::exists(truth))
      return truth.string();
  }
  return {};
}

std::vector<fs::path> sortedEntries(const fs::path& folder)
{
  if (!fs::is_directory(folder))
    throw std::runtime_error("there is no folder '" + folder.string() + "'");
  std::vector<fs::path> entries;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    entries.push_back(entry.path());
  std::sort(entries.begin(), entries.end());
  return entries;
}

std::vector<std::string> allSets(const std::string& folder)
{
  std::vector<std::string> sets;
  for (const fs::path& entry : sortedEntries(folder))
    if (fs::is_directory(entry))
      sets.push_back(entry.filename().string());
  return sets;
}

} // namespace

std::vector<Frame> listFrames(const std::string& folder,
                              const std::vector<std::string>& sets)
{
  std::vector<Frame> frames;
  for (const std::string& set : sets.empty() ? allSets(folder) : sets)
    for (const fs::path& entry : sortedEntries(fs::path(folder) / set))
      if (entry.extension() == ".pcd")
        frames.push_back({set, entry.stem().string(), entry.string(), truthOf(entry)});
  return frames;
}

Cloud::Ptr readCloud(const Frame& frame)
{
  Cloud::Ptr cloud(new Cloud);
  if (pcl::io::loadPCDFile(frame.cloud, *cloud) < 0)
    throw std::runtime_error("cannot read '" + frame.cloud + "'");
  if (!cloud->isOrganized())
    throw std::runtime_error("'" + frame.cloud + "' is not organized");
  return cloud;
}

evaluation::LabelImage readTruth(const Frame& frame)
{
  try {
    return evaluation::readLabelPng(frame.truth);
  }
  catch (const std::runtime_error& error) {
    throw std::runtime_error("'" + frame.truth + "' " + error.what());
  }
}

} // namespace pcl_mrf_planes::benchmarks
