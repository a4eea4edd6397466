// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "frame_memory.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace pcl_mrf_planes::adaptive {

/// A queue of numbers by cost, the least first, those of costs within three per cent of one
/// another as one: the last of them first. Costs at or below the least power of two are
/// one, too. All operations are O(1) but for steps over empty buckets.
class CostQueue {
public:
  explicit CostQueue(float most)
  : newest_(bucketOf(most) + 1, NOTHING)
  , first_(newest_.size())
  {}

  bool empty()
  {
    while (first_ < newest_.size() && newest_[first_] == NOTHING)
      ++first_;
    return first_ == newest_.size();
  }

  void push(float cost, std::uint32_t number)
  {
    const std::size_t bucket = bucketOf(cost);
    if (number >= older_.size())
      older_.resize(number + 1);
    older_[number] = newest_[bucket];
    newest_[bucket] = number;
    first_ = std::min(first_, bucket);
  }

  /// Of a queue that is not empty, as empty() has just told.
  std::uint32_t pop()
  {
    const std::uint32_t number = newest_[first_];
    newest_[first_] = older_[number];
    return number;
  }

private:
  static constexpr std::uint32_t NOTHING = UINT32_MAX;

  /// Exponent and upper bits of the mantissa: their order is that of the numbers.
  static std::size_t bucketOf(float cost)
  {
    constexpr float LEAST = 1.0F / (1U << 20U);
    constexpr std::uint32_t LEFT_OUT = 18; // of the 23 bits of the mantissa
    const auto bits = [](float number) {
      std::uint32_t word = 0;
      std::memcpy(&word, &number, sizeof(word));
      return word >> LEFT_OUT;
    };
    return bits(std::max(cost, LEAST)) - bits(LEAST);
  }

  FrameVector<std::uint32_t> newest_; ///< of each bucket
  FrameVector<std::uint32_t> older_;  ///< the next of the same bucket, by number
  std::size_t first_;                 ///< no bucket before it holds any
};

} // namespace pcl_mrf_planes::adaptive
