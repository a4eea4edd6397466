// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "label_image.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_mrf_planes::evaluation {

/** \brief How many points two label images share, label by label: all that the scores
 * need to know of them. */
struct ContingencyTable {
  /** \brief All points of one label. */
  struct Region {
    std::uint16_t label = 0;
    std::int64_t points = 0;
    std::int64_t on_no_plane = 0; ///< of them: points that the other image labels 0

    bool isPlane() const { return label != 0; }
  };

  /** \brief Points that carry one label in the truth and one in the result. */
  struct Cell {
    std::size_t truth = 0; ///< index of the region
    std::size_t label = 0; ///< index of the region
    std::int64_t points = 0;
  };

  std::vector<Region> truth;  ///< ascending labels, none empty
  std::vector<Region> labels; ///< ascending labels, none empty
  std::vector<Cell> cells;    ///< by truth, then label; none empty
  std::int64_t points = 0;    ///< of all cells

  /** \brief The planes of the truth with more than \a min_points points. */
  int countTruePlanes(std::int64_t min_points) const;
};

/** \brief Compare two label images.
 *
 * Points that the truth does not score are left out. A region of the result that has
 * fewer than half of its points where the truth scores is not judged at all: its other
 * points count as no plane. Expected time O(points).
 *
 * \throws std::invalid_argument when the sizes differ, or an image has not as many
 *         labels as its size says
 */
ContingencyTable compareLabels(const LabelImage& truth, const LabelImage& labels);

/** \brief Throw what compareLabels() throws for images that cannot be compared. */
void checkComparable(const LabelImage& truth, const LabelImage& labels);

} // namespace pcl_mrf_planes::evaluation
