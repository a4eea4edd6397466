// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "label_image.h"

#include <cstdint>
#include <limits>

namespace pcl_mrf_planes::evaluation {

/** \brief How well the borders of a result lie on those of the truth.
 *
 * A scored point is a border point of an image when that image labels the scored point
 * to its left, to its right, above or below it otherwise: both sides of a border are
 * border points, and the rim of the image or of points that are not scored is no
 * border. Label 0 is a label as any other: where a plane ends is a border.
 *
 * A border point is found when the other image has a border point at most so many
 * columns and rows away. This is boundary precision and recall as in Arbelaez et al.,
 * PAMI 2011, without their one-to-one assignment of border points.
 */
struct BorderAgreement {
  int distance = 0;              ///< points
  std::int64_t truth_points = 0; ///< border points of the truth
  std::int64_t truth_found = 0;  ///< of them, near one of the result
  std::int64_t label_points = 0; ///< border points of the result
  std::int64_t label_found = 0;  ///< of them, near one of the truth

  /** \brief Share of the result's border points that were found. NaN without any, and
   * where the truth has none: guard bands that are not scored may hide its borders. */
  double precision() const
  {
    return truth_points > 0 ? share(label_found, label_points) : NONE;
  }
  /** \brief Share of the truth's border points that were found, NaN without any. */
  double recall() const { return share(truth_found, truth_points); }
  /** \brief Harmonic mean of precision and recall; 0 for a result without borders, NaN
   * for a truth without. */
  double f() const;

private:
  static constexpr double NONE = std::numeric_limits<double>::quiet_NaN();

  static double share(std::int64_t part, std::int64_t whole)
  {
    return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : NONE;
  }
};

/** \brief Compare the borders. O(points), whatever the distance.
 * \param[in] distance columns and rows, >= 0
 * \throws std::invalid_argument when the sizes differ or the distance is negative
 */
BorderAgreement compareBorders(const LabelImage& truth, const LabelImage& labels,
                               int distance);

} // namespace pcl_mrf_planes::evaluation
