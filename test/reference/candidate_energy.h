// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adaptive/candidate_field.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

/** The energy of a CandidateField, point by point. */
namespace pcl_mrf_planes::adaptive::reference {

constexpr int SIDE = CandidateBlocks::SIDE;
constexpr long FORBIDDEN = std::numeric_limits<long>::max() / 4;

inline std::size_t blockOf(const CandidateField& field, int x, int y)
{
  return field.blocks.at(x / SIDE, y / SIDE);
}

/// Number of the active block of a point, or CandidateField::SETTLED.
inline std::size_t activeOf(const CandidateField& field, int x, int y)
{
  return field.number[blockOf(field, x, y)];
}

/// Cost of a label at a point; FORBIDDEN where it does not compete.
inline long dataCost(const CandidateField& field, int x, int y, int label)
{
  const std::size_t block = blockOf(field, x, y);
  const std::size_t a = activeOf(field, x, y);
  const auto row = static_cast<std::size_t>(y % SIDE);
  for (std::size_t s = 0; s < field.blocks.count[block]; ++s)
    if (field.blocks.labelsOf(block)[s] == label)
      return a == CandidateField::SETTLED ? 0
                                          : field.data[field.dataRow(a, row) + s]
                                                .v[static_cast<std::size_t>(x % SIDE)];
  return FORBIDDEN;
}

/// Price of a change between a point and the one on its right; 0 between settled blocks.
inline long rightEdge(const CandidateField& field, int x, int y)
{
  const auto row = static_cast<std::size_t>(y % SIDE);
  if (const std::size_t a = activeOf(field, x, y); a != CandidateField::SETTLED)
    return field.weight[a].right[row].v[static_cast<std::size_t>(x % SIDE)];
  const std::size_t b = activeOf(field, x + 1, y);
  return b == CandidateField::SETTLED ? 0 : field.weight[b].left.v[row];
}

/// The same with the one below.
inline long downEdge(const CandidateField& field, int x, int y)
{
  const auto column = static_cast<std::size_t>(x % SIDE);
  if (const std::size_t a = activeOf(field, x, y); a != CandidateField::SETTLED)
    return field.weight[a].down[static_cast<std::size_t>(y % SIDE)].v[column];
  const std::size_t b = activeOf(field, x, y + 1);
  return b == CandidateField::SETTLED ? 0 : field.weight[b].above.v[column];
}

/// Data costs and prices of label changes; FORBIDDEN and more if a label is none of its
/// block's.
inline long energyOf(const CandidateField& field, const OrganizedPoints& points,
                     const std::vector<std::uint16_t>& labels)
{
  const auto at = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(field.width) +
           static_cast<std::size_t>(x);
  };
  long sum = 0;
  for (int y = 0; y < field.height; ++y)
    for (int x = 0; x < field.width; ++x) {
      if (points.valid[at(x, y)] == 0)
        continue;
      sum += dataCost(field, x, y, labels[at(x, y)]);
      if (x + 1 < field.width && labels[at(x, y)] != labels[at(x + 1, y)])
        sum += rightEdge(field, x, y);
      if (y + 1 < field.height && labels[at(x, y)] != labels[at(x, y + 1)])
        sum += downEdge(field, x, y);
    }
  return sum;
}

} // namespace pcl_mrf_planes::adaptive::reference
