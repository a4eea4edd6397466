// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/field_rows.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_mrf_planes {

/// The other labels of each label, the cheapest change first: a message looks no further than
/// its predecessor can reach. O(L^2 log L) to build, for EdgeModel::SOFT_THRESHOLD only.
class PriceOrder {
public:
  struct Change {
    std::uint16_t price;
    std::uint16_t label;
  };

  explicit PriceOrder(const PairPrices& prices)
  : others_(static_cast<std::size_t>(std::max(0, prices.labels() - 1)))
  , least_(prices.leastPairwise())
  {
    if (prices.edgeModel() != EdgeModel::SOFT_THRESHOLD)
      return;
    for (int a = 0; a < prices.labels(); ++a) {
      for (int b = 0; b < prices.labels(); ++b)
        if (b != a)
          changes_.push_back({prices.pairwise(a, b), static_cast<std::uint16_t>(b)});
      std::sort(changes_.end() - static_cast<std::ptrdiff_t>(others_), changes_.end(),
                [](const Change& p, const Change& q) {
                  return p.price != q.price ? p.price < q.price : p.label < q.label;
                });
    }
  }

  /// Changes from label a, L - 1 of them.
  const Change* from(int a) const
  {
    return changes_.data() + static_cast<std::size_t>(a) * others_;
  }

  std::size_t others() const { return others_; }

  /// Least price of all pairs.
  std::uint16_t least() const { return least_; }

private:
  std::vector<Change> changes_;
  std::size_t others_;
  std::uint16_t least_;
};

} // namespace pcl_mrf_planes
