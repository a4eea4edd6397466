// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/plane_segmentation.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace pcl_mrf_planes::reference {

/** \brief Folds bits into one number: FNV-1a, Fowler, Noll and Vo. */
class BitHash {
public:
  template <typename T>
  void add(const T& value)
  {
    unsigned char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    for (const unsigned char byte : bytes)
      hash_ = (hash_ ^ byte) * 1099511628211ULL;
  }

  std::uint64_t value() const { return hash_; }

private:
  std::uint64_t hash_ = 14695981039346656037ULL;
};

/** \brief Every bit of the labels and of what stands at the regions. */
inline std::uint64_t resultHash(const PlaneSegmentation& result)
{
  BitHash hash;
  for (const std::uint16_t label : result.labels)
    hash.add(label);
  for (const PlaneRegion& region : result.regions) {
    for (int k = 0; k < 3; ++k) {
      hash.add(region.plane.normal[k]);
      hash.add(region.centroid[k]);
      for (int j = 0; j < 3; ++j)
        hash.add(region.covariance(k, j));
    }
    hash.add(region.plane.d);
    hash.add(region.area);
    hash.add(region.rms);
    for (const auto index : region.indices)
      hash.add(index);
  }
  return hash.value();
}

} // namespace pcl_mrf_planes::reference
