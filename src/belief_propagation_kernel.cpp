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

/// Where the costs of the sites of a row lie, in registers.
struct SitePointers {
  explicit SitePointers(const SiteRow& row)
  : data(row.data)
  , left(row.received[LEFT])
  , right(row.received[RIGHT])
  , above(row.received[ABOVE])
  , below(row.received[BELOW])
  {}

  /// Data cost plus the four messages, of a label and of sites so far on.
  HWY_INLINE Vec belief(std::ptrdiff_t at) const
  {
    const Tag d;
    const Vec across = hn::Add(hn::LoadU(d, left + at), hn::LoadU(d, right + at));
    const Vec along = hn::Add(hn::LoadU(d, above + at), hn::LoadU(d, below + at));
    return hn::Add(hn::LoadU(d, data + at), hn::Add(across, along));
  }

  const std::uint16_t *data, *left, *right, *above, *below;
};

/// Stores messages; looks at how far they move, or does not.
struct Watched {
  HWY_INLINE void store(Vec message, std::uint16_t* target)
  {
    const Tag d;
    const Vec old = hn::LoadU(d, target);
    change = hn::Max(change, hn::Sub(hn::Max(message, old), hn::Min(message, old)));
    hn::StoreU(message, d, target);
  }

  Vec change;
};

struct Unwatched {
  HWY_INLINE void store(Vec message, std::uint16_t* target) const
  {
    hn::StoreU(message, Tag(), target);
  }
};

/// What a site knows but for what the receiver told it, with its least and its most.
struct Knowledge {
  std::uint16_t* h; ///< a vector for each label
  Vec least, most;
};

/// Messages max(0, pairwise - weight): exact, with predecessors that cannot win
/// skipped.
///
/// m(b) = min over a of h(a) + price(a, b), and price(b, b) = 0. A label a != b can
/// beat h(b) only if h(a) + least price < h(b), hence only if h(a) + least price < max
/// h. The least value is that of h. No sum overflows: h has three of the four messages
/// that GridField allows for. Where there is no edge, nothing is told.
template <class Store>
HWY_INLINE void sendSoftThreshold(const SiteRow& row, const Knowledge& site, Vec weight,
                                  int* active, std::uint16_t* target, Store&& store)
{
  const Tag d;
  const std::size_t lanes = hn::Lanes(d);
  // What is written could be any of these, for all the compiler knows.
  const int labels = row.labels;
  const std::ptrdiff_t stride = row.label_stride;
  const std::uint16_t* const h = site.h;
  const Vec least = site.least;

  const auto none = hn::Eq(weight, hn::Set(d, PairPrices::NO_EDGE));
  const Vec cheapest = hn::SaturatedSub(hn::Set(d, row.least_pairwise), weight);
  // What h has to be below to matter; nothing is below 0.
  const Vec limit = hn::IfThenZeroElse(none, hn::SaturatedSub(site.most, cheapest));
  int count = 0;
  for (int a = 0; a < labels; ++a) {
    active[count] = a;
    count += hn::AllFalse(
                 d, hn::Lt(hn::Load(d, h + static_cast<std::size_t>(a) * lanes), limit))
                 ? 0
                 : 1;
  }

  const std::uint16_t* prices = row.pairwise;
  const std::uint16_t* own = h;
  int b = 0;
  // Two labels at once: what the site knows of a third one is loaded for both.
  for (; b + 2 <= labels; b += 2, own += 2 * lanes, prices += 2 * labels) {
    Vec message = hn::Load(d, own);
    Vec next = hn::Load(d, own + lanes);
    for (int i = 0; i < count; ++i) {
      const auto a = static_cast<std::size_t>(active[i]);
      const Vec known = hn::Load(d, h + a * lanes);
      const Vec price = hn::SaturatedSub(hn::Set(d, prices[a]), weight);
      const Vec next_price = hn::SaturatedSub(
          hn::Set(d, prices[a + static_cast<std::size_t>(labels)]), weight);
      message = hn::Min(message, hn::Add(known, price));
      next = hn::Min(next, hn::Add(known, next_price));
    }
    store.store(hn::IfThenZeroElse(none, hn::Sub(message, least)), target);
    store.store(hn::IfThenZeroElse(none, hn::Sub(next, least)), target + stride);
    target += 2 * stride;
  }
  if (b < labels) {
    Vec message = hn::Load(d, own);
    for (int i = 0; i < count; ++i) {
      const auto a = static_cast<std::size_t>(active[i]);
      const Vec price = hn::SaturatedSub(hn::Set(d, prices[a]), weight);
      message = hn::Min(message, hn::Add(hn::Load(d, h + a * lanes), price));
    }
    store.store(hn::IfThenZeroElse(none, hn::Sub(message, least)), target);
  }
}

/// Messages max(pairwise, scale * weight): the diagonal is not free, so every
/// predecessor counts and the least value of the message is not that of h.
template <class Store>
HWY_INLINE void sendScaledMaximum(const SiteRow& row, const Knowledge& site, Vec weight,
                                  std::uint16_t* message, std::uint16_t* target,
                                  Store&& store)
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
      const Vec h = hn::Load(d, site.h + static_cast<std::size_t>(a) * lanes);
      best = hn::Min(best, hn::Add(hn::Sub(h, site.least), price));
    }
    hn::Store(best, d, message + static_cast<std::size_t>(b) * lanes);
    least = hn::Min(least, best);
  }
  const auto none = hn::Eq(weight, hn::Set(d, PairPrices::NO_EDGE));
  for (int b = 0; b < row.labels; ++b) {
    const Vec best = hn::Load(d, message + static_cast<std::size_t>(b) * lanes);
    store.store(hn::IfThenZeroElse(none, hn::Sub(best, least)),
                target + static_cast<std::ptrdiff_t>(b) * row.label_stride);
  }
}

/// All that a vector of sites knows but for what one neighbour told them.
HWY_INLINE Knowledge withoutMessage(const SiteRow& row, const std::uint16_t* beliefs,
                                    const std::uint16_t* received, std::uint16_t* h)
{
  const Tag d;
  const std::size_t lanes = hn::Lanes(d);
  const std::ptrdiff_t stride = row.label_stride;
  Vec least = hn::Set(d, PairPrices::NO_EDGE);
  Vec most = hn::Zero(d);
  std::uint16_t* to = h;
  for (int l = row.labels; l > 0; --l) {
    const Vec rest = hn::Sub(hn::Load(d, beliefs), hn::LoadU(d, received));
    hn::Store(rest, d, to);
    least = hn::Min(least, rest);
    most = hn::Max(most, rest);
    beliefs += lanes;
    to += lanes;
    received += stride;
  }
  return {h, least, most};
}

template <class Store>
HWY_INLINE void sendMessages(const SiteRow& row, const SendRow& send,
                             KernelScratch& scratch, Store&& store)
{
  const Tag d;
  std::uint16_t* const beliefs = scratch.belief;
  std::uint16_t* const h = scratch.h;
  int* const active = scratch.active.data();
  const int labels = row.labels;
  const SitePointers costs(row);
  for (std::ptrdiff_t k = 0; k < row.sites;
       k += static_cast<std::ptrdiff_t>(hn::Lanes(d))) {
    std::ptrdiff_t at = k;
    for (int l = 0; l < labels; ++l, at += row.label_stride)
      hn::Store(costs.belief(at), d,
                beliefs + static_cast<std::size_t>(l) * hn::Lanes(d));
    for (int direction = 0; direction < DIRECTIONS; ++direction) {
      if (send.target[direction] == nullptr)
        continue;
      const Knowledge site =
          withoutMessage(row, beliefs, row.received[direction] + k, h);
      const Vec weight = hn::LoadU(d, send.weight[direction] + k);
      std::uint16_t* const target = send.target[direction] + k;
      if (row.model == EdgeModel::SOFT_THRESHOLD)
        sendSoftThreshold(row, site, weight, active, target, store);
      else
        sendScaledMaximum(row, site, weight, scratch.message, target, store);
    }
  }
}

void SendMessages(const SiteRow& row, const SendRow& send, KernelScratch& scratch)
{
  sendMessages(row, send, scratch, Unwatched());
}

std::uint16_t SendWatchedMessages(const SiteRow& row, const SendRow& send,
                                  KernelScratch& scratch)
{
  const Tag d;
  Watched store = {hn::Zero(d)};
  sendMessages(row, send, scratch, store);
  return hn::GetLane(hn::MaxOfLanes(d, store.change));
}

void MapRow(const SiteRow& row, std::uint16_t* labels)
{
  const Tag d;
  const int count = row.labels;
  const std::ptrdiff_t stride = row.label_stride;
  const SitePointers first(row);
  for (std::ptrdiff_t k = 0; k < row.sites;
       k += static_cast<std::ptrdiff_t>(hn::Lanes(d))) {
    std::ptrdiff_t at = k;
    Vec least = first.belief(at);
    Vec best = hn::Zero(d);
    for (int l = 1; l < count; ++l) {
      at += stride;
      const Vec cost = first.belief(at);
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
HWY_EXPORT(SendWatchedMessages);
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

void sendRow(const SiteRow& row, const SendRow& send, KernelScratch& scratch)
{
  HWY_DYNAMIC_DISPATCH(SendMessages)(row, send, scratch);
}

std::uint16_t sendWatchedRow(const SiteRow& row, const SendRow& send,
                             KernelScratch& scratch)
{
  return HWY_DYNAMIC_DISPATCH(SendWatchedMessages)(row, send, scratch);
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
