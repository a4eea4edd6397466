// SPDX-License-Identifier: BSD-3-Clause
//
// The inner loops of belief propagation on 16-bit integers. Compiled once for every
// instruction set that the compiler knows; the best one is chosen at run time.
#include "belief_propagation_kernel.h"

#include <memory>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "belief_propagation_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pcl_mrf_planes {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// At most PADDING lanes: rows are padded for that.
using Tag = hn::CappedTag<std::uint16_t, CheckerboardLayout::PADDING>;
using Vec = hn::Vec<Tag>;

/// Data cost plus the four messages of label l.
HWY_INLINE Vec belief(const SiteRow& row, std::ptrdiff_t offset)
{
  const Tag d;
  Vec sum = hn::LoadU(d, row.data + offset);
  for (const std::uint16_t* received : row.received)
    sum = hn::Add(sum, hn::LoadU(d, received + offset));
  return sum;
}

/// Stores a message and remembers how far it moved.
HWY_INLINE void store(Vec message, std::uint16_t* target, Vec& change)
{
  const Tag d;
  const Vec old = hn::LoadU(d, target);
  change = hn::Max(change, hn::Sub(hn::Max(message, old), hn::Min(message, old)));
  hn::StoreU(message, d, target);
}

/// Messages max(0, pairwise - weight): exact, with predecessors that cannot win
/// skipped.
///
/// m(b) = min over a of h(a) + price(a, b), and price(b, b) = 0. A label a != b can
/// beat h(b) only if h(a) + least price < h(b), hence only if h(a) + least price < max
/// h. As min h = 0, the least value of the message is 0 as well: it comes out
/// normalised.
HWY_INLINE void sendSoftThreshold(const SiteRow& row, const std::uint16_t* h, Vec most,
                                  Vec weight, std::vector<int>& active,
                                  std::uint16_t* target, Vec& change)
{
  const Tag d;
  const std::size_t lanes = hn::Lanes(d);
  const Vec least = hn::SaturatedSub(hn::Set(d, row.least_pairwise), weight);
  int count = 0;
  for (int a = 0; a < row.labels; ++a) {
    const Vec reach =
        hn::Add(hn::Load(d, h + static_cast<std::size_t>(a) * lanes), least);
    if (!hn::AllTrue(d, hn::Eq(hn::Max(reach, most), reach))) // some lane: reach < most
      active[static_cast<std::size_t>(count++)] = a;
  }
  for (int b = 0; b < row.labels; ++b) {
    const std::uint16_t* prices =
        row.pairwise + static_cast<std::ptrdiff_t>(b) * row.labels;
    Vec message = hn::Load(d, h + static_cast<std::size_t>(b) * lanes);
    for (int i = 0; i < count; ++i) {
      const int a = active[static_cast<std::size_t>(i)];
      const Vec price = hn::SaturatedSub(hn::Set(d, prices[a]), weight);
      message =
          hn::Min(message,
                  hn::Add(hn::Load(d, h + static_cast<std::size_t>(a) * lanes), price));
    }
    store(message, target + static_cast<std::ptrdiff_t>(b) * row.label_stride, change);
  }
}

/// Messages max(pairwise, scale * weight): the diagonal is not free, so every
/// predecessor counts and the least value has to be subtracted afterwards.
HWY_INLINE void sendScaledMaximum(const SiteRow& row, std::uint16_t* h, Vec weight,
                                  std::uint16_t* message, std::uint16_t* target,
                                  Vec& change)
{
  const Tag d;
  const std::size_t lanes = hn::Lanes(d);
  Vec least = hn::Set(d, PairPrices::NO_EDGE);
  for (int b = 0; b < row.labels; ++b) {
    const std::ptrdiff_t pairs = static_cast<std::ptrdiff_t>(b) * row.labels;
    Vec best = hn::Set(d, PairPrices::NO_EDGE);
    for (int a = 0; a < row.labels; ++a) {
      const Vec scaled = hn::MulHigh(hn::Set(d, row.scale[pairs + a]), weight);
      const Vec price = hn::Max(hn::Set(d, row.pairwise[pairs + a]), scaled);
      best = hn::Min(
          best, hn::Add(hn::Load(d, h + static_cast<std::size_t>(a) * lanes), price));
    }
    hn::Store(best, d, message + static_cast<std::size_t>(b) * lanes);
    least = hn::Min(least, best);
  }
  const auto none = hn::Eq(weight, hn::Set(d, PairPrices::NO_EDGE));
  for (int b = 0; b < row.labels; ++b) {
    const Vec best = hn::Load(d, message + static_cast<std::size_t>(b) * lanes);
    store(hn::IfThenZeroElse(none, hn::Sub(best, least)),
          target + static_cast<std::ptrdiff_t>(b) * row.label_stride, change);
  }
}

std::uint16_t SendMessages(const SiteRow& row, const SendRow& send,
                           KernelScratch& scratch)
{
  const Tag d;
  const std::size_t lanes = hn::Lanes(d);
  std::uint16_t* const sum = scratch.belief;
  std::uint16_t* const h = scratch.h;

  Vec change = hn::Zero(d);
  for (std::ptrdiff_t k = 0; k < row.sites; k += static_cast<std::ptrdiff_t>(lanes)) {
    for (int l = 0; l < row.labels; ++l)
      hn::Store(belief(row, l * static_cast<std::ptrdiff_t>(row.label_stride) + k), d,
                sum + static_cast<std::size_t>(l) * lanes);

    for (int direction = 0; direction < DIRECTIONS; ++direction) {
      if (send.target[direction] == nullptr)
        continue;
      // h: everything that the site knows but what the receiver told it.
      Vec least = hn::Set(d, PairPrices::NO_EDGE);
      for (int l = 0; l < row.labels; ++l) {
        const Vec told =
            hn::LoadU(d, row.received[direction] +
                             l * static_cast<std::ptrdiff_t>(row.label_stride) + k);
        const Vec rest =
            hn::Sub(hn::Load(d, sum + static_cast<std::size_t>(l) * lanes), told);
        hn::Store(rest, d, h + static_cast<std::size_t>(l) * lanes);
        least = hn::Min(least, rest);
      }
      Vec most = hn::Zero(d);
      for (int l = 0; l < row.labels; ++l) {
        const Vec rest =
            hn::Sub(hn::Load(d, h + static_cast<std::size_t>(l) * lanes), least);
        hn::Store(rest, d, h + static_cast<std::size_t>(l) * lanes);
        most = hn::Max(most, rest);
      }
      const Vec weight = hn::LoadU(d, send.weight[direction] + k);
      if (row.model == EdgeModel::SOFT_THRESHOLD)
        sendSoftThreshold(row, h, most, weight, scratch.active,
                          send.target[direction] + k, change);
      else
        sendScaledMaximum(row, h, weight, scratch.message, send.target[direction] + k,
                          change);
    }
  }
  return hn::GetLane(hn::MaxOfLanes(d, change));
}

void MapRow(const SiteRow& row, std::uint16_t* labels)
{
  const Tag d;
  for (std::ptrdiff_t k = 0; k < row.sites;
       k += static_cast<std::ptrdiff_t>(hn::Lanes(d))) {
    Vec least = belief(row, k);
    Vec best = hn::Zero(d);
    for (int l = 1; l < row.labels; ++l) {
      const Vec cost =
          belief(row, l * static_cast<std::ptrdiff_t>(row.label_stride) + k);
      const auto better = hn::Lt(cost, least);
      best = hn::IfThenElse(better, hn::Set(d, static_cast<std::uint16_t>(l)), best);
      least = hn::Min(least, cost);
    }
    hn::StoreU(best, d, labels + k);
  }
}

} // namespace HWY_NAMESPACE
} // namespace pcl_mrf_planes
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_mrf_planes {

HWY_EXPORT(SendMessages);
HWY_EXPORT(MapRow);

namespace {

constexpr std::size_t VECTOR = CheckerboardLayout::PADDING; // elements, at most
constexpr std::size_t ALIGNMENT = 64;                       // bytes, of any vector

} // namespace

KernelScratch::KernelScratch(int labels, int layout_stride)
: active(static_cast<std::size_t>(labels))
, row(static_cast<std::size_t>(layout_stride))
, buffer_(3 * static_cast<std::size_t>(labels) * VECTOR + ALIGNMENT)
{
  void* start = buffer_.data();
  std::size_t space = buffer_.size() * sizeof(std::uint16_t);
  belief = static_cast<std::uint16_t*>(std::align(ALIGNMENT, 1, start, space));
  h = belief + static_cast<std::size_t>(labels) * VECTOR;
  message = h + static_cast<std::size_t>(labels) * VECTOR;
}

SiteRow makeSiteRow(const CheckerboardLayout& layout, const PairPrices& prices,
                    std::uint16_t least_pairwise, int colour, int y)
{
  SiteRow row;
  row.sites = layout.sitesInRow(y, colour);
  row.labels = prices.labels();
  row.label_stride = layout.stride;
  row.model = prices.edgeModel();
  row.pairwise = prices.pairwiseMatrix();
  row.scale = prices.scaleMatrix();
  row.least_pairwise = least_pairwise;
  return row;
}

void alignToSenders(SendRow& send, int colour, int y)
{
  // The neighbour to the left of site k is number k - 1 of the other colour where this
  // row starts at x = 0, and number k where it starts at x = 1.
  const int left = CheckerboardLayout::firstColumn(y, colour) - 1;
  send.target[LEFT] += left;
  send.weight[LEFT] += left;
  send.target[RIGHT] += left + 1;
}

std::uint16_t sendRow(const SiteRow& row, const SendRow& send, KernelScratch& scratch)
{
  return HWY_DYNAMIC_DISPATCH(SendMessages)(row, send, scratch);
}

void mapSites(const SiteRow& row, int width, int colour, int y, KernelScratch& scratch,
              std::vector<std::uint16_t>& labels)
{
  HWY_DYNAMIC_DISPATCH(MapRow)(row, scratch.row.data());
  std::uint16_t* out = labels.data() +
                       static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                       CheckerboardLayout::firstColumn(y, colour);
  for (int k = 0; k < row.sites; ++k)
    out[2 * k] = scratch.row[static_cast<std::size_t>(k)];
}

} // namespace pcl_mrf_planes
#endif
