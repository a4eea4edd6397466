// SPDX-License-Identifier: BSD-3-Clause
#include "data_sets.h"
#include "file_sources.h"

#include <pcl_mrf_planes/io/frame.h>

#include <glob.h>

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace pcl_mrf_planes::io {

namespace fs = std::filesystem;

namespace {

/// Of frames of one name in one folder the first of these is taken.
int preference(const FrameSource& frame)
{
  int rank = 0;
  for (const char* reader : {"pcd", "synpeb", "ply", "pclzf", "depth-image"}) {
    if (frame.reader == reader)
      return rank;
    ++rank;
  }
  return rank;
}

/// Frames below a folder, and each folder once, however links lead to it.
class FolderWalk {
public:
  FolderWalk(const ReadOptions& options, const std::string& excluded, FrameList& list)
  : options_(options)
  , list_(list)
  {
    std::error_code error;
    if (!excluded.empty())
      visited_.insert(fs::weakly_canonical(excluded, error));
  }

  void walk(const fs::path& folder, const std::string& start)
  {
    std::error_code error;
    if (!visited_.insert(fs::weakly_canonical(folder, error)).second)
      return;
    std::vector<FrameSource> sequence = framesOfSequence(folder, start, options_);
    if (!sequence.empty()) {
      std::move(sequence.begin(), sequence.end(), std::back_inserter(list_.frames));
      return;
    }
    std::vector<fs::path> folders, files;
    std::error_code unreadable;
    entriesOf(folder, files, folders, unreadable);
    if (unreadable)
      list_.frames.push_back(failingSource(
          folder,
          start.empty() ? folder.filename().string()
                        : start.substr(0, start.size() - 1),
          "cannot be read: " + unreadable.message() + "; check its permissions"));
    takeFiles(files, start);
    for (const fs::path& below : folders)
      walk(below, start + below.filename().string() + "/");
  }

private:
  static void entriesOf(const fs::path& folder, std::vector<fs::path>& files,
                        std::vector<fs::path>& folders, std::error_code& error)
  {
    for (const auto& entry : fs::directory_iterator(folder, error)) {
      std::error_code ignored;
      if (entry.path().filename().string()[0] == '.')
        continue;
      if (entry.is_directory(ignored))
        folders.push_back(entry.path());
      else if (entry.is_regular_file(ignored))
        files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    std::sort(folders.begin(), folders.end());
  }

  void takeFiles(const std::vector<fs::path>& files, const std::string& start)
  {
    std::map<std::string, FrameSource> by_name;
    for (const fs::path& file : files) {
      std::vector<FrameSource> frames = framesOfFile(file, start, false, options_);
      if (frames.empty())
        list_.passed_over.push_back(file.string());
      for (FrameSource& frame : frames) {
        const auto found = by_name.find(frame.name);
        if (found == by_name.end())
          by_name.emplace(frame.name, std::move(frame));
        else if (preference(frame) < preference(found->second))
          found->second = std::move(frame);
      }
    }
    for (auto& frame : by_name)
      list_.frames.push_back(std::move(frame.second));
  }

  const ReadOptions& options_;
  FrameList& list_;
  std::set<fs::path> visited_;
};

bool isPattern(const std::string& input)
{
  return input.find_first_of("*?[") != std::string::npos;
}

std::vector<std::string> matches(const std::string& pattern)
{
  glob_t found{};
  std::vector<std::string> names;
  if (::glob(pattern.c_str(), 0, nullptr, &found) == 0)
    names.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  ::globfree(&found);
  if (names.empty())
    throw std::runtime_error("'" + pattern + "' fits no file or folder; check it");
  return names;
}

/// The folders that a match of a pattern has below the part without wildcards.
std::string placeBelow(const std::string& pattern, const fs::path& match)
{
  const std::string fixed = pattern.substr(0, pattern.find_first_of("*?["));
  const fs::path folder = fs::path(fixed).parent_path();
  const fs::path below =
      match.parent_path().lexically_relative(folder.empty() ? "." : folder);
  return below.empty() || below == "." ? std::string() : below.string() + "/";
}

/// A path as the name of results: no root, no way up.
std::string wholeName(const fs::path& path)
{
  std::string name;
  for (const fs::path& part : path.lexically_normal().relative_path())
    if (part != "..") {
      if (!name.empty())
        name += '/';
      name += part.string();
    }
  return name;
}

/// Frames of different inputs that would have the same results get longer names; a frame
/// that was named twice stays once.
void makeNamesUnique(std::vector<FrameSource>& frames)
{
  std::map<std::string, int> uses;
  std::set<std::string> inputs, names;
  std::vector<FrameSource> kept;
  for (FrameSource& frame : frames)
    if (inputs.insert(frame.input).second) {
      ++uses[frame.name];
      kept.push_back(std::move(frame));
    }
  for (FrameSource& frame : kept) {
    if (uses[frame.name] > 1)
      frame.name = wholeName(frame.input);
    if (!names.insert(frame.name).second)
      throw std::runtime_error("'" + frame.input +
                               "' and another input would have the "
                               "same results '" +
                               frame.name + "'; run them into two folders");
  }
  frames = std::move(kept);
}

/// One input's frames into the list.
void takeInput(const fs::path& path, const std::string& below, bool several,
               const ReadOptions& options, const std::string& excluded, FrameList& list)
{
  const std::size_t before = list.frames.size();
  std::error_code error;
  if (!fs::is_directory(path, error)) {
    for (FrameSource& frame : framesOfFile(path, below, true, options))
      list.frames.push_back(std::move(frame));
    return;
  }
  if (!excluded.empty() && fs::equivalent(path, excluded, error))
    throw std::runtime_error("'" + path.string() +
                             "' would take the results as well; name another folder "
                             "for them");
  const fs::path own = fs::weakly_canonical(path, error).filename();
  FolderWalk(options, excluded, list)
      .walk(path, below + (several ? own.string() + "/" : std::string()));
  if (list.frames.size() == before)
    throw std::runtime_error("'" + path.string() +
                             "' has no file that can be read as a frame; see "
                             "doc/inputs.md for what can");
}

} // namespace

FrameList listFrames(const std::vector<std::string>& inputs, const ReadOptions& options,
                     const std::string& excluded)
{
  FrameList list;
  const bool several = inputs.size() > 1;
  for (const std::string& input : inputs) {
    try {
      std::error_code error;
      if (fs::exists(input, error) || !isPattern(input))
        takeInput(input, "", several, options, excluded, list);
      else
        for (const std::string& match : matches(input))
          takeInput(match, placeBelow(input, match), true, options, excluded, list);
    }
    catch (const std::runtime_error& error) {
      if (!several)
        throw;
      list.frames.push_back(failingSource(input, wholeName(input), error.what()));
    }
  }
  makeNamesUnique(list.frames);
  return list;
}

} // namespace pcl_mrf_planes::io
