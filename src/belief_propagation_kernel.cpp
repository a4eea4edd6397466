// SPDX-License-Identifier: BSD-3-Clause
//
// The inner loops of belief propagation on 16-bit integers. Compiled once for every
// instruction set that the compiler knows; the best one is chosen at run time.
#include "belief_propagation_kernel.h"

#include <algorithm>
#include <memory>
#include <type_traits>
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

/// A price that stands twice in 32 bits, for all sites: processors fill lanes of 32 bits
/// as they load, those of 16 bits by one more step.
HWY_INLINE Vec priceOf(std::uint32_t twice)
{
#if HWY_TARGET == HWY_SCALAR
  return hn::Set(Tag(), static_cast<std::uint16_t>(twice & 0xFFFFU));
#else
  return hn::BitCast(Tag(), hn::Set(hn::RepartitionToWide<Tag>(), twice));
#endif
}

/// Labels whose messages are worked out at once, so that what is known of a third one is
/// loaded for all of them: as many as leave all in registers.
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL || HWY_TARGET == HWY_NEON
constexpr int TOGETHER = 2;
#else
constexpr int TOGETHER = 1;
#endif

/// A vector of sites that send their messages. What they know of a label but for what a
/// neighbour told them, h, stands for the four neighbours one after the other.
template <class Store>
class Sender {
public:
  HWY_INLINE Sender(const SiteRow& row, const SendRow& send, KernelScratch& scratch,
                    std::ptrdiff_t k, Store& store)
  : row_(row)
  , scratch_(scratch)
  , store_(store)
  , labels_(row.labels)
  {
    const Tag d;
    for (int to = 0; to < DIRECTIONS; ++to) {
      target_[to] = send.target[to] == nullptr ? nullptr : send.target[to] + k;
      weight_[to] = send.target[to] == nullptr ? hn::Set(d, PairPrices::NO_EDGE)
                                               : hn::LoadU(d, send.weight[to] + k);
    }
    learn(k);
  }

  /// Messages max(0, pairwise - weight): exact, with predecessors that cannot win skipped.
  ///
  /// m(b) = min over a of h(a) + price(a, b), and price(b, b) = 0. A label a != b can
  /// beat h(b) only if h(a) + least price < h(b), hence only if h(a) + least price < max
  /// h. The least value is that of h. No sum overflows: h has three of the four messages
  /// that GridField allows for. Where there is no edge, nothing is told.
  HWY_INLINE void sendSoftThreshold()
  {
    const Tag d;
    const Vec least_price = hn::Set(d, row_.least_pairwise);
    Vec heaviest = hn::Zero(d);
    for (int to = 0; to < DIRECTIONS; ++to)
      heaviest = hn::Max(heaviest, hn::IfThenElseZero(edge(to), weight_[to]));
    findActive();
    // Where no weight reaches the least price, all of it comes off whatever the labels
    // are, and so off the least sum.
    if (!hn::AllFalse(d, hn::Lt(least_price, heaviest)))
      sendAll<false>();
    else if (row_.hasHeard())
      sendAll<true>();
    else
      sendFirst();
  }

  /// Messages max(pairwise, scale * weight): the diagonal is not free, so every
  /// predecessor counts and the least value of the message is not that of h.
  HWY_INLINE void sendScaledMaximum()
  {
    for (int to = 0; to < DIRECTIONS; ++to)
      if (target_[to] != nullptr)
        sendScaledMaximum(to);
  }

private:
  HWY_INLINE static std::size_t vectors(int count)
  {
    return static_cast<std::size_t>(count) * hn::Lanes(Tag());
  }

  HWY_INLINE Vec known(int label, int to) const
  {
    return hn::Load(Tag(), scratch_.h + vectors(DIRECTIONS * label + to));
  }

  HWY_INLINE hn::Mask<Tag> edge(int to) const
  {
    return hn::Ne(weight_[to], hn::Set(Tag(), PairPrices::NO_EDGE));
  }

  HWY_INLINE void learn(std::ptrdiff_t at)
  {
    const Tag d;
    for (int to = 0; to < DIRECTIONS; ++to) {
      least_[to] = hn::Set(d, PairPrices::NO_EDGE);
      most_[to] = hn::Zero(d);
    }
    if (row_.hasHeard())
      learnByMessages(at);
    else
      learnByData(at);
  }

  HWY_INLINE void learnByData(std::ptrdiff_t at)
  {
    const Tag d;
    std::uint16_t* h = scratch_.h;
    for (int l = labels_; l > 0; --l, at += row_.label_stride) {
      const Vec data = hn::LoadU(d, row_.data + at);
      for (int to = 0; to < DIRECTIONS; ++to, h += hn::Lanes(d))
        hn::Store(data, d, h);
      least_[0] = hn::Min(least_[0], data);
      most_[0] = hn::Max(most_[0], data);
    }
    for (int to = 1; to < DIRECTIONS; ++to) {
      least_[to] = least_[0];
      most_[to] = most_[0];
    }
  }

  HWY_INLINE void learnByMessages(std::ptrdiff_t at)
  {
    const Tag d;
    const SitePointers costs(row_);
    std::uint16_t* h = scratch_.h;
    for (int l = labels_; l > 0; --l, at += row_.label_stride) {
      const Vec told[DIRECTIONS] = {
          hn::LoadU(d, costs.left + at), hn::LoadU(d, costs.right + at),
          hn::LoadU(d, costs.above + at), hn::LoadU(d, costs.below + at)};
      const Vec belief =
          hn::Add(hn::LoadU(d, costs.data + at),
                  hn::Add(hn::Add(told[0], told[1]), hn::Add(told[2], told[3])));
      for (int to = 0; to < DIRECTIONS; ++to, h += hn::Lanes(d)) {
        const Vec rest = hn::Sub(belief, told[to]);
        hn::Store(rest, d, h);
        least_[to] = hn::Min(least_[to], rest);
        most_[to] = hn::Max(most_[to], rest);
      }
    }
  }

  /// Predecessors that may win for one of the neighbours.
  HWY_INLINE void findActive()
  {
    const Tag d;
    const Vec least_price = hn::Set(d, row_.least_pairwise);
    Vec limit[DIRECTIONS]; // what h has to be below to matter; nothing is below 0
    for (int to = 0; to < DIRECTIONS; ++to)
      limit[to] = hn::IfThenElseZero(
          edge(to),
          hn::SaturatedSub(most_[to], hn::SaturatedSub(least_price, weight_[to])));
    count_ = 0;
    for (int a = 0; a < labels_; ++a) {
      scratch_.active[static_cast<std::size_t>(count_)] = a;
      const auto first =
          hn::Or(hn::Lt(known(a, 0), limit[0]), hn::Lt(known(a, 1), limit[1]));
      const auto last =
          hn::Or(hn::Lt(known(a, 2), limit[2]), hn::Lt(known(a, 3), limit[3]));
      count_ += hn::AllFalse(d, hn::Or(first, last)) ? 0 : 1;
    }
  }

  template <bool LIGHT>
  HWY_INLINE void sendAll()
  {
    int b = 0;
    for (; b + TOGETHER <= labels_; b += TOGETHER)
      sendLabels<LIGHT, TOGETHER>(b);
    for (; b < labels_; ++b)
      sendLabels<LIGHT, 1>(b);
  }

  /// Sends what the sites say of labels b to b + LABELS - 1.
  template <bool LIGHT, int LABELS>
  HWY_INLINE void sendLabels(int b)
  {
    const Tag d;
    const std::uint32_t* const prices =
        row_.prices_twice + static_cast<std::ptrdiff_t>(b) * labels_;
    Vec message[LABELS][DIRECTIONS];
    for (int j = 0; j < LABELS; ++j)
      for (int to = 0; to < DIRECTIONS; ++to)
        message[j][to] = LIGHT ? hn::Set(d, PairPrices::NO_EDGE) : known(b + j, to);
    const Vec w0 = weight_[0], w1 = weight_[1], w2 = weight_[2], w3 = weight_[3];
    const int* const active = scratch_.active.data();
    const int count = count_;
    const std::uint16_t* const h = scratch_.h;
    for (int i = 0; i < count; ++i) {
      const int a = active[i];
      const std::uint16_t* const at = h + vectors(DIRECTIONS * a);
      const Vec h0 = hn::Load(d, at), h1 = hn::Load(d, at + hn::Lanes(d)),
                h2 = hn::Load(d, at + 2 * hn::Lanes(d)),
                h3 = hn::Load(d, at + 3 * hn::Lanes(d));
      for (int j = 0; j < LABELS; ++j) {
        const Vec price = priceOf(prices[j * labels_ + a]);
        const auto over = [&](Vec w) HWY_ATTR {
          return LIGHT ? price : hn::SaturatedSub(price, w);
        };
        message[j][0] = hn::Min(message[j][0], hn::Add(h0, over(w0)));
        message[j][1] = hn::Min(message[j][1], hn::Add(h1, over(w1)));
        message[j][2] = hn::Min(message[j][2], hn::Add(h2, over(w2)));
        message[j][3] = hn::Min(message[j][3], hn::Add(h3, over(w3)));
      }
    }
    for (int j = 0; j < LABELS; ++j)
      for (int to = 0; to < DIRECTIONS; ++to) {
        if (target_[to] == nullptr)
          continue;
        Vec least = message[j][to];
        if (LIGHT)
          least = hn::Min(known(b + j, to), hn::SaturatedSub(least, weight_[to]));
        store(b + j, to, least);
      }
  }

  /// Of sites that have heard nothing: they know the same beside every neighbour.
  HWY_INLINE void sendFirst()
  {
    constexpr int AT_ONCE = 4; // labels
    int b = 0;
    for (; b + AT_ONCE <= labels_; b += AT_ONCE)
      sendFirst<AT_ONCE>(b);
    for (; b < labels_; ++b)
      sendFirst<1>(b);
  }

  template <int LABELS>
  HWY_INLINE void sendFirst(int b)
  {
    const Tag d;
    const std::uint32_t* const prices =
        row_.prices_twice + static_cast<std::ptrdiff_t>(b) * labels_;
    Vec best[LABELS];
    for (int j = 0; j < LABELS; ++j)
      best[j] = hn::Set(d, PairPrices::NO_EDGE);
    for (int i = 0; i < count_; ++i) {
      const int a = scratch_.active[static_cast<std::size_t>(i)];
      const Vec h = known(a, 0);
      for (int j = 0; j < LABELS; ++j)
        best[j] = hn::Min(best[j], hn::Add(h, priceOf(prices[j * labels_ + a])));
    }
    for (int j = 0; j < LABELS; ++j)
      for (int to = 0; to < DIRECTIONS; ++to)
        if (target_[to] != nullptr)
          store(b + j, to,
                hn::Min(known(b + j, to), hn::SaturatedSub(best[j], weight_[to])));
  }

  /// Stores a message, less its least value.
  HWY_INLINE void store(int label, int to, Vec message)
  {
    store_.store(hn::IfThenElseZero(edge(to), hn::Sub(message, least_[to])),
                 target_[to] + static_cast<std::ptrdiff_t>(label) * row_.label_stride);
  }

  HWY_INLINE void sendScaledMaximum(int to)
  {
    const Tag d;
    Vec least = hn::Set(d, PairPrices::NO_EDGE);
    for (int b = 0; b < labels_; ++b) {
      const std::ptrdiff_t pairs = static_cast<std::ptrdiff_t>(b) * labels_;
      Vec best = hn::Set(d, PairPrices::NO_EDGE);
      for (int a = 0; a < labels_; ++a) {
        const Vec scaled = hn::MulHigh(hn::Set(d, row_.scale[pairs + a]), weight_[to]);
        const Vec price = hn::Max(hn::Set(d, row_.pairwise[pairs + a]), scaled);
        best = hn::Min(best, hn::Add(hn::Sub(known(a, to), least_[to]), price));
      }
      hn::Store(best, d, scratch_.message + vectors(b));
      least = hn::Min(least, best);
    }
    for (int b = 0; b < labels_; ++b) {
      const Vec best = hn::Load(d, scratch_.message + vectors(b));
      store_.store(hn::IfThenElseZero(edge(to), hn::Sub(best, least)),
                   target_[to] + static_cast<std::ptrdiff_t>(b) * row_.label_stride);
    }
  }

  const SiteRow& row_;
  KernelScratch& scratch_;
  Store& store_;
  int labels_;
  int count_ = 0; ///< of the active predecessors
  std::uint16_t* target_[DIRECTIONS];
  Vec weight_[DIRECTIONS];
  Vec least_[DIRECTIONS];
  Vec most_[DIRECTIONS];
};

template <class Store>
HWY_INLINE void sendMessages(const SiteRow& row, const SendRow& send,
                             KernelScratch& scratch, Store&& store)
{
  for (std::ptrdiff_t k = 0; k < row.sites;
       k += static_cast<std::ptrdiff_t>(hn::Lanes(Tag()))) {
    Sender<std::remove_reference_t<Store>> sites(row, send, scratch, k, store);
    if (row.model == EdgeModel::SOFT_THRESHOLD)
      sites.sendSoftThreshold();
    else
      sites.sendScaledMaximum();
  }
}

void SendMessages(const SiteRow& row, const SendRow& send, KernelScratch& scratch)
{
  const Unwatched store;
  sendMessages(row, send, scratch, store);
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

PriceTable::PriceTable(const PairPrices& prices)
: twice_(static_cast<std::size_t>(prices.labels()) *
         static_cast<std::size_t>(prices.labels()))
, least_(prices.leastPairwise())
{
  const std::uint16_t* const pairwise = prices.pairwiseMatrix();
  std::transform(pairwise, pairwise + twice_.size(), twice_.begin(),
                 [](std::uint16_t price) { return price * 0x10001U; });
  const std::uint32_t same = prices.labels() > 1 ? least_ * 0x10001U : 0;
  for (std::size_t l = 0; l < twice_.size();
       l += static_cast<std::size_t>(prices.labels()) + 1)
    twice_[l] = same;
}

KernelScratch::KernelScratch(int labels, int layout_stride)
: active(static_cast<std::size_t>(labels))
, row(static_cast<std::size_t>(layout_stride))
, buffer_((DIRECTIONS + 1) * static_cast<std::size_t>(labels) * VECTOR + ALIGNMENT)
{
  void* start = buffer_.data();
  std::size_t space = buffer_.size() * sizeof(std::uint16_t);
  h = static_cast<std::uint16_t*>(std::align(ALIGNMENT, 1, start, space));
  message = h + DIRECTIONS * static_cast<std::size_t>(labels) * VECTOR;
}

SiteRow makeSiteRow(const CheckerboardLayout& layout, const PairPrices& prices,
                    const PriceTable& table, int colour, int y)
{
  SiteRow row;
  row.sites = layout.sitesInRow(y, colour);
  row.labels = prices.labels();
  row.label_stride = layout.stride;
  row.model = prices.edgeModel();
  row.pairwise = prices.pairwiseMatrix();
  row.scale = prices.scaleMatrix();
  row.prices_twice = table.twice();
  row.least_pairwise = table.least();
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
