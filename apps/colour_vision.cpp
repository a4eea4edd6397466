// SPDX-License-Identifier: BSD-3-Clause
#include "colour_vision.h"

#include <algorithm>
#include <cmath>

namespace pcl_mrf_planes::apps {

namespace {

using Linear = std::array<double, 3>;
using Matrix = std::array<Linear, 3>;

constexpr Matrix IDENTITY = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
// Machado et al. 2009, severity 1.0.
constexpr Matrix PROTAN = {{{0.152286, 1.052583, -0.204868},
                            {0.114503, 0.786281, 0.099216},
                            {-0.003882, -0.048116, 1.051998}}};
constexpr Matrix DEUTAN = {{{0.367322, 0.860646, -0.227968},
                            {0.280085, 0.672501, 0.047413},
                            {-0.011820, 0.042940, 0.968881}}};
constexpr Matrix TRITAN = {{{1.255528, -0.076749, -0.178779},
                            {-0.078411, 0.930809, 0.147602},
                            {0.004733, 0.691367, 0.303900}}};
// Ottosson 2020.
constexpr Matrix TO_CONES = {{{0.4122214708, 0.5363325363, 0.0514459929},
                              {0.2119034982, 0.6806995451, 0.1073969566},
                              {0.0883024619, 0.2817188376, 0.6299787005}}};
constexpr Matrix TO_LAB = {{{0.2104542553, 0.7936177850, -0.0040720468},
                            {1.9779984951, -2.4285922050, 0.4505937099},
                            {0.0259040371, 0.7827717662, -0.8086757660}}};

Linear operator*(const Matrix& m, const Linear& v)
{
  Linear out{};
  for (std::size_t r = 0; r < 3; ++r)
    out[r] = m[r][0] * v[0] + m[r][1] * v[1] + m[r][2] * v[2];
  return out;
}

/// IEC 61966-2-1.
double decode(std::uint8_t channel)
{
  const double s = channel / 255.0;
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

Linear decode(const Rgb& colour)
{
  static const std::array<double, 256> table = [] {
    std::array<double, 256> values{};
    for (std::size_t k = 0; k < values.size(); ++k)
      values[k] = decode(static_cast<std::uint8_t>(k));
    return values;
  }();
  return {table[colour[0]], table[colour[1]], table[colour[2]]};
}

const Matrix& matrixOf(Vision vision)
{
  switch (vision) {
  case Vision::PROTANOPIA:
    return PROTAN;
  case Vision::DEUTERANOPIA:
    return DEUTAN;
  case Vision::TRITANOPIA:
    return TRITAN;
  default:
    return IDENTITY;
  }
}

} // namespace

Oklab seenAs(const Rgb& colour, Vision vision)
{
  Linear seen = matrixOf(vision) * decode(colour);
  for (double& channel : seen) // what a screen can show
    channel = std::max(0.0, std::min(1.0, channel));
  Linear cones = TO_CONES * seen;
  for (double& cone : cones)
    cone = std::cbrt(cone);
  const Linear lab = TO_LAB * cones;
  return {lab[0], lab[1], lab[2]};
}

double distance(const Oklab& p, const Oklab& q)
{
  return std::sqrt((p.l - q.l) * (p.l - q.l) + (p.a - q.a) * (p.a - q.a) +
                   (p.b - q.b) * (p.b - q.b));
}

double luminance(const Rgb& colour)
{
  const Linear linear = decode(colour);
  return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
}

} // namespace pcl_mrf_planes::apps
