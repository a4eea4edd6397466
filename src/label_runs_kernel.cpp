// SPDX-License-Identifier: BSD-3-Clause
//
// Borders between the runs of a row of labels. Compiled once for every instruction set that
// the compiler knows; the best one is chosen at run time.
#include "label_runs_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "label_runs_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pcl_mrf_planes {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

std::size_t FindChanges(const std::uint16_t* labels, std::size_t count,
                        std::uint32_t* places)
{
  // No more lanes than a word has bits.
  const hn::CappedTag<std::uint16_t, 64> d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t found = 0;
  std::size_t k = 1;
  for (; k + lanes <= count; k += lanes) {
    const auto changes = hn::Ne(hn::LoadU(d, labels + k), hn::LoadU(d, labels + k - 1));
    if (hn::AllFalse(d, changes))
      continue;
    std::uint64_t bits = 0; // little-endian, as the library asks for
    hn::StoreMaskBits(d, changes, reinterpret_cast<std::uint8_t*>(&bits));
    for (; bits != 0; bits &= bits - 1)
      places[found++] = static_cast<std::uint32_t>(
          k + static_cast<std::size_t>(hwy::Num0BitsBelowLS1Bit_Nonzero64(bits)));
  }
  for (; k < count; ++k)
    if (labels[k] != labels[k - 1])
      places[found++] = static_cast<std::uint32_t>(k);
  return found;
}

} // namespace HWY_NAMESPACE
} // namespace pcl_mrf_planes
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_mrf_planes {

HWY_EXPORT(FindChanges);

std::size_t findChanges(const std::uint16_t* labels, std::size_t count,
                        std::uint32_t* places)
{
  static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__,
                "the bit of the first lane is the lowest of the word");
  return HWY_DYNAMIC_DISPATCH(FindChanges)(labels, count, places);
}

} // namespace pcl_mrf_planes
#endif
