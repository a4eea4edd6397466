// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/row_propagation.h>

#include "belief_propagation_kernel.h"
#include "frame_memory.h"
#include "label_decision_kernel.h"
#include "paper_stages.h"
#include "threads.h"

#include <algorithm>
#include <cstddef>

namespace pcl_mrf_planes {

namespace {

/// Gap between the least and the second least belief of the sites of a row.
void beliefGapRow(const SiteRow& row, std::uint16_t* best, std::uint16_t* gap)
{
  std::fill_n(best, row.sites, std::uint16_t{65535});
  std::fill_n(gap, row.sites, std::uint16_t{65535});
  for (int l = 0; l < row.labels; ++l) {
    const std::ptrdiff_t offset = static_cast<std::ptrdiff_t>(l) * row.label_stride;
    const std::uint16_t* data = row.data + offset;
    const std::uint16_t* messages[DIRECTIONS] = {
        row.received[0] + offset, row.received[1] + offset, row.received[2] + offset,
        row.received[3] + offset};
    for (int k = 0; k < row.sites; ++k) {
      // No such sum exceeds 16 bits, see GridField.
      const auto cost = static_cast<std::uint16_t>(
          data[k] + messages[0][k] + messages[1][k] + messages[2][k] + messages[3][k]);
      gap[k] = std::min(gap[k], std::max(best[k], cost));
      best[k] = std::min(best[k], cost);
    }
  }
  for (int k = 0; row.labels > 1 && k < row.sites; ++k)
    gap[k] = static_cast<std::uint16_t>(gap[k] - best[k]);
}

/// Sweeps one band of the image.
class BandSweep {
public:
  /// Results for rows \a first to \a last - 1: labels, or also gaps, for which all
  /// messages are needed.
  BandSweep(const FieldRows& field, int iterations, int first, int last, bool gaps)
  : field_(field)
  , layout_(field.layout())
  , labels_(field.prices().labels())
  , iterations_(iterations)
  , first_(first)
  , last_(last)
  , top_(std::max(0, first - iterations))
  , bottom_(std::min(layout_.height, last + iterations))
  , sent_(decides(field, iterations, gaps) ? iterations - 1 : iterations)
  , ring_(std::min(iterations + 3, bottom_ - top_))
  , table_(field.prices())
  , cheapest_(cheapestPairs(field.prices()))
  , scratch_(labels_, layout_.stride)
  , decision_scratch_(labels_, layout_.stride)
  {
    for (int colour = 0; colour < 2; ++colour) {
      data_[colour].assign(layout_.bufferSize(ring_, labels_), 0);
      right_[colour].assign(layout_.bufferSize(ring_), PairPrices::NO_EDGE);
      down_[colour].assign(layout_.bufferSize(ring_), PairPrices::NO_EDGE);
      for (auto& direction : received_)
        direction[colour].resize(layout_.bufferSize(ring_, labels_));
    }
  }

  /// Calls finish(y) for the rows of the band, when their last messages have come.
  template <typename Finish>
  void run(const Finish& finish)
  {
    // Iteration t is at row step - t; row step is about to receive its first messages.
    startMessages(top_);
    for (int step = top_ + 1; step - iterations_ - 1 < bottom_; ++step) {
      if (step < bottom_)
        startMessages(step);
      if (step - 1 < bottom_)
        field_.fillRow(step - 1, fieldRow(step - 1));
      for (int t = 1; t <= sent_; ++t) {
        const int y = step - t;
        if (y >= top_ && y < bottom_)
          send(t, y);
      }
      const int done = step - iterations_ - 1;
      if (done >= first_ && done < last_)
        finish(done);
    }
  }

  /// Writes the labels of a row into the image \a out.
  void label(int y, std::vector<std::uint16_t>& out)
  {
    for (int colour = 0; colour < 2; ++colour) {
      if (sent_ < iterations_ && colour == (iterations_ & 1))
        decideSites(undecidedRow(colour, y), layout_.width, colour, y,
                    decision_scratch_, out);
      else
        mapSites(siteRow(colour, y), layout_.width, colour, y, scratch_, out);
    }
  }

  /// Writes the gaps between the beliefs of a row into the image \a out.
  void gap(int y, std::vector<std::uint16_t>& out)
  {
    for (int colour = 0; colour < 2; ++colour) {
      const SiteRow row = siteRow(colour, y);
      gaps_.resize(2 * static_cast<std::size_t>(row.sites));
      beliefGapRow(row, gaps_.data() + row.sites, gaps_.data());
      std::uint16_t* to =
          out.data() +
          static_cast<std::size_t>(y) * static_cast<std::size_t>(layout_.width) +
          CheckerboardLayout::firstColumn(y, colour);
      for (int k = 0; k < row.sites; ++k)
        to[2 * k] = gaps_[static_cast<std::size_t>(k)];
    }
  }

private:
  /// Whether labels are decided without the last messages.
  static bool decides(const FieldRows& field, int iterations, bool gaps)
  {
    return iterations > 0 && !gaps &&
           field.prices().edgeModel() == EdgeModel::SOFT_THRESHOLD;
  }

  int slot(int y) const { return (y - top_) % ring_; }

  FieldRow fieldRow(int y)
  {
    FieldRow row{};
    for (int colour = 0; colour < 2; ++colour) {
      row.data[colour] = data_[colour].data() + layout_.rowStart(slot(y), labels_);
      row.right[colour] = right_[colour].data() + layout_.rowStart(slot(y));
      row.down[colour] = down_[colour].data() + layout_.rowStart(slot(y));
    }
    return row;
  }

  std::uint16_t* received(int direction, int colour, int y)
  {
    return received_[direction][colour].data() + layout_.rowStart(slot(y), labels_);
  }

  /// Messages of a row as none have come. The first ones of each colour are written before
  /// any is read, but for those from beyond the border of the image, or of the band.
  void startMessages(int y)
  {
    const auto start =
        static_cast<std::ptrdiff_t>(layout_.bufferSize(slot(y), labels_));
    for (int colour = 0; colour < 2; ++colour) {
      const bool all = sent_ < 2 - colour; // colour 1 hears first
      for (int direction = 0; direction < DIRECTIONS; ++direction)
        if (all || (direction == ABOVE && y == top_) ||
            (direction == BELOW && y + 1 == bottom_))
          std::fill_n(received_[direction][colour].begin() + start,
                      layout_.bufferSize(1, labels_), std::uint16_t{0});
      if (!all)
        clearEnds(colour, y);
    }
  }

  /// Nobody sends to the ends of a row from outside.
  void clearEnds(int colour, int y)
  {
    const int last = layout_.sitesInRow(y, colour) - 1;
    for (int l = 0; last >= 0 && l < labels_; ++l) {
      received(LEFT, colour, y)[l * layout_.stride] = 0;
      received(RIGHT, colour, y)[l * layout_.stride + last] = 0;
    }
  }

  SiteRow siteRow(int colour, int y)
  {
    SiteRow row = makeSiteRow(layout_, field_.prices(), table_, colour, y);
    row.data = fieldRow(y).data[colour];
    for (int d = 0; d < DIRECTIONS; ++d)
      row.received[d] = received(d, colour, y);
    return row;
  }

  UndecidedRow undecidedRow(int colour, int y)
  {
    const int other = 1 - colour;
    const FieldRow here = fieldRow(y);
    UndecidedRow undecided;
    undecided.row = siteRow(colour, y);
    undecided.cheapest = cheapest_.data();
    undecided.neighbour[LEFT] = undecided.neighbour[RIGHT] = siteRow(other, y);
    undecided.weight[LEFT] = here.right[other];
    undecided.weight[RIGHT] = here.right[colour];
    if (y > top_) {
      undecided.neighbour[ABOVE] = siteRow(other, y - 1);
      undecided.weight[ABOVE] = fieldRow(y - 1).down[other];
    }
    if (y + 1 < bottom_) {
      undecided.neighbour[BELOW] = siteRow(other, y + 1);
      undecided.weight[BELOW] = here.down[colour];
    }
    alignToReceivers(undecided, colour, y);
    return undecided;
  }

  /// \param[in] t the iteration, from 1
  void send(int t, int y)
  {
    const int colour = (t - 1) & 1;
    const int other = 1 - colour;
    const FieldRow here = fieldRow(y);
    SendRow rows;
    rows.target[LEFT] = received(RIGHT, other, y);
    rows.weight[LEFT] = here.right[other];
    rows.target[RIGHT] = received(LEFT, other, y);
    rows.weight[RIGHT] = here.right[colour];
    if (y > top_) {
      rows.target[ABOVE] = received(BELOW, other, y - 1);
      rows.weight[ABOVE] = fieldRow(y - 1).down[other];
    }
    if (y + 1 < bottom_) {
      rows.target[BELOW] = received(ABOVE, other, y + 1);
      rows.weight[BELOW] = here.down[colour];
    }
    alignToSenders(rows, colour, y);
    SiteRow row = siteRow(colour, y);
    if (t == 1)
      std::fill_n(row.received, DIRECTIONS, nullptr);
    sendRow(row, rows, scratch_);
  }

  const FieldRows& field_;
  const CheckerboardLayout& layout_;
  int labels_;
  int iterations_;
  int first_, last_; // rows to label
  int top_, bottom_; // rows to work on
  int sent_;         // iterations whose messages are sent
  int ring_;         // rows in memory
  PriceTable table_;
  FrameVector<std::uint16_t> cheapest_;
  KernelScratch scratch_;
  DecisionScratch decision_scratch_;
  FrameVector<std::uint16_t> gaps_;
  FrameVector<std::uint16_t> data_[2];
  FrameVector<std::uint16_t> right_[2];
  FrameVector<std::uint16_t> down_[2];
  FrameVector<std::uint16_t> received_[DIRECTIONS][2];
};

/// Sweeps the image in bands; finish(sweep, y, image) writes a row.
template <typename Finish>
void sweep(const FieldRows& field, int iterations, unsigned int threads, bool gaps,
           const Finish& finish, std::vector<std::uint16_t>& image)
{
  const int width = field.layout().width;
  const int height = field.layout().height;
  image.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  // No more bands than leave each one at least as much of its own as it repeats.
  const int most = std::max(1, height / std::max(1, 2 * iterations));
  const int bands = std::min(threadCount(threads), most);
  const ThreadTeam team(threads);
  parallelParts(bands, threads, [&](int band) {
    const auto start = [&](int b) {
      return static_cast<int>(static_cast<long long>(height) * b / bands);
    };
    BandSweep rows(field, iterations, start(band), start(band + 1), gaps);
    rows.run([&](int y) { finish(rows, y, image); });
  });
}

} // namespace

void propagateRows(const FieldRows& field, int iterations, unsigned int threads,
                   std::vector<std::uint16_t>& labels)
{
  sweep(
      field, iterations, threads, false,
      [](BandSweep& rows, int y, std::vector<std::uint16_t>& image) {
        rows.label(y, image);
      },
      labels);
}

std::vector<std::uint16_t> propagateRows(const FieldRows& field, int iterations,
                                         unsigned int threads)
{
  std::vector<std::uint16_t> labels;
  propagateRows(field, iterations, threads, labels);
  return labels;
}

std::vector<std::uint16_t> propagateRowGaps(const FieldRows& field, int iterations,
                                            unsigned int threads)
{
  std::vector<std::uint16_t> gaps;
  sweep(
      field, iterations, threads, true,
      [](BandSweep& rows, int y, std::vector<std::uint16_t>& image) {
        rows.gap(y, image);
      },
      gaps);
  return gaps;
}

} // namespace pcl_mrf_planes
