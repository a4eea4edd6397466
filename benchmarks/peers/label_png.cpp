// SPDX-License-Identifier: BSD-3-Clause
#include "label_png.h"

#include <png.h>

#include <csetjmp>
#include <cstdio>
#include <memory>
#include <stdexcept>

namespace pcl_mrf_planes::benchmarks {

using evaluation::LabelImage;

namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

File open(const std::string& path, const char* mode)
{
  File file(std::fopen(path.c_str(), mode), &std::fclose);
  if (!file)
    throw std::runtime_error("cannot open '" + path + "'");
  return file;
}

/// A reader that is freed whatever happens.
struct Reader {
  png_structp png =
      png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);

  Reader() = default;
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
};

struct Writer {
  png_structp png =
      png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);

  Writer() = default;
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  ~Writer() { png_destroy_write_struct(&png, &info); }
};

// libpng leaves by longjmp: the functions that it may leave own nothing themselves.

bool readHeader(Reader& reader, std::FILE* file)
{
  if (setjmp(png_jmpbuf(reader.png)) != 0)
    return false;
  png_init_io(reader.png, file);
  png_read_info(reader.png, reader.info);
  if (png_get_bit_depth(reader.png, reader.info) == 16)
    png_set_swap(reader.png);
  return true;
}

bool readRows(Reader& reader, png_bytepp rows)
{
  if (setjmp(png_jmpbuf(reader.png)) != 0)
    return false;
  png_read_image(reader.png, rows);
  return true;
}

bool writeRows(Writer& writer, std::FILE* file, const LabelImage& image,
               png_bytepp rows)
{
  if (setjmp(png_jmpbuf(writer.png)) != 0)
    return false;
  png_init_io(writer.png, file);
  png_set_compression_level(writer.png, 3);
  png_set_IHDR(writer.png, writer.info, static_cast<png_uint_32>(image.width),
               static_cast<png_uint_32>(image.height), 16, PNG_COLOR_TYPE_GRAY,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_write_info(writer.png, writer.info);
  png_set_swap(writer.png);
  png_write_image(writer.png, rows);
  png_write_end(writer.png, writer.info);
  return true;
}

template <typename Value>
std::vector<png_bytep> rowsOf(std::vector<Value>& values, std::size_t width)
{
  std::vector<png_bytep> rows;
  for (std::size_t i = 0; i < values.size(); i += width)
    rows.push_back(reinterpret_cast<png_bytep>(values.data() + i));
  return rows;
}

} // namespace

LabelImage readLabelPng(const std::string& path)
{
  const File file = open(path, "rb");
  Reader reader;
  if (!readHeader(reader, file.get()) ||
      png_get_color_type(reader.png, reader.info) != PNG_COLOR_TYPE_GRAY ||
      png_get_bit_depth(reader.png, reader.info) < 8)
    throw std::runtime_error("'" + path + "' is no gray PNG of 8 or 16 bits");
  LabelImage image;
  const std::size_t width = png_get_image_width(reader.png, reader.info);
  const std::size_t height = png_get_image_height(reader.png, reader.info);
  image.width = static_cast<int>(width);
  image.height = static_cast<int>(height);
  image.labels.resize(width * height);
  bool read = false;
  if (png_get_bit_depth(reader.png, reader.info) == 16) {
    read = readRows(reader, rowsOf(image.labels, width).data());
  }
  else {
    std::vector<std::uint8_t> bytes(width * height);
    read = readRows(reader, rowsOf(bytes, width).data());
    image.labels.assign(bytes.begin(), bytes.end());
  }
  if (!read)
    throw std::runtime_error("'" + path + "' is broken");
  return image;
}

void writeLabelPng(const std::string& path, const LabelImage& image)
{
  const File file = open(path, "wb");
  Writer writer;
  std::vector<std::uint16_t> labels = image.labels; // libpng wants them writable
  const auto width = static_cast<std::size_t>(image.width);
  if (!writeRows(writer, file.get(), image, rowsOf(labels, width).data()) ||
      std::fflush(file.get()) != 0)
    throw std::runtime_error("cannot write '" + path + "'");
}

} // namespace pcl_mrf_planes::benchmarks
