// SPDX-License-Identifier: BSD-3-Clause
#include "file_sources.h"

#include "data_sets.h"
#include "file_kind.h"
#include "file_text.h"
#include "readers.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <system_error>

namespace pcl_mrf_planes::io {

namespace fs = std::filesystem;

namespace {

constexpr const char* READABLE =
    "PCD, PLY, PCLZF, 16-bit gray PNG and PGM, the text depth of ICL-NUIM, the labeled "
    "set of NYU Depth V2 and the range images of SegComp";

/// Takes an ending away, unless it is all there is.
bool strip(std::string& name, const std::string& ending)
{
  if (!endsIn(name, ending) || name.size() == ending.size())
    return false;
  name.resize(name.size() - ending.size());
  return true;
}

/// What the results of a file are called: its name without the endings we know.
std::string frameName(const fs::path& file)
{
  std::string name = file.filename().string();
  for (const char* ending : {".pcd", ".ply", ".mat", ".range", ".ras"})
    if (strip(name, ending))
      return name;
  for (const char* ending : {".png", ".pgm", ".pclzf"})
    if (strip(name, ending)) {
      if (!strip(name, ".depth"))
        strip(name, "_depth");
      return name;
    }
  strip(name, ".depth");
  return name;
}

/// A picture of labels, which has 16 bits as a depth image has.
bool isLabels(const std::string& name)
{
  const auto ends = {".gt.png", ".pgt.png", ".faces.png", ".labels.png", ".label.png"};
  return std::any_of(ends.begin(), ends.end(),
                     [&](const char* end) { return endsIn(name, end); });
}

/// Whether it would be taken for depth by its name, so that its being none is an error.
bool saysDepth(const std::string& name)
{
  return name.find("depth") != std::string::npos;
}

bool isSevenScenes(const std::string& name)
{
  constexpr std::size_t DIGITS = 6;
  const std::string start = "frame-", end = ".depth.png";
  if (name.size() != start.size() + DIGITS + end.size() ||
      name.compare(0, start.size(), start) != 0 || !endsIn(name, end))
    return false;
  return std::all_of(name.begin() + 6, name.begin() + 12, [](char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
  });
}

bool isSynpeb(const fs::path& file)
{
  return file.filename().string().compare(0, 3, "pc_") == 0 ||
         file.parent_path().string().find("synpeb") != std::string::npos;
}

/// NAME.color.png and the like for NAME.depth.png.
std::string pictureBeside(const fs::path& file)
{
  const std::string start = (file.parent_path() / frameName(file)).string();
  for (const char* end : {".color.png", ".color.jpg", ".rgb.png", ".rgb.jpg",
                          "_color.png", "_rgb.png", "_rgb.jpg", ".jpg", ".png"}) {
    std::error_code error;
    if (start + end != file.string() && fs::is_regular_file(start + end, error))
      return start + end;
  }
  return {};
}

std::vector<FrameSource> framesOfNyu(const fs::path& file, const std::string& start,
                                     const ReadOptions& options)
{
  std::vector<FrameSource> frames;
  try {
    const std::size_t count = countNyuFrames(file.string());
    for (std::size_t i = 0; i < count; ++i) {
      char number[32];
      std::snprintf(number, sizeof number, "/%04zu", i + 1);
      frames.push_back(
          sourceOf(file, start + frameName(file) + number, "nyu-labeled",
                   [=] { return readNyuFrame(file.string(), i, options); }));
      frames.back().input += '#';
      frames.back().input += std::to_string(i + 1);
    }
  }
  catch (const std::runtime_error& error) {
    frames.push_back(failingSource(file, start + frameName(file), error.what()));
  }
  return frames;
}

std::vector<FrameSource> framesOfDepthImage(const fs::path& file,
                                            const std::string& name,
                                            const ReadOptions& options)
{
  const bool seven = isSevenScenes(file.filename().string());
  std::optional<CameraModel> camera;
  if (seven)
    camera = cameraPreset("7scenes");
  return {depthSource(file, name, seven ? "7scenes" : "depth-image", camera,
                      pictureBeside(file), options)};
}

/// An image of 8 bits: a range image of ABW by its name, else no depth image.
std::vector<FrameSource> framesOfGray8(const fs::path& file, const std::string& name,
                                       bool named, FileKind kind,
                                       const ReadOptions& options)
{
  const std::string path = file.string();
  const std::string own = file.filename().string();
  const bool truth = endsIn(own, ".gt-seg");
  const bool abw =
      own.find("abw.") != std::string::npos || kind == FileKind::SUN_RASTER;
  if (abw && !truth && kind != FileKind::OTHER_PNG)
    return {sourceOf(file, name, "segcomp-abw", [path] { return readAbw(path); })};
  if (named || (saysDepth(own) && !truth && !isLabels(own)))
    return {depthSource(file, name, "depth-image", {}, "", options)};
  return {};
}

std::vector<FrameSource> framesOfKind(FileKind kind, const fs::path& file,
                                      const std::string& name, bool named,
                                      const ReadOptions& options)
{
  const std::string path = file.string();
  switch (kind) {
  case FileKind::PCD: {
    const bool synpeb = isSynpeb(file);
    return {sourceOf(file, name, synpeb ? "synpeb" : "pcd",
                     [=] { return readPcd(path, options, synpeb); })};
  }
  case FileKind::PLY:
    return {sourceOf(file, name, "ply", [=] {
      Frame frame;
      frame.file = readPly(path, options.size);
      return frame;
    })};
  case FileKind::PCLZF:
    if (!named && (endsIn(path, "_rgb.pclzf") || endsIn(path, "_image.pclzf")))
      return {};
    return {sourceOf(file, name, "pclzf", [=] { return readPclzf(path, options); })};
  case FileKind::DEPTH_PNG:
  case FileKind::DEPTH_PGM:
    if (!named && isLabels(file.filename().string()))
      return {};
    return framesOfDepthImage(file, name, options);
  case FileKind::OTHER_PNG:
  case FileKind::OTHER_PGM:
  case FileKind::SUN_RASTER:
    return framesOfGray8(file, name, named, kind, options);
  case FileKind::TEXT_DEPTH:
    return {sourceOf(file, name, "icl-nuim-text",
                     [=] { return readTextDepth(path, options); })};
  case FileKind::PERCEPTRON:
    return {sourceOf(file, name, "segcomp-perceptron",
                     [path] { return readPerceptron(path); })};
  case FileKind::COMPRESSED:
    return named ? std::vector<FrameSource>{failingSource(
                       file, name, "is compressed; unpack it first")}
                 : std::vector<FrameSource>{};
  case FileKind::HDF5:
  case FileKind::OTHER:
    break;
  }
  return named ? std::vector<FrameSource>{failingSource(
                     file, name,
                     std::string("is none of the files that can be read (") + READABLE +
                         "); convert it to one of these")}
               : std::vector<FrameSource>{};
}

} // namespace

std::vector<FrameSource> framesOfFile(const fs::path& file, const std::string& start,
                                      bool named, const ReadOptions& options)
{
  const std::string name = start + frameName(file);
  try {
    const FileKind kind = fileKind(file.string());
    if (kind == FileKind::HDF5)
      return framesOfNyu(file, start, options);
    return framesOfKind(kind, file, name, named, options);
  }
  catch (const std::runtime_error& error) { // it cannot be looked into
    return {failingSource(file, name, error.what())};
  }
}

} // namespace pcl_mrf_planes::io
