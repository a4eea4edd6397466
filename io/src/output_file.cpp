// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/io/output_file.h>

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>

namespace pcl_mrf_planes::io {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void failToCreate(const std::string& wanted, int error)
{
  throw std::runtime_error("cannot write '" + wanted + "': " + std::strerror(error) +
                           "; check the permissions or name another file");
}

/// The file behind \a path, links followed.
fs::path resolveTarget(const std::string& path)
{
  if (path.empty())
    throw std::runtime_error("the name of an output file is empty; name a file");
  std::error_code error;
  fs::path target(path);
  const bool is_stream = path.compare(0, 5, "/dev/") == 0; // /dev/stdout is a link
  if (!is_stream && fs::is_symlink(target, error)) {
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
  // A rename would go through, but a file that was made read-only is to stay.
  if (fs::exists(target, error) && ::access(target.c_str(), W_OK) != 0)
    failToCreate(path, errno);
  return target;
}

/// A device, pipe, socket or open stream: there is nothing to replace.
bool isSpecial(const fs::path& target)
{
  std::error_code error;
  return fs::exists(target, error) &&
         (!fs::is_regular_file(target, error) || fs::is_symlink(target, error));
}

/// Pours a file into a device or pipe, which itself must stay what and where it is.
void pour(const fs::path& from, const fs::path& to, const std::string& wanted)
{
  std::ofstream stream(to, std::ios::binary);
  stream << std::ifstream(from, std::ios::binary).rdbuf();
  if (!stream.flush())
    throw std::runtime_error("cannot write '" + wanted +
                             "': it does not take the bytes; name another file");
}

/// Names of the temporary files there are, for a signal handler to remove.
class PartialFiles {
public:
  /// The place of \a path, or none when all are taken.
  static int add(const fs::path& path)
  {
    const std::string& name = path.native();
    for (int i = 0; i < PLACES && name.size() < LONGEST; ++i) {
      Place& place = places_[i];
      bool expected = false;
      if (!place.taken.compare_exchange_strong(expected, true))
        continue;
      std::memcpy(place.name, name.c_str(), name.size() + 1);
      place.ready = true;
      return i;
    }
    return -1;
  }
  static void remove(int i)
  {
    if (i < 0)
      return;
    places_[i].ready = false;
    places_[i].taken = false;
  }
  static void unlinkAll()
  {
    for (Place& place : places_)
      if (place.ready)
        ::unlink(place.name);
  }

private:
  static constexpr int PLACES = 256;
  static constexpr std::size_t LONGEST = 4096;
  struct Place {
    std::atomic<bool> taken{false};
    std::atomic<bool> ready{false};
    char name[LONGEST] = {};
  };
  static Place places_[PLACES];
};

PartialFiles::Place PartialFiles::places_[PartialFiles::PLACES];

/// An empty file that no one else has, gone at the end unless it was renamed: beside
/// the target, or for a device or pipe in the folder for such files.
class TemporaryFile {
public:
  TemporaryFile(const fs::path& target, const std::string& wanted)
  {
    const fs::path folder =
        isSpecial(target) ? fs::temp_directory_path() : target.parent_path();
    const std::string start =
        target.stem().string() + ".partial-" + std::to_string(::getpid()) + '-';
    for (int number = 0; number < 1000; ++number) {
      path_ = folder / (start + std::to_string(number) + target.extension().string());
      place_ = PartialFiles::add(path_); // before a signal can find it there
      const int file =
          ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      const int error = errno;
      if (file >= 0) {
        ::close(file);
        return;
      }
      PartialFiles::remove(place_);
      place_ = -1;
      if (error != EEXIST)
        failToCreate(wanted, error);
    }
    failToCreate(wanted, EEXIST);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile()
  {
    std::error_code ignored;
    fs::remove(path_, ignored);
    PartialFiles::remove(place_);
  }
  const fs::path& path() const { return path_; }

private:
  fs::path path_;
  int place_ = -1;
};

} // namespace

void writeAtomically(const std::string& path,
                     const std::function<void(const std::string& temporary)>& write)
{
  const fs::path target = resolveTarget(path);
  try {
    const TemporaryFile temporary(target, path);
    std::error_code none_before;
    const fs::file_status before = fs::status(target, none_before);
    write(temporary.path().string());
    if (isSpecial(target)) {
      pour(temporary.path(), target, path);
      return;
    }
    if (fs::is_regular_file(before))
      fs::permissions(temporary.path(), before.permissions(), none_before);
    fs::rename(temporary.path(), target);
  }
  catch (const fs::filesystem_error& error) {
    throw std::runtime_error("cannot write '" + path + "': " + error.code().message() +
                             "; check the folder's permissions or name another file");
  }
}

void writeBytes(const std::string& path, const std::string& bytes)
{
  writeAtomically(path, [&](const std::string& temporary) {
    std::ofstream stream(temporary, std::ios::binary);
    stream << bytes;
    if (!stream.flush())
      throw std::runtime_error("cannot write '" + path +
                               "'; check the space on the disk");
  });
}

void removePartialFiles()
{
  PartialFiles::unlinkAll();
}

void checkWritable(const std::string& path)
{
  const fs::path target = resolveTarget(path);
  if (!isSpecial(target))
    const TemporaryFile temporary(target, path);
}

} // namespace pcl_mrf_planes::io
