// SPDX-License-Identifier: BSD-3-Clause
#include "frame_list.h"

#include "option_values.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <tuple>

namespace pcl_mrf_planes::evaluation {

namespace fs = std::filesystem;

namespace {

void checkFolder(const std::string& path, const char* option)
{
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status))
    throw std::runtime_error(std::string(option) + " '" + path +
                             "' does not exist; check the name");
  if (!fs::is_directory(status))
    throw std::runtime_error(std::string(option) + " '" + path +
                             "' is not a folder; name one, or give TRUTH LABELS as "
                             "pairs of files");
}

/// The file's name without the suffix that fits; empty if none does.
std::string nameOf(const fs::path& file, const std::vector<std::string>& suffixes)
{
  const std::string name = file.filename().string();
  if (name[0] == '.')
    return {};
  for (const std::string& suffix : suffixes) {
    const std::string end = "." + suffix;
    if (name.size() > end.size() &&
        name.compare(name.size() - end.size(), end.size(), end) == 0)
      return name.substr(0, name.size() - end.size());
  }
  return {};
}

/// The result at \a place below the folder of the results, or nothing.
std::string findLabels(const fs::path& place)
{
  for (const char* ending : {".png", ".labels.png", ".pcd"}) {
    const fs::path file = place.string() + ending;
    std::error_code error;
    if (fs::exists(file, error))
      return file.string();
  }
  return {};
}

std::string findCloud(const fs::path& place)
{
  std::string file = place.string() + ".pcd";
  std::error_code error;
  if (!fs::exists(file, error))
    throw std::runtime_error("the cloud '" + file +
                             "' does not exist; check --cloud, or leave it out");
  return file;
}

std::vector<fs::path> filesBelow(const std::string& folder)
{
  std::vector<fs::path> files;
  try {
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (!entry.is_directory())
        files.push_back(entry.path());
  }
  catch (const fs::filesystem_error& error) {
    throw std::runtime_error("'" + error.path1().string() + "' cannot be read: " +
                             error.code().message() + "; check its permissions");
  }
  return files;
}

} // namespace

std::vector<FrameFiles> findFrames(const std::string& truth, const std::string& labels,
                                   const std::string& clouds,
                                   const std::vector<std::string>& suffixes)
{
  checkFolder(truth, "--truth");
  checkFolder(labels, "--labels");
  if (!clouds.empty())
    checkFolder(clouds, "--cloud");
  std::vector<FrameFiles> frames;
  for (const fs::path& file : filesBelow(truth)) {
    const std::string name = nameOf(file, suffixes);
    if (name.empty())
      continue;
    const fs::path relative = file.parent_path().lexically_relative(truth);
    const std::string set = relative == "." ? "" : relative.generic_string();
    frames.push_back(
        {set, name, file.string(), findLabels(fs::path(labels) / set / name), ""});
  }
  if (frames.empty())
    throw std::runtime_error("'" + truth + "' has no file that ends in " +
                             apps::join(suffixes, " or ") +
                             "; check --truth, or name the ending by --suffix");
  std::sort(frames.begin(), frames.end(), [](const auto& a, const auto& b) {
    return std::tie(a.set, a.name, a.truth) < std::tie(b.set, b.name, b.truth);
  });
  if (!clouds.empty())
    for (FrameFiles& frame : frames)
      frame.cloud = findCloud(fs::path(clouds) / frame.set / frame.name);
  return frames;
}

std::vector<FrameFiles> pairFrames(const std::vector<std::string>& files,
                                   const std::string& clouds,
                                   const std::vector<std::string>& suffixes)
{
  if (!clouds.empty())
    checkFolder(clouds, "--cloud");
  std::vector<FrameFiles> frames;
  for (std::size_t i = 0; i + 1 < files.size(); i += 2) {
    const fs::path truth = files[i];
    const std::string named = nameOf(truth, suffixes);
    const std::string name = named.empty() ? truth.stem().string() : named;
    frames.push_back({"", fs::path(files[i + 1]).filename().string(), files[i],
                      files[i + 1],
                      clouds.empty() ? "" : findCloud(fs::path(clouds) / name)});
  }
  return frames;
}

} // namespace pcl_mrf_planes::evaluation
