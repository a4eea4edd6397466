// SPDX-License-Identifier: BSD-3-Clause
#include "file_text.h"
#include "netpbm_file.h"
#include "png_file.h"

#include <pcl_mrf_planes/io/image_file.h>

#include <vtkImageData.h>
#include <vtkJPEGReader.h>
#include <vtkNew.h>

#include <stdexcept>

namespace pcl_mrf_planes::io {

namespace {

constexpr const char* JPEG_START = "\xff\xd8\xff";

/// By VTK, which PCL brings along; its rows start at the bottom.
ColourImage readJpeg(const std::string& path)
{
  vtkNew<vtkJPEGReader> reader;
  if (reader->CanReadFile(path.c_str()) == 0)
    throw std::runtime_error("is truncated or damaged");
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkImageData* data = reader->GetOutput();
  const int width = data->GetDimensions()[0];
  const int height = data->GetDimensions()[1];
  const int channels = data->GetNumberOfScalarComponents();
  if (reader->GetErrorCode() != 0 || width < 1 || height < 1 ||
      (channels != 1 && channels != 3))
    throw std::runtime_error("is truncated or damaged, or not gray or RGB");
  ColourImage image(width, height);
  const auto* values = static_cast<const std::uint8_t*>(data->GetScalarPointer());
  const auto w = static_cast<std::size_t>(width);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const std::size_t row = static_cast<std::size_t>(height) - 1 - i / w;
    for (std::size_t c = 0; c < 3; ++c)
      image.pixels[i][c] =
          values[static_cast<std::size_t>(channels) * (row * w + i % w) +
                 (channels == 1 ? 0 : c)];
  }
  return image;
}

} // namespace

ColourImage readColourImage(const std::string& path)
{
  const std::string start = readStart(path, 3);
  if (start == JPEG_START)
    return readJpeg(path);
  if (start.compare(0, 2, "P6") == 0)
    return readPpm(path);
  return readColourPng(path);
}

} // namespace pcl_mrf_planes::io
