// SPDX-License-Identifier: BSD-3-Clause
//
// Labels from what the neighbours of each site know, without their last messages.
// Compiled once for every instruction set that the compiler knows; the best one is chosen
// at run time.
#include "label_decision_kernel.h"

#include <algorithm>
#include <memory>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "label_decision_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pcl_mrf_planes {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// At most PADDING lanes: rows are padded for that.
using Tag = hn::CappedTag<std::uint16_t, CheckerboardLayout::PADDING>;
using Vec = hn::Vec<Tag>;

/// A vector of sites that are undecided.
class Decision {
public:
  HWY_INLINE Decision(const UndecidedRow& undecided, DecisionScratch& scratch,
                      std::ptrdiff_t k)
  : undecided_(undecided)
  , scratch_(scratch)
  , labels_(undecided.row.labels)
  , k_(k)
  {}

  /// The label of the least belief, the smallest one of these.
  HWY_INLINE Vec label()
  {
    const Tag d;
    for (int direction = 0; direction < DIRECTIONS; ++direction)
      learn(direction);
    boundBeliefs();
    if (hn::AllFalse(d, undecided()))
      return first_;
    openFirst();
    settle();
    openOthers();
    settle();
    return least();
  }

private:
  HWY_INLINE static std::size_t vectors(int label)
  {
    return static_cast<std::size_t>(label) * hn::Lanes(Tag());
  }

  HWY_INLINE Vec weight(int direction) const
  {
    return hn::LoadU(Tag(), undecided_.weight[direction] + k_);
  }

  /// By how much each label is worse for the neighbour than its best one, but for what
  /// the site told it; nothing where there is no edge.
  HWY_INLINE void learn(int direction)
  {
    const Tag d;
    const SiteRow& from = undecided_.neighbour[direction];
    std::uint16_t* const excess = scratch_.excess[direction];
    if (from.data == nullptr)
      return;
    const auto none = hn::Eq(weight(direction), hn::Set(d, PairPrices::NO_EDGE));
    // The site is the neighbour's neighbour in the opposite direction.
    const std::uint16_t* const told[3] = {
        from.received[direction] + k_, from.received[(direction + 2) % DIRECTIONS] + k_,
        from.received[opposite(direction + 2) % DIRECTIONS] + k_};
    const std::uint16_t* const data = from.data + k_;
    Vec least = hn::Set(d, PairPrices::NO_EDGE);
    std::ptrdiff_t at = 0;
    for (int l = 0; l < labels_; ++l, at += from.label_stride) {
      const Vec ends = hn::Add(hn::LoadU(d, data + at), hn::LoadU(d, told[0] + at));
      const Vec sides = hn::Add(hn::LoadU(d, told[1] + at), hn::LoadU(d, told[2] + at));
      const Vec h = hn::IfThenZeroElse(none, hn::Add(ends, sides));
      hn::Store(h, d, excess + vectors(l));
      least = hn::Min(least, h);
    }
    for (int l = 0; l < labels_; ++l)
      hn::Store(hn::Sub(hn::Load(d, excess + vectors(l)), least), d,
                excess + vectors(l));
  }

  /// A message is at most what the sender knows by itself, and less only by way of another
  /// label.
  HWY_INLINE void boundBeliefs()
  {
    const Tag d;
    bound_ = least_low_ = first_high_ = hn::Set(d, PairPrices::NO_EDGE);
    first_ = hn::Zero(d);
    std::ptrdiff_t at = k_;
    for (int l = 0; l < labels_; ++l, at += undecided_.row.label_stride) {
      const Vec cheapest = hn::Set(d, undecided_.cheapest[l]);
      Vec low = hn::LoadU(d, undecided_.row.data + at);
      Vec high = low;
      for (int direction = 0; direction < DIRECTIONS; ++direction) {
        if (undecided_.neighbour[direction].data == nullptr)
          continue;
        const Vec own = hn::Load(d, scratch_.excess[direction] + vectors(l));
        const Vec price = hn::SaturatedSub(cheapest, weight(direction));
        low = hn::Add(low, hn::Min(own, price));
        high = hn::SaturatedAdd(high, own);
      }
      hn::Store(low, d, scratch_.low + vectors(l));
      hn::Store(high, d, scratch_.high + vectors(l));
      bound_ = hn::Min(bound_, high);
      const auto better = hn::Lt(low, least_low_);
      first_ =
          hn::IfThenElse(better, hn::Set(d, static_cast<std::uint16_t>(l)), first_);
      first_high_ = hn::IfThenElse(better, high, first_high_);
      least_low_ = hn::Min(least_low_, low);
    }
  }

  /// Where the belief that may be the least is not known.
  HWY_INLINE hn::Mask<Tag> undecided() const { return hn::Lt(least_low_, first_high_); }

  /// Has the belief of a label worked out where it may win and is not known.
  HWY_INLINE void open(int l)
  {
    const Tag d;
    const Vec low = hn::Load(d, scratch_.low + vectors(l));
    const Vec high = hn::Load(d, scratch_.high + vectors(l));
    const auto where =
        hn::And(undecided(), hn::AndNot(hn::Lt(bound_, low), hn::Lt(low, high)));
    scratch_.open[static_cast<std::size_t>(open_)] = l;
    hn::Store(hn::IfThenElseZero(where, hn::Set(d, PairPrices::NO_EDGE)), d,
              scratch_.where + vectors(open_));
    open_ += hn::AllFalse(d, where) ? 0 : 1;
  }

  /// The labels that look best.
  HWY_INLINE void openFirst()
  {
    const Tag d;
    open_ = 0;
    Vec left = hn::IfThenElseZero(undecided(), hn::Add(first_, hn::Set(d, 1)));
    while (!hn::AllTrue(d, hn::Eq(left, hn::Zero(d)))) {
      const Vec most = hn::MaxOfLanes(d, left);
      open(hn::GetLane(most) - 1);
      left = hn::IfThenZeroElse(hn::Eq(left, most), left);
    }
  }

  /// The labels that may be better than these.
  HWY_INLINE void openOthers()
  {
    open_ = 0;
    for (int l = 0; l < labels_; ++l)
      open(l);
  }

  /// Works out the beliefs of the open labels.
  HWY_INLINE void settle()
  {
    if (open_ == 0)
      return;
    const Tag d;
    for (int i = 0; i < open_; ++i) {
      const int l = scratch_.open[static_cast<std::size_t>(i)];
      hn::Store(
          hn::LoadU(d, undecided_.row.data + k_ + l * undecided_.row.label_stride), d,
          scratch_.low + vectors(l));
    }
    for (int direction = 0; direction < DIRECTIONS; ++direction)
      if (undecided_.neighbour[direction].data != nullptr)
        addMessages(direction);
    for (int i = 0; i < open_; ++i) {
      const int l = scratch_.open[static_cast<std::size_t>(i)];
      const Vec belief = hn::Load(d, scratch_.low + vectors(l));
      hn::Store(belief, d, scratch_.high + vectors(l));
      bound_ = hn::Min(bound_, belief);
    }
  }

  /// Labels that could bring down what the neighbour says about an open label. See
  /// sendSoftThreshold().
  HWY_INLINE int findActive(const std::uint16_t* excess, Vec w)
  {
    const Tag d;
    Vec most = hn::Zero(d);
    for (int i = 0; i < open_; ++i) {
      const Vec own =
          hn::Load(d, excess + vectors(scratch_.open[static_cast<std::size_t>(i)]));
      most = hn::Max(most, hn::And(own, hn::Load(d, scratch_.where + vectors(i))));
    }
    const Vec limit = hn::SaturatedSub(
        most, hn::SaturatedSub(hn::Set(d, undecided_.row.least_pairwise), w));
    int* const active = scratch_.active.data();
    int count = 0;
    for (int a = 0; a < labels_; ++a) {
      active[count] = a;
      count += hn::AllFalse(d, hn::Lt(hn::Load(d, excess + vectors(a)), limit)) ? 0 : 1;
    }
    return count;
  }

  /// Adds what a neighbour says about the open labels.
  HWY_INLINE void addMessages(int direction)
  {
    const Tag d;
    const Vec w = weight(direction);
    const std::uint16_t* const excess = scratch_.excess[direction];
    const int count = findActive(excess, w);
    const int* const active = scratch_.active.data();
    for (int i = 0; i < open_; ++i) {
      const int b = scratch_.open[static_cast<std::size_t>(i)];
      const std::uint16_t* const prices =
          undecided_.row.pairwise + static_cast<std::ptrdiff_t>(b) * labels_;
      Vec message = hn::Load(d, excess + vectors(b));
      for (int j = 0; j < count; ++j) {
        const Vec price = hn::SaturatedSub(hn::Set(d, prices[active[j]]), w);
        message =
            hn::Min(message, hn::Add(hn::Load(d, excess + vectors(active[j])), price));
      }
      std::uint16_t* const belief = scratch_.low + vectors(b);
      hn::Store(hn::SaturatedAdd(hn::Load(d, belief), message), d, belief);
    }
  }

  HWY_INLINE Vec least() const
  {
    const Tag d;
    Vec least = hn::Load(d, scratch_.low);
    Vec best = hn::Zero(d);
    for (int l = 1; l < labels_; ++l) {
      const Vec value = hn::Load(d, scratch_.low + vectors(l));
      const auto better = hn::Lt(value, least);
      best = hn::IfThenElse(better, hn::Set(d, static_cast<std::uint16_t>(l)), best);
      least = hn::Min(least, value);
    }
    return best;
  }

  const UndecidedRow& undecided_;
  DecisionScratch& scratch_;
  int labels_;
  std::ptrdiff_t k_;
  Vec bound_;      // the least belief is at most this
  Vec least_low_;  // and at least this
  Vec first_;      // the first label of which that is true
  Vec first_high_; // what its belief is at most
  int open_ = 0;
};

void DecideRow(const UndecidedRow& undecided, DecisionScratch& scratch)
{
  const Tag d;
  for (std::ptrdiff_t k = 0; k < undecided.row.sites;
       k += static_cast<std::ptrdiff_t>(hn::Lanes(d)))
    hn::StoreU(Decision(undecided, scratch, k).label(), d, scratch.row.data() + k);
}

} // namespace HWY_NAMESPACE
} // namespace pcl_mrf_planes
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_mrf_planes {

HWY_EXPORT(DecideRow);

namespace {

constexpr std::size_t VECTOR = CheckerboardLayout::PADDING; // elements, at most
constexpr std::size_t ALIGNMENT = 64;                       // bytes, of any vector

} // namespace

FrameVector<std::uint16_t> cheapestPairs(const PairPrices& prices)
{
  FrameVector<std::uint16_t> cheapest(static_cast<std::size_t>(prices.labels()),
                                      PairPrices::NO_EDGE);
  for (int a = 0; a < prices.labels(); ++a)
    for (int b = 0; b < prices.labels(); ++b)
      if (a != b) {
        std::uint16_t& least = cheapest[static_cast<std::size_t>(a)];
        least = std::min(least, prices.pairwise(a, b));
      }
  return cheapest;
}

void alignToReceivers(UndecidedRow& undecided, int colour, int y)
{
  // As in alignToSenders().
  const int left = CheckerboardLayout::firstColumn(y, colour) - 1;
  const auto shift = [&](int direction, int by) {
    SiteRow& row = undecided.neighbour[direction];
    row.data += by;
    for (auto& received : row.received)
      received += by;
  };
  shift(LEFT, left);
  undecided.weight[LEFT] += left;
  shift(RIGHT, left + 1);
}

DecisionScratch::DecisionScratch(int labels, int layout_stride)
: open(static_cast<std::size_t>(labels))
, active(static_cast<std::size_t>(labels))
, row(static_cast<std::size_t>(layout_stride))
, buffer_((DIRECTIONS + 3) * static_cast<std::size_t>(labels) * VECTOR + ALIGNMENT)
{
  void* start = buffer_.data();
  std::size_t space = buffer_.size() * sizeof(std::uint16_t);
  low = static_cast<std::uint16_t*>(std::align(ALIGNMENT, 1, start, space));
  const std::size_t part = static_cast<std::size_t>(labels) * VECTOR;
  high = low + part;
  where = high + part;
  for (int direction = 0; direction < DIRECTIONS; ++direction)
    excess[direction] = where + static_cast<std::size_t>(direction + 1) * part;
}

void decideSites(const UndecidedRow& undecided, int width, int colour, int y,
                 DecisionScratch& scratch, std::vector<std::uint16_t>& labels)
{
  HWY_DYNAMIC_DISPATCH(DecideRow)(undecided, scratch);
  std::uint16_t* out = labels.data() +
                       static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                       CheckerboardLayout::firstColumn(y, colour);
  for (int k = 0; k < undecided.row.sites; ++k)
    out[2 * k] = scratch.row[static_cast<std::size_t>(k)];
}

} // namespace pcl_mrf_planes
#endif
