// SPDX-License-Identifier: BSD-3-Clause
#include "output_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace pcl_mrf_planes::apps {

namespace fs = std::filesystem;

namespace {

/// The file behind \a path, links followed.
fs::path resolveTarget(const std::string& path)
{
  if (path.empty())
    throw std::runtime_error("the name of an output file is empty; name a file");
  std::error_code error;
  fs::path target(path);
  if (fs::is_symlink(target, error)) {
    const fs::path followed = fs::weakly_canonical(target, error);
    if (!error)
      target = followed;
  }
  if (fs::is_directory(target, error))
    throw std::runtime_error("cannot write '" + path +
                             "': it is a folder; name a file in it");
  const fs::path folder = target.has_parent_path() ? target.parent_path() : ".";
  if (!fs::is_directory(folder, error))
    throw std::runtime_error("cannot write '" + path + "': there is no folder '" +
                             folder.string() + "'; create it or name another");
  return target;
}

/// A device, pipe or socket: there is nothing to replace.
bool isSpecial(const fs::path& target)
{
  std::error_code error;
  return fs::exists(target, error) && !fs::is_regular_file(target, error);
}

fs::path temporaryBeside(const fs::path& target)
{
  fs::path name = target.stem();
  name += ".partial-" + std::to_string(::getpid());
  name += target.extension();
  return target.parent_path() / name;
}

/// Removes a file when it goes out of scope, unless told to keep it.
class TemporaryFile {
public:
  explicit TemporaryFile(fs::path path)
  : path_(std::move(path))
  {}
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile()
  {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  const fs::path& path() const { return path_; }

private:
  fs::path path_;
};

/// Creates the file, empty, or says why that is impossible.
void create(const fs::path& file, const std::string& wanted)
{
  errno = 0;
  const std::ofstream stream(file, std::ios::binary);
  if (!stream)
    throw std::runtime_error("cannot write '" + wanted +
                             "': " + std::strerror(errno != 0 ? errno : EIO) +
                             "; check the folder's permissions or name another file");
}

} // namespace

void writeAtomically(const std::string& path,
                     const std::function<void(const std::string& temporary)>& write)
{
  const fs::path target = resolveTarget(path);
  try {
    if (isSpecial(target)) {
      write(target.string());
      return;
    }
    const TemporaryFile temporary(temporaryBeside(target));
    create(temporary.path(), path);
    std::error_code none_before;
    const fs::file_status before = fs::status(target, none_before);
    write(temporary.path().string());
    if (fs::is_regular_file(before))
      fs::permissions(temporary.path(), before.permissions(), none_before);
    fs::rename(temporary.path(), target);
  }
  catch (const fs::filesystem_error& error) {
    throw std::runtime_error("cannot write '" + path + "': " + error.code().message() +
                             "; check the folder's permissions or name another file");
  }
}

void checkWritable(const std::string& path)
{
  const fs::path target = resolveTarget(path);
  if (isSpecial(target))
    return;
  const TemporaryFile temporary(temporaryBeside(target));
  create(temporary.path(), path);
}

} // namespace pcl_mrf_planes::apps
