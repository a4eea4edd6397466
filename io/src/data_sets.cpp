// SPDX-License-Identifier: BSD-3-Clause
#include "data_sets.h"

#include "file_text.h"
#include "readers.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <map>
#include <new>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace pcl_mrf_planes::io {

namespace fs = std::filesystem;

namespace {

/// Colour and depth further apart than this do not belong together (TUM's associate.py).
constexpr double LONGEST_GAP = 0.02; // seconds

bool isFile(const fs::path& path)
{
  std::error_code error;
  return fs::is_regular_file(path, error);
}

bool isFolder(const fs::path& path)
{
  std::error_code error;
  return fs::is_directory(path, error);
}

/// Words of each line that is no comment.
std::vector<std::vector<std::string>> readLines(const fs::path& path)
{
  std::ifstream stream(path);
  std::vector<std::vector<std::string>> lines;
  for (std::string line; std::getline(stream, line);) {
    std::vector<std::string> parts = words(line);
    if (!parts.empty() && parts[0][0] != '#')
      lines.push_back(std::move(parts));
  }
  return lines;
}

/// Names by time, from depth.txt or rgb.txt.
std::map<double, std::string> readTimes(const fs::path& path)
{
  std::map<double, std::string> names;
  for (const auto& line : readLines(path)) {
    double time = 0.0;
    if (line.size() >= 2 && parseNumber(line[0], time))
      names[time] = line[1];
  }
  return names;
}

std::string nearest(const std::map<double, std::string>& names, double time)
{
  auto best = names.end();
  const auto after = names.lower_bound(time);
  if (after != names.end())
    best = after;
  if (after != names.begin()) {
    const auto before = std::prev(after);
    if (best == names.end() || time - before->first < best->first - time)
      best = before;
  }
  return best == names.end() || std::abs(best->first - time) > LONGEST_GAP
             ? std::string()
             : best->second;
}

bool isNumbered(const fs::path& file)
{
  const std::string stem = file.stem().string();
  return !stem.empty() && stem.size() <= 7 &&
         std::all_of(stem.begin(), stem.end(), [](char c) {
           return std::isdigit(static_cast<unsigned char>(c)) != 0;
         });
}

/// Depth and colour of each frame, names relative to the folder.
using Pairs = std::vector<std::pair<std::string, std::string>>;

/// From lines "time depth/X.png time rgb/Y.png", in either order.
Pairs readAssociations(const fs::path& path)
{
  Pairs pairs;
  for (const auto& line : readLines(path)) {
    std::string depth, colour;
    for (const std::string& word : line)
      if (word.find('/') != std::string::npos)
        (word.find("depth") != std::string::npos ? depth : colour) = word;
    if (!depth.empty())
      pairs.emplace_back(depth, colour);
  }
  return pairs;
}

Pairs readTumLists(const fs::path& folder)
{
  const auto colours = readTimes(folder / "rgb.txt");
  Pairs pairs;
  for (const auto& depth : readTimes(folder / "depth.txt"))
    pairs.emplace_back(depth.second, nearest(colours, depth.first));
  return pairs;
}

/// By the number that TUM's names have: rgbd_dataset_freiburg2_desk.
CameraModel tumCamera(const fs::path& folder)
{
  const std::string name = fs::absolute(folder).lexically_normal().string();
  for (const char* number : {"1", "2", "3"})
    if (name.find("freiburg" + std::string(number)) != std::string::npos)
      return cameraPreset("tum-fr" + std::string(number));
  return cameraPreset("tum");
}

std::vector<FrameSource> toSources(const fs::path& folder, const std::string& start,
                                   const Pairs& pairs, const std::string& reader,
                                   const CameraModel& camera,
                                   const ReadOptions& options)
{
  std::vector<FrameSource> sources;
  for (const auto& pair : pairs) {
    const fs::path depth = folder / pair.first;
    sources.push_back(depthSource(
        depth, start + fs::path(pair.first).replace_extension().string(), reader,
        camera, pair.second.empty() ? "" : (folder / pair.second).string(), options));
  }
  return sources;
}

/// The picture of a Redwood frame: the same number in front, whatever follows.
std::map<std::string, fs::path> picturesByNumber(const fs::path& folder)
{
  std::map<std::string, fs::path> pictures;
  for (const char* name : {"rgb", "image", "color"}) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder / name, error))
      pictures[entry.path().stem().string().substr(
          0, entry.path().stem().string().find('-'))] = entry.path();
  }
  return pictures;
}

/// 00001.png of the indoor scenes, 0000001-000000000000.png of the scans.
bool isRedwoodName(const fs::path& file)
{
  const std::string stem = file.stem().string();
  const std::size_t dash = stem.find('-');
  const bool digits = std::all_of(stem.begin(), stem.end(), [](char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '-';
  });
  return file.extension() == ".png" && digits &&
         ((dash == std::string::npos && stem.size() == 5) ||
          (dash == 7 && stem.size() == 20));
}

Pairs redwoodPairs(const fs::path& folder)
{
  const auto pictures = picturesByNumber(folder);
  Pairs pairs;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder / "depth", error)) {
    if (!isRedwoodName(entry.path()))
      continue;
    const std::string stem = entry.path().stem().string();
    const auto picture = pictures.find(stem.substr(0, stem.find('-')));
    pairs.emplace_back("depth/" + entry.path().filename().string(),
                       picture == pictures.end()
                           ? std::string()
                           : picture->second.lexically_relative(folder).string());
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

} // namespace

FrameSource sourceOf(const fs::path& file, const std::string& name,
                     const std::string& reader, std::function<Frame()> read)
{
  const std::string path = file.string();
  return {name, path, reader, [path, read = std::move(read)] {
            try {
              return read();
            }
            catch (const std::bad_alloc&) {
              throw std::runtime_error("'" + path +
                                       "' does not fit into memory; cut it into parts");
            }
            catch (const std::exception& error) {
              const std::string what = error.what();
              throw std::runtime_error(what[0] == '\'' ? what
                                                       : "'" + path + "' " + what);
            }
          }};
}

FrameSource failingSource(const fs::path& file, const std::string& name,
                          const std::string& message)
{
  return sourceOf(file, name, "none",
                  [message]() -> Frame { throw std::runtime_error(message); });
}

FrameSource depthSource(const fs::path& file, const std::string& name,
                        const std::string& reader,
                        const std::optional<CameraModel>& camera,
                        const std::string& colour, const ReadOptions& options)
{
  return sourceOf(file, name, reader, [=] {
    return readDepthImage(file.string(), options, camera ? &*camera : nullptr, colour);
  });
}

std::vector<FrameSource> framesOfSequence(const fs::path& folder,
                                          const std::string& start,
                                          const ReadOptions& options)
{
  for (const char* name : {"associations.txt", "associate.txt", "association.txt"}) {
    if (!isFile(folder / name))
      continue;
    const Pairs pairs = readAssociations(folder / name);
    if (pairs.empty())
      continue;
    const bool icl = !isFile(folder / "depth.txt") && isNumbered(pairs.front().first);
    return toSources(folder, start, pairs, icl ? "icl-nuim" : "tum",
                     icl ? cameraPreset("icl-nuim") : tumCamera(folder), options);
  }
  if (isFile(folder / "depth.txt"))
    return toSources(folder, start, readTumLists(folder), "tum", tumCamera(folder),
                     options);
  if (isFolder(folder / "depth") &&
      (isFolder(folder / "rgb") || isFolder(folder / "image") ||
       isFolder(folder / "color")))
    return toSources(folder, start, redwoodPairs(folder), "redwood",
                     cameraPreset("redwood"), options);
  return {};
}

} // namespace pcl_mrf_planes::io
