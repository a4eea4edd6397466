// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_mrf_planes::apps {

/** \brief Colour of a hue (degrees, any value), saturation and lightness (0 to 1). */
std::array<std::uint8_t, 3> colourFromHue(double hue, double saturation,
                                          double lightness);

/** \brief So many labels, from 1, have colours chosen to be as far apart as can be. */
constexpr std::uint32_t CHOSEN_COLOURS = 128;

/** \brief So many colours there are: more labels than a 16-bit image can hold. */
constexpr std::uint32_t MOST_COLOURS = 65536;

/** \brief Colour of a label, the same in every picture; all labels below MOST_COLOURS have
 * different ones, those above begin anew.
 *
 * Label 0, no plane, is gray, and no other label is. The first CHOSEN_COLOURS are chosen
 * one after the other, each as far as can be from gray and from all before it in OKLab, at
 * the least of normal vision, protanopia, deuteranopia and, with less weight, tritanopia
 * (colour_vision.h); so the first ones differ most. All stand out from black (contrast of 3 or more by WCAG
 * 2) and from white (1.7 or more).
 *
 * The list is made once, in some hundredths of a second; safe from any thread.
 */
std::array<std::uint8_t, 3> labelColour(std::uint32_t label);

} // namespace pcl_mrf_planes::apps
