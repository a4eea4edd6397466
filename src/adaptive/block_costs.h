// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adaptive/block_place.h"
#include "adaptive/label_scale.h"
#include "frame_memory.h"

#include <array>
#include <vector>

namespace pcl_mrf_planes::adaptive {

/** \brief The data costs of one block at a time, and which of its labels can win. */
class BlockCosts {
public:
  static constexpr float MOST = 3.0f; ///< cut of the data cost over "no plane"'s
  static constexpr std::size_t OPEN = SIZE_MAX; ///< more than one label can win

  /** \param[in] scales of the regions, label - 1 */
  BlockCosts(const OrganizedPoints& points, const FrameVector<LabelScale>& scales,
             const TileLevel& cells, const AdaptiveParameters& parameters,
             CostUnits units);

  /** \brief Whether the points of a block, behind the sums, lie so near a plane that no hole
   * in it pays. \param[in] label region + 1 */
  bool fitAsAWhole(const TileSums& sums, std::uint16_t label) const;

  /** \brief Equation (7) in sigmas, for so many labels at all points of a block. */
  void fill(const BlockPlace& place, const std::uint16_t* labels, std::size_t count);

  /** \brief Drops planes that no point of the block can take in any optimal labelling.
   * \return how many labels are left */
  std::size_t dropHopeless(std::uint16_t* labels, std::size_t count);

  /** \brief The only label that any point of the block can take, or OPEN. */
  std::size_t settledLabel(std::size_t count) const;

  BlockRow::Numbers at(std::size_t row, std::size_t slot) const
  {
    return costs_[row][slot];
  }

private:
  static constexpr int SIDE = CandidateBlocks::SIDE;
  static constexpr std::size_t SLOTS = CandidateBlocks::SLOTS;

  /// A row of eight points; those outside the image are not valid.
  struct PointRow {
    float x[SIDE], y[SIDE], z[SIDE];
    std::uint8_t valid[SIDE]; ///< 1 or 0
  };

  void loadRow(std::size_t i, int count);
  void copyPoints(std::size_t i, std::size_t count);
  void lookUpNoise(const BlockPlace& place, int row, const std::uint16_t* labels,
                   std::size_t count);
  BlockRow::Numbers costs(const LabelScale& plane,
                          const std::array<float, SIDE>& per_sigma) const;
  std::size_t bestSomewhere(std::size_t count) const;
  bool isSettled(std::size_t label, std::size_t count) const;
  float squaresOf(std::size_t label) const;
  float excessOf(std::size_t label) const;
  double mostSquares() const;
  std::int16_t margin() const;

  const OrganizedPoints& points_;
  const TileLevel& cells_;
  const AdaptiveParameters& parameters_;
  CostUnits units_;
  const FrameVector<LabelScale>& scales_;
  // of the block at hand
  PointRow row_;
  std::array<std::array<float, SIDE>, SLOTS> per_sigma_ = {};
  std::array<std::array<BlockRow::Numbers, SLOTS>, SIDE> costs_;
  std::array<BlockRow::Numbers, SIDE> valid_;
};

} // namespace pcl_mrf_planes::adaptive
