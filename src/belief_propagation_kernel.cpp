// SPDX-License-Identifier: BSD-3-Clause
//
// The inner loops of belief propagation on 16-bit integers. Compiled once for every
// instruction set that the compiler knows; the best one is chosen at run time.
#include "belief_propagation_kernel.h"

#include <memory>

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

/// Stores messages, and remembers how far they moved where that is asked for.
template <bool MEASURE>
struct MessageStore {
  Vec change; ///< the largest so far

  HWY_INLINE void operator()(Vec message, std::uint16_t* target)
  {
    const Tag d;
    if (MEASURE) {
      const Vec old = hn::LoadU(d, target);
      change = hn::Max(change, hn::Sub(hn::Max(message, old), hn::Min(message, old)));
    }
    hn::StoreU(message, d, target);
  }
};

/// Messages max(0, pairwise - weight): exact, with predecessors that cannot win
/// skipped.
///
/// m(b) = min over a of h(a) + price(a, b), and price(b, b) = 0. A label a != b can
/// beat h(b) only if h(a) + price(a, b) < h(b), hence only if h(a) + price(a, b) < max h:
/// of the labels in the order of their prices from a, those up to max h - h(a). As
/// min h = 0, the least value of the message is 0 as well: it comes out normalised. Where
/// there is no edge the message is 0 for all labels.
template <bool MEASURE>
HWY_INLINE void sendSoftThreshold(const SiteRow& row, const std::uint16_t* h, Vec most,
                                  Vec weight, std::uint16_t* message,
                                  std::uint16_t* target, MessageStore<MEASURE>& store)
{
  const Tag d;
  const std::size_t lanes = hn::Lanes(d);
  const auto none = hn::Eq(weight, hn::Set(d, PairPrices::NO_EDGE));
  const Vec reach = hn::IfThenZeroElse(none, most);
  const Vec least = hn::SaturatedSub(hn::Set(d, row.order->least()), weight);
  for (int b = 0; b < row.labels; ++b) {
    const std::size_t at = static_cast<std::size_t>(b) * lanes;
    hn::Store(hn::Load(d, h + at), d, message + at);
  }
  for (int a = 0; a < row.labels; ++a) {
    const Vec own = hn::Load(d, h + static_cast<std::size_t>(a) * lanes);
    const auto wins = hn::Lt(hn::Add(own, least), reach);
    if (hn::AllFalse(d, wins))
      continue;
    const Vec slack = hn::SaturatedAdd(hn::SaturatedSub(reach, own), weight);
    const std::uint16_t limit =
        hn::GetLane(hn::MaxOfLanes(d, hn::IfThenElseZero(wins, slack)));
    const PriceOrder::Change* change = row.order->from(a);
    const PriceOrder::Change* end = change + row.order->others();
    for (; change != end && change->price < limit; ++change) {
      std::uint16_t* to = message + static_cast<std::size_t>(change->label) * lanes;
      const Vec price = hn::SaturatedSub(hn::Set(d, change->price), weight);
      hn::Store(hn::Min(hn::Load(d, to), hn::Add(own, price)), d, to);
    }
  }
  for (int b = 0; b < row.labels; ++b)
    store(hn::IfThenZeroElse(
              none, hn::Load(d, message + static_cast<std::size_t>(b) * lanes)),
          target + static_cast<std::ptrdiff_t>(b) * row.label_stride);
}

/// Messages max(pairwise, scale * weight): the diagonal is not free, so every
/// predecessor counts and the least value has to be subtracted afterwards.
template <bool MEASURE>
HWY_INLINE void sendScaledMaximum(const SiteRow& row, const std::uint16_t* h,
                                  Vec weight, std::uint16_t* message,
                                  std::uint16_t* target, MessageStore<MEASURE>& store)
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
          target + static_cast<std::ptrdiff_t>(b) * row.label_stride);
  }
}

template <bool MEASURE>
HWY_INLINE std::uint16_t SendAll(const SiteRow& row, const SendRow& send,
                                 KernelScratch& scratch)
{
  const Tag d;
  const std::size_t lanes = hn::Lanes(d);
  std::uint16_t* const sum = scratch.belief;
  std::uint16_t* const h = scratch.h;

  MessageStore<MEASURE> store = {hn::Zero(d)};
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
        sendSoftThreshold(row, h, most, weight, scratch.message,
                          send.target[direction] + k, store);
      else
        sendScaledMaximum(row, h, weight, scratch.message, send.target[direction] + k,
                          store);
    }
  }
  return hn::GetLane(hn::MaxOfLanes(d, store.change));
}

std::uint16_t SendMessages(const SiteRow& row, const SendRow& send,
                           KernelScratch& scratch)
{
  return SendAll<true>(row, send, scratch);
}

void SendUnmeasured(const SiteRow& row, const SendRow& send, KernelScratch& scratch)
{
  SendAll<false>(row, send, scratch);
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
HWY_EXPORT(SendUnmeasured);
HWY_EXPORT(MapRow);

namespace {

constexpr std::size_t VECTOR = CheckerboardLayout::PADDING; // elements, at most
constexpr std::size_t ALIGNMENT = 64;                       // bytes, of any vector

} // namespace

KernelScratch::KernelScratch(int labels, int layout_stride)
: row(static_cast<std::size_t>(layout_stride))
, buffer_(3 * static_cast<std::size_t>(labels) * VECTOR + ALIGNMENT)
{
  void* start = buffer_.data();
  std::size_t space = buffer_.size() * sizeof(std::uint16_t);
  belief = static_cast<std::uint16_t*>(std::align(ALIGNMENT, 1, start, space));
  h = belief + static_cast<std::size_t>(labels) * VECTOR;
  message = h + static_cast<std::size_t>(labels) * VECTOR;
}

SiteRow makeSiteRow(const CheckerboardLayout& layout, const PairPrices& prices,
                    int colour, int y)
{
  SiteRow row;
  row.sites = layout.sitesInRow(y, colour);
  row.labels = prices.labels();
  row.label_stride = layout.stride;
  row.model = prices.edgeModel();
  row.pairwise = prices.pairwiseMatrix();
  row.scale = prices.scaleMatrix();
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

void sendRowUnmeasured(const SiteRow& row, const SendRow& send, KernelScratch& scratch)
{
  HWY_DYNAMIC_DISPATCH(SendUnmeasured)(row, send, scratch);
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
