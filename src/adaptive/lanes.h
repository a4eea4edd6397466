// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adaptive/candidate_field.h"

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace pcl_mrf_planes::adaptive {

/// Numbers of four neighbours of a row, added and compared by single instructions wherever the
/// compiler knows some (an extension of g++ and clang++).
using Floats __attribute__((vector_size(16))) = float;
using Words __attribute__((vector_size(16))) = std::int32_t;
constexpr int LANES = 4;

inline Floats loadFour(const float* from)
{
  Floats four;
  std::memcpy(&four, from, sizeof(four));
  return four;
}

/// The nearest whole numbers to some that are not negative.
inline Words nearest(Floats numbers)
{
  return __builtin_convertvector(numbers + 0.5f, Words);
}

/// The eight numbers of a row of a block, which 16 bits hold. They do not pass through memory,
/// where what is written in parts cannot be read as a whole before it has settled.
inline BlockRow::Numbers join(Words first, Words last)
{
  return __builtin_shufflevector(reinterpret_cast<BlockRow::Numbers>(first),
                                 reinterpret_cast<BlockRow::Numbers>(last), 0, 2, 4, 6,
                                 8, 10, 12, 14);
}

/// All bits set, or none, for eight bytes 1 or 0.
inline BlockRow::Numbers maskOf(std::uint64_t bytes)
{
  using Bytes __attribute__((vector_size(16))) = std::uint8_t;
  using Two __attribute__((vector_size(16))) = std::uint64_t;
  const auto v = reinterpret_cast<Bytes>(Two{bytes, 0});
  return -reinterpret_cast<BlockRow::Numbers>(__builtin_shufflevector(
      v, Bytes{}, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23));
}

inline std::uint64_t loadBytes(const std::uint8_t* from)
{
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, from, sizeof(bytes));
  return bytes;
}

} // namespace pcl_mrf_planes::adaptive
