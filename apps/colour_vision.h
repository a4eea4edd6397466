// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

namespace pcl_mrf_planes::apps {

using Rgb = std::array<std::uint8_t, 3>; ///< sRGB, 8 bits a channel

/** \brief How colours are seen. */
enum class Vision {
  NORMAL,
  PROTANOPIA,   ///< without the cones for long waves
  DEUTERANOPIA, ///< without those for middle waves
  TRITANOPIA    ///< without those for short waves
};

/** \brief All of them. */
constexpr std::array<Vision, 4> VISIONS = {Vision::NORMAL, Vision::PROTANOPIA,
                                           Vision::DEUTERANOPIA, Vision::TRITANOPIA};

/** \brief A place in OKLab: lightness from 0 to 1, green to red, blue to yellow.
 *
 * Source: B. Ottosson, "A perceptual color space for image processing", 2020. */
struct Oklab {
  double l, a, b;
};

/** \brief Where a colour lies in OKLab for who sees it so.
 *
 * Dichromats by G. M. Machado, M. M. Oliveira and L. A. F. Fernandes, "A
 * Physiologically-based Model for Simulation of Color Vision Deficiency", IEEE TVCG 15(6),
 * 2009, severity 1, on linear sRGB. */
Oklab seenAs(const Rgb& colour, Vision vision);

/** \brief Euclidean distance in OKLab; about 0.02 is just noticeable side by side. */
double distance(const Oklab& p, const Oklab& q);

/** \brief Relative luminance, 0 (black) to 1 (white), as WCAG 2 defines it. */
double luminance(const Rgb& colour);

} // namespace pcl_mrf_planes::apps
