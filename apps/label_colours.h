// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace pcl_mrf_planes::apps {

/** \brief Colour of a hue (degrees, any value), saturation and lightness (0 to 1). */
inline std::array<std::uint8_t, 3> colourFromHue(double hue, double saturation,
                                                 double lightness)
{
  const double reach = saturation * std::min(lightness, 1.0 - lightness);
  const auto channel = [&](double shift) {
    double k = std::fmod(shift + hue / 30.0, 12.0);
    if (k < 0.0)
      k += 12.0;
    const double ramp = std::max(-1.0, std::min({k - 3.0, 9.0 - k, 1.0}));
    return static_cast<std::uint8_t>(std::lround(255.0 * (lightness - reach * ramp)));
  };
  return {channel(0.0), channel(8.0), channel(4.0)};
}

/** \brief Colour of a label, the same in every picture and for any label.
 *
 * Hues go round by the golden angle, so that labels that follow each other differ most;
 * lightness takes three values in turn, which tells near hues apart. Label 0, no plane,
 * is gray.
 */
inline std::array<std::uint8_t, 3> labelColour(std::uint32_t label)
{
  if (label == 0)
    return {128, 128, 128};
  constexpr double GOLDEN_ANGLE = 137.50776405003785; // degrees
  constexpr double LIGHTNESS[] = {0.55, 0.42, 0.70};
  const std::uint32_t k = label - 1;
  return colourFromHue(std::fmod(k * GOLDEN_ANGLE, 360.0), 0.85, LIGHTNESS[k % 3]);
}

} // namespace pcl_mrf_planes::apps
