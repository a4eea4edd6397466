// SPDX-License-Identifier: BSD-3-Clause
#include "label_colours.h"

#include "colour_vision.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_mrf_planes::apps {

namespace {

constexpr Rgb NO_PLANE_GRAY = {128, 128, 128};
constexpr double LEAST_CHROMA = 0.08; // in OKLab: less looks gray over a picture

/// Contrast of WCAG 2 to black of 3 and to white of 1.7.
bool isReadable(const Rgb& colour)
{
  constexpr double FLARE = 0.05;
  const double light = luminance(colour) + FLARE;
  return light >= 3.0 * FLARE && (1.0 + FLARE) >= 1.7 * light;
}

bool isColoured(const Oklab& seen)
{
  return std::hypot(seen.a, seen.b) >= LEAST_CHROMA;
}

/// How far colours are apart, over the distance in OKLab, by vision: those that most people
/// see by shall use all hues, and tritanopia is a hundred times rarer than the others.
constexpr std::array<double, VISIONS.size()> WEIGHTS = {0.55, 1.0, 1.0, 1.5};

/// A colour as everybody sees it.
struct Candidate {
  Rgb colour;
  std::array<Oklab, VISIONS.size()> seen;
  double nearest; ///< distance to what is chosen

  explicit Candidate(const Rgb& rgb)
  : colour(rgb)
  , seen()
  , nearest(std::numeric_limits<double>::max())
  {
    for (std::size_t k = 0; k < VISIONS.size(); ++k)
      seen[k] = seenAs(rgb, VISIONS[k]);
  }

  void keepApartFrom(const Candidate& other)
  {
    for (std::size_t k = 0; k < VISIONS.size(); ++k)
      nearest = std::min(nearest, WEIGHTS[k] * distance(seen[k], other.seen[k]));
  }
};

/// Readable colours on a grid of the cube.
std::vector<Candidate> candidates()
{
  constexpr int STEP = 15;
  std::vector<Candidate> all;
  for (int r = 0; r < 256; r += STEP)
    for (int g = 0; g < 256; g += STEP)
      for (int b = 0; b < 256; b += STEP) {
        const Rgb colour = {static_cast<std::uint8_t>(r), static_cast<std::uint8_t>(g),
                            static_cast<std::uint8_t>(b)};
        if (!isReadable(colour))
          continue;
        Candidate candidate(colour);
        if (isColoured(candidate.seen[0]))
          all.push_back(candidate);
      }
  return all;
}

/// Each of the colours as far as can be from gray and from all before it.
void chooseFarthest(std::vector<Rgb>& colours)
{
  std::vector<Candidate> all = candidates();
  Candidate last(NO_PLANE_GRAY);
  while (colours.size() < CHOSEN_COLOURS + 1) {
    for (Candidate& candidate : all)
      candidate.keepApartFrom(last);
    last = *std::max_element(
        all.begin(), all.end(),
        [](const Candidate& p, const Candidate& q) { return p.nearest < q.nearest; });
    colours.push_back(last.colour);
  }
}

/// Others that are readable, in an order that scatters them over the cube.
void addScattered(std::vector<Rgb>& colours)
{
  constexpr std::uint32_t CUBE = 1U << 24U;
  constexpr std::uint32_t STRIDE = 10368889; // odd, near CUBE over the golden ratio
  std::vector<bool> used(CUBE, false);
  const auto number = [](const Rgb& c) {
    return (std::uint32_t{c[0]} << 16U) | (std::uint32_t{c[1]} << 8U) | c[2];
  };
  for (const Rgb& colour : colours)
    used[number(colour)] = true;
  for (std::uint32_t k = 1, at = STRIDE; colours.size() < MOST_COLOURS && k < CUBE;
       ++k, at = (at + STRIDE) % CUBE) {
    const Rgb colour = {static_cast<std::uint8_t>(at >> 16U),
                        static_cast<std::uint8_t>(at >> 8U),
                        static_cast<std::uint8_t>(at)};
    if (!used[number(colour)] && isReadable(colour) &&
        isColoured(seenAs(colour, Vision::NORMAL)))
      colours.push_back(colour);
  }
}

std::vector<Rgb> makeColours(bool all)
{
  std::vector<Rgb> colours = {NO_PLANE_GRAY};
  chooseFarthest(colours);
  if (all)
    addScattered(colours);
  return colours;
}

} // namespace

std::array<std::uint8_t, 3> colourFromHue(double hue, double saturation,
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

std::array<std::uint8_t, 3> labelColour(std::uint32_t label)
{
  // Few pictures need more than the first ones, which are made sooner.
  static const std::vector<Rgb> first = makeColours(false);
  if (label < first.size())
    return first[label];
  static const std::vector<Rgb> all = makeColours(true);
  return all[1 + (label - 1) % (MOST_COLOURS - 1)];
}

} // namespace pcl_mrf_planes::apps
