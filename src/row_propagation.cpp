// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/row_propagation.h>

#include "belief_propagation_kernel.h"
#include "threads.h"

#include <algorithm>
#include <cstddef>

namespace pcl_mrf_planes {

namespace {

/// Sweeps one band of the image.
class BandSweep {
public:
  /// Labels for rows \a first to \a last - 1.
  BandSweep(const FieldRows& field, int iterations, int first, int last)
  : field_(field)
  , layout_(field.layout())
  , labels_(field.prices().labels())
  , iterations_(iterations)
  , first_(first)
  , last_(last)
  , top_(std::max(0, first - iterations))
  , bottom_(std::min(layout_.height, last + iterations))
  , ring_(std::min(iterations + 2, bottom_ - top_))
  , least_pairwise_(field.prices().leastPairwise())
  , scratch_(labels_, layout_.stride)
  {
    for (int colour = 0; colour < 2; ++colour) {
      data_[colour].assign(layout_.bufferSize(ring_, labels_), 0);
      right_[colour].assign(layout_.bufferSize(ring_), PairPrices::NO_EDGE);
      down_[colour].assign(layout_.bufferSize(ring_), PairPrices::NO_EDGE);
      for (auto& direction : received_)
        direction[colour].resize(layout_.bufferSize(ring_, labels_));
    }
  }

  /// Writes the labels of the band into the image \a out.
  void run(std::vector<std::uint16_t>& out)
  {
    // Iteration t is at row step - t; row step is about to receive its first messages.
    clearMessages(top_);
    for (int step = top_ + 1; step - iterations_ - 1 < bottom_; ++step) {
      if (step < bottom_)
        clearMessages(step);
      if (step - 1 < bottom_)
        field_.fillRow(step - 1, fieldRow(step - 1));
      for (int t = 1; t <= iterations_; ++t) {
        const int y = step - t;
        if (y >= top_ && y < bottom_)
          send((t - 1) & 1, y);
      }
      const int done = step - iterations_ - 1;
      if (done >= first_ && done < last_)
        label(done, out);
    }
  }

private:
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

  void clearMessages(int y)
  {
    const std::size_t start = layout_.bufferSize(slot(y), labels_);
    for (auto& direction : received_)
      for (auto& colour : direction)
        std::fill_n(colour.begin() + static_cast<std::ptrdiff_t>(start),
                    layout_.bufferSize(1, labels_), std::uint16_t{0});
  }

  SiteRow siteRow(int colour, int y)
  {
    SiteRow row = makeSiteRow(layout_, field_.prices(), least_pairwise_, colour, y);
    row.data = fieldRow(y).data[colour];
    for (int d = 0; d < DIRECTIONS; ++d)
      row.received[d] = received(d, colour, y);
    return row;
  }

  void send(int colour, int y)
  {
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
    sendRow(siteRow(colour, y), rows, scratch_);
  }

  void label(int y, std::vector<std::uint16_t>& out)
  {
    for (int colour = 0; colour < 2; ++colour)
      mapSites(siteRow(colour, y), layout_.width, colour, y, scratch_, out);
  }

  const FieldRows& field_;
  const CheckerboardLayout& layout_;
  int labels_;
  int iterations_;
  int first_, last_; // rows to label
  int top_, bottom_; // rows to work on
  int ring_;         // rows in memory
  std::uint16_t least_pairwise_;
  KernelScratch scratch_;
  std::vector<std::uint16_t> data_[2];
  std::vector<std::uint16_t> right_[2];
  std::vector<std::uint16_t> down_[2];
  std::vector<std::uint16_t> received_[DIRECTIONS][2];
};

} // namespace

std::vector<std::uint16_t> propagateRows(const FieldRows& field, int iterations,
                                         unsigned int threads)
{
  const int width = field.layout().width;
  const int height = field.layout().height;
  std::vector<std::uint16_t> labels(static_cast<std::size_t>(width) *
                                    static_cast<std::size_t>(height));
  // No more bands than leave each one at least as much of its own as it repeats.
  const int most = std::max(1, height / std::max(1, 2 * iterations));
  const int bands = std::min(threadCount(threads), most);
  parallelRows(bands, threads, [&](int band) {
    const auto start = [&](int b) {
      return static_cast<int>(static_cast<long long>(height) * b / bands);
    };
    BandSweep(field, iterations, start(band), start(band + 1)).run(labels);
  });
  return labels;
}

} // namespace pcl_mrf_planes
