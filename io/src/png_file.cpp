// SPDX-License-Identifier: BSD-3-Clause
#include "png_file.h"

#include <pcl_mrf_planes/io/image_file.h>

#include <png.h>

#include <cerrno>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>

namespace pcl_mrf_planes::io {

namespace {

constexpr std::size_t SIGNATURE_BYTES = 8;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

/// Where libpng jumps to when it gives up, and why it did.
struct Failure {
  std::jmp_buf target;
  std::string reason;
};

[[noreturn]] void fail(png_structp png, png_const_charp reason)
{
  auto* failure = static_cast<Failure*>(png_get_error_ptr(png));
  failure->reason = reason;
  std::longjmp(failure->target, 1);
}

void ignore(png_structp, png_const_charp)
{
  // Warnings are about colour profiles, texts and times.
}

/// libpng's two structures. Each step is a function without objects to destroy, since
/// libpng leaves it by a jump.
class Reader {
public:
  explicit Reader(std::FILE* file)
  : png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, &failure_, fail, ignore))
  , info_(png_ == nullptr ? nullptr : png_create_info_struct(png_))
  , file_(file)
  {
    if (info_ == nullptr) {
      png_destroy_read_struct(&png_, nullptr, nullptr);
      throw std::runtime_error("cannot be read: libpng does not start");
    }
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() { png_destroy_read_struct(&png_, &info_, nullptr); }

  bool readHeader()
  {
    if (setjmp(failure_.target) != 0)
      return false;
    png_init_io(png_, file_);
    png_set_sig_bytes(png_, static_cast<int>(SIGNATURE_BYTES));
    png_read_info(png_, info_);
    return true;
  }

  /// \param[in] rows start of each row
  /// \param[in] colour whatever there is becomes red, green, blue of 8 bits each
  bool readRows(png_bytepp rows, bool colour)
  {
    if (setjmp(failure_.target) != 0)
      return false;
    if (colour) {
      png_set_expand(png_);
      png_set_strip_16(png_);
      png_set_strip_alpha(png_);
      png_set_gray_to_rgb(png_);
    }
    else
      png_set_swap(png_); // most significant byte first in the file
    png_set_interlace_handling(png_);
    png_read_image(png_, rows);
    png_read_end(png_, nullptr);
    return true;
  }

  png_uint_32 width() const { return png_get_image_width(png_, info_); }
  png_uint_32 height() const { return png_get_image_height(png_, info_); }
  int bits() const { return png_get_bit_depth(png_, info_); }
  bool isGray() const { return png_get_color_type(png_, info_) == PNG_COLOR_TYPE_GRAY; }
  const std::string& reason() const { return failure_.reason; }

private:
  Failure failure_ = {};
  png_structp png_;
  png_infop info_;
  std::FILE* file_;
};

File open(const std::string& path)
{
  errno = 0;
  File file(std::fopen(path.c_str(), "rb"));
  if (!file)
    throw std::runtime_error(std::string("cannot be opened: ") + std::strerror(errno));
  png_byte signature[SIGNATURE_BYTES] = {};
  if (std::fread(signature, 1, SIGNATURE_BYTES, file.get()) != SIGNATURE_BYTES ||
      png_sig_cmp(signature, 0, SIGNATURE_BYTES) != 0)
    throw std::runtime_error("is not a PNG file");
  return file;
}

[[noreturn]] void throwDamaged(const Reader& reader)
{
  throw std::runtime_error("is truncated or damaged (" + reader.reason() +
                           "); write it again");
}

void checkSize(const Reader& reader)
{
  if (static_cast<std::size_t>(reader.width()) * reader.height() > MOST_PIXELS)
    throw std::runtime_error("claims " + std::to_string(reader.width()) + " x " +
                             std::to_string(reader.height()) +
                             " points, which is too many; cut it into parts");
}

void checkFormat(const Reader& reader, const std::string& what)
{
  if (!reader.isGray())
    throw std::runtime_error("is a picture in colour or with transparency; " + what +
                             " are gray, with 16 bits a point");
  if (reader.bits() != 16)
    throw std::runtime_error("has " + std::to_string(reader.bits()) +
                             " bits a point; " + what + " have 16");
}

template <typename Pixel>
Image<Pixel> readPixels(Reader& reader, bool colour)
{
  checkSize(reader);
  Image<Pixel> image(static_cast<int>(reader.width()),
                     static_cast<int>(reader.height()));
  std::vector<png_bytep> rows;
  for (std::size_t start = 0; start < image.pixels.size(); start += reader.width())
    rows.push_back(reinterpret_cast<png_bytep>(&image.pixels[start]));
  if (!reader.readRows(rows.data(), colour))
    throwDamaged(reader);
  return image;
}

} // namespace

Image16 readGrayPng(const std::string& path, const char* what)
{
  const File file = open(path);
  Reader reader(file.get());
  if (!reader.readHeader())
    throwDamaged(reader);
  checkFormat(reader, what);
  return readPixels<std::uint16_t>(reader, false);
}

ColourImage readColourPng(const std::string& path)
{
  const File file = open(path);
  Reader reader(file.get());
  if (!reader.readHeader())
    throwDamaged(reader);
  return readPixels<Colour>(reader, true);
}

} // namespace pcl_mrf_planes::io
