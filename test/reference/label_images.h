// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scenes/random.h"

#include <evaluation/label_image.h>

#include <cstdint>
#include <string>
#include <vector>

/** Small label images for tests. */
namespace pcl_mrf_planes::reference {

using evaluation::LabelImage;

/** \brief A label image from rows of characters: a digit is a label, x is not scored. */
inline LabelImage drawn(const std::vector<std::string>& rows)
{
  LabelImage image;
  image.width = rows.empty() ? 0 : static_cast<int>(rows[0].size());
  image.height = static_cast<int>(rows.size());
  for (const std::string& row : rows)
    for (const char c : row)
      image.labels.push_back(c == 'x' ? evaluation::NOT_SCORED
                                      : static_cast<std::uint16_t>(c - '0'));
  return image;
}

/** \brief A truth and a result of it with the usual faults. */
struct LabelPair {
  LabelImage truth, labels;
};

/** \brief Blocks of random labels from 0 to \a most. */
inline LabelImage randomBlocks(scenes::Random& random, int width, int height, int most)
{
  const int side = random.integer(1, 9);
  const int across = width / side + 1;
  std::vector<std::uint16_t> blocks;
  for (int k = 0; k < across * (height / side + 1); ++k)
    blocks.push_back(static_cast<std::uint16_t>(random.integer(0, most)));
  LabelImage image = {width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      image.labels.push_back(
          blocks[static_cast<std::size_t>(y / side * across + x / side)]);
  return image;
}

/** \brief Random blocks; the result has some regions split, merged or lost, and noise;
 * some of the truth is not scored. */
inline LabelPair randomPair(std::uint64_t seed, int largest_side = 24)
{
  scenes::Random random(seed);
  const int width = random.integer(1, largest_side);
  const int height = random.integer(1, largest_side);
  const int most = random.integer(0, 7);
  LabelPair pair;
  pair.truth = randomBlocks(random, width, height, most);
  pair.labels =
      random.chance(0.7) ? pair.truth : randomBlocks(random, width, height, most);
  for (int fault = random.integer(0, 3); fault > 0; --fault) {
    const int from = random.integer(0, most + 1);
    const auto to = static_cast<std::uint16_t>(random.integer(0, most + 3));
    const double share = random.chance(0.5) ? 1.0 : random.uniform();
    for (std::uint16_t& label : pair.labels.labels)
      if (label == from && random.chance(share))
        label = to;
  }
  const double noise = random.chance(0.5) ? 0.0 : random.uniform(0.0, 0.2);
  const double hidden = random.chance(0.5) ? 0.0 : random.uniform(0.0, 0.8);
  for (std::size_t i = 0; i < pair.truth.size(); ++i) {
    if (random.chance(noise))
      pair.labels.labels[i] = static_cast<std::uint16_t>(random.integer(0, most + 2));
    if (random.chance(hidden) && pair.truth.labels[i] % 2 == 0)
      pair.truth.labels[i] = evaluation::NOT_SCORED;
  }
  return pair;
}

} // namespace pcl_mrf_planes::reference
