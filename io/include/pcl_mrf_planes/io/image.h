// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/export.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_mrf_planes::io {

/** \brief Red, green and blue, 0 to 255 each. */
using Colour = std::array<std::uint8_t, 3>;

/** \brief A picture, row by row from the top. */
template <typename Pixel>
struct PCL_MRF_PLANES_EXPORT Image {
  int width = 0;             ///< columns
  int height = 0;            ///< rows
  std::vector<Pixel> pixels; ///< width * height

  Image() = default;
  /// All pixels alike. \param[in] w, h columns and rows, >= 0
  /// \param[in] value of every pixel
  Image(int w, int h, Pixel value = Pixel{})
  : width(w)
  , height(h)
  , pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), value)
  {}
};

using Image16 = Image<std::uint16_t>; ///< values of a sensor, or labels
using DepthMap = Image<float>;        ///< metres; NaN: not measured
using ColourImage = Image<Colour>;    ///< red, green, blue

/** \brief Most points of an image: a file can claim any size in few bytes. */
constexpr std::size_t MOST_PIXELS = std::size_t{1} << 27;

} // namespace pcl_mrf_planes::io
