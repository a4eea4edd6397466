// SPDX-License-Identifier: BSD-3-Clause
#include "readers.h"

#include <hdf5.h>

#include <limits>
#include <mutex>
#include <stdexcept>

namespace pcl_mrf_planes::io {

namespace {

/// HDF5 for one thread, as Debian builds it, and without its words on standard error,
/// which are no message for users.
class UseHdf5 {
public:
  UseHdf5()
  : guard_(lock())
  {
    H5Eget_auto2(H5E_DEFAULT, &print_, &print_data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  UseHdf5(const UseHdf5&) = delete;
  UseHdf5& operator=(const UseHdf5&) = delete;
  ~UseHdf5() { H5Eset_auto2(H5E_DEFAULT, print_, print_data_); }

private:
  static std::mutex& lock()
  {
    static std::mutex all;
    return all;
  }

  std::lock_guard<std::mutex> guard_;
  H5E_auto2_t print_ = nullptr;
  void* print_data_ = nullptr;
};

/// A handle of HDF5, closed at the end.
class Handle {
public:
  Handle(hid_t id, herr_t (*close)(hid_t))
  : id_(id)
  , close_(close)
  {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle()
  {
    if (id_ >= 0)
      close_(id_);
  }
  hid_t id() const { return id_; }
  bool valid() const { return id_ >= 0; }

private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

[[noreturn]] void failDamaged()
{
  throw std::runtime_error(
      "is an HDF5 file that is truncated or damaged; copy it again");
}

hid_t openFile(const std::string& path)
{
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file < 0)
    failDamaged();
  return file;
}

/// An array of the file: MATLAB's height x width [x 3] x frames, whose last dimension
/// comes first here.
class Array {
public:
  Array(hid_t file, const char* name)
  : data_(H5Lexists(file, name, H5P_DEFAULT) > 0 ? H5Dopen2(file, name, H5P_DEFAULT)
                                                 : hid_t{-1},
          H5Dclose)
  {
    if (!data_.valid())
      return;
    const Handle space(H5Dget_space(data_.id()), H5Sclose);
    const int rank = H5Sget_simple_extent_ndims(space.id());
    if (rank < 2 || rank > 4)
      return;
    shape_.resize(static_cast<std::size_t>(rank));
    H5Sget_simple_extent_dims(space.id(), shape_.data(), nullptr);
  }
  bool exists() const { return !shape_.empty(); }
  const std::vector<hsize_t>& shape() const { return shape_; }

  /// All of frame \a index.
  template <typename T>
  std::vector<T> read(std::size_t index, hid_t type) const
  {
    std::vector<hsize_t> start(shape_.size(), 0), count = shape_;
    start[0] = index;
    count[0] = 1;
    std::size_t size = 1;
    for (const hsize_t n : count)
      size *= static_cast<std::size_t>(n);
    std::vector<T> values(size);
    const Handle space(H5Dget_space(data_.id()), H5Sclose);
    const Handle memory(
        H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr),
        H5Sclose);
    if (H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, start.data(), nullptr,
                            count.data(), nullptr) < 0 ||
        H5Dread(data_.id(), type, memory.id(), space.id(), H5P_DEFAULT, values.data()) <
            0)
      failDamaged();
    return values;
  }

private:
  Handle data_;
  std::vector<hsize_t> shape_;
};

void checkDepth(const Array& depth)
{
  if (!depth.exists())
    throw std::runtime_error("has no array 'depths' or 'rawDepths'; the labeled set of "
                             "NYU Depth V2 is read from HDF5, nothing else");
  if (depth.shape().size() != 3)
    throw std::runtime_error("has depths of " + std::to_string(depth.shape().size()) +
                             " dimensions; frames x width x height are due");
  const auto& shape = depth.shape();
  if (shape[1] < 1 || shape[2] < 1 || shape[1] > MOST_PIXELS / shape[2] ||
      shape[1] > 65536 || shape[2] > 65536)
    throw std::runtime_error("has depths of an impossible size; copy it again");
}

const char* depthName(hid_t file, bool filled)
{
  const char* wanted = filled ? "depths" : "rawDepths";
  const char* other = filled ? "rawDepths" : "depths";
  return H5Lexists(file, wanted, H5P_DEFAULT) > 0 ? wanted : other;
}

/// Rows of points from MATLAB's columns.
template <typename From, typename To, typename Convert>
void transpose(const std::vector<From>& columns, int width, int height,
               std::vector<To>& rows, const Convert& convert)
{
  const auto w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
  for (std::size_t x = 0; x < w; ++x)
    for (std::size_t y = 0; y < h; ++y)
      convert(columns, x * h + y, rows[y * w + x]);
}

std::vector<Colour> readColours(hid_t file, std::size_t index, ImageSize size)
{
  const Array images(file, "images");
  const std::vector<hsize_t> due = {images.exists() ? images.shape()[0] : 0, 3,
                                    static_cast<hsize_t>(size.width),
                                    static_cast<hsize_t>(size.height)};
  if (!images.exists() || images.shape() != due || index >= due[0])
    return {};
  const auto channels = images.read<std::uint8_t>(index, H5T_NATIVE_UINT8);
  std::vector<Colour> colours(size.points());
  transpose(channels, size.width, size.height, colours,
            [&](const std::vector<std::uint8_t>& from, std::size_t i, Colour& to) {
              for (std::size_t c = 0; c < 3; ++c)
                to[c] = from[c * size.points() + i];
            });
  return colours;
}

} // namespace

std::size_t countNyuFrames(const std::string& path)
{
  const UseHdf5 only_user;
  const Handle file(openFile(path), H5Fclose);
  const Array depth(file.id(), depthName(file.id(), false));
  checkDepth(depth);
  return static_cast<std::size_t>(depth.shape()[0]);
}

Frame readNyuFrame(const std::string& path, std::size_t index,
                   const ReadOptions& options)
{
  const UseHdf5 only_user;
  const Handle file(openFile(path), H5Fclose);
  const Array array(file.id(), depthName(file.id(), options.filled_depth));
  checkDepth(array);
  if (index >= array.shape()[0])
    throw std::runtime_error("has no frame " + std::to_string(index + 1));
  const ImageSize size = {static_cast<int>(array.shape()[1]),
                          static_cast<int>(array.shape()[2])};
  Frame frame;
  frame.camera = fittedTo(options.camera.value_or(cameraPreset("nyu")), size);
  DepthMap depth(size.width, size.height);
  transpose(array.read<float>(index, H5T_NATIVE_FLOAT), size.width, size.height,
            depth.pixels, [](const std::vector<float>& from, std::size_t i, float& to) {
              to = from[i] > 0.0f ? from[i] : std::numeric_limits<float>::quiet_NaN();
            });
  frame.file = cloudFromDepth(depth, *frame.camera);
  frame.colours = readColours(file.id(), index, size);
  return frame;
}

} // namespace pcl_mrf_planes::io
