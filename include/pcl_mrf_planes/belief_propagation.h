// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/export.h>
#include <pcl_mrf_planes/grid_field.h>

#include <cstdint>
#include <vector>

namespace pcl_mrf_planes {

/** \brief Max-sum loopy belief propagation on the checkerboard, section IV-D.
 *
 * Messages are negative logarithms, so that max-sum is a search for the least sum.
 * Sites of one colour have neighbours of the other colour only, so an iteration updates
 * the messages that one colour sends, and the colours take turns (Felzenszwalb and
 * Huttenlocher, IJCV 2006, section 3.2): T iterations reach what T iterations over all
 * sites reach, at half the work.
 *
 * Messages are 16-bit integers with their least value subtracted. All arithmetic is
 * exact: the labels are the same for every instruction set and any number of threads.
 *
 * An iteration costs O(sites L^2) at worst; a label that cannot be the cheapest
 * predecessor of any label is skipped, which leaves a few per site. Memory: 8 L bytes a
 * site beside the field's 2 L.
 */
class PCL_MRF_PLANES_EXPORT BeliefPropagation {
public:
  /** \param[in] field must outlive this object
   * \param[in] threads 0: as many as the machine has cores */
  explicit BeliefPropagation(const GridField& field, unsigned int threads = 1);

  /** \brief Update the messages that one colour sends.
   * \param[in] colour 0 or 1, the colour of (x + y) % 2 that sends
   * \return largest change of a message (0: the messages are settled)
   */
  std::uint16_t sendMessages(int colour);

  /** \brief Run further iterations, the colours taking turns.
   * \param[in] iterations how many at most, >= 0
   * \param[in] tolerance stop once neither colour's messages changed by more than this;
   *            negative: never
   * \return iterations done
   */
  int iterate(int iterations, int tolerance = -1);

  /** \brief True once the last messages of both colours changed by at most \a tolerance
   * (never for a negative one). */
  bool settled(int tolerance) const
  {
    return done_ >= 2 && change_[0] <= tolerance && change_[1] <= tolerance;
  }

  /** \brief The label of least belief cost at every site, row by row; ties go to the
   * smallest label. Before the first iteration: the label of least data cost. */
  std::vector<std::uint16_t> mapLabels() const;

  /** \brief Message that site (x, y) has from its neighbour in \a direction. */
  std::uint16_t message(int direction, int x, int y, int l) const;

  /// \name Directions a message comes from
  ///@{
  static constexpr int FROM_LEFT = 0;  ///< site (x - 1, y)
  static constexpr int FROM_RIGHT = 1; ///< site (x + 1, y)
  static constexpr int FROM_ABOVE = 2; ///< site (x, y - 1)
  static constexpr int FROM_BELOW = 3; ///< site (x, y + 1)
  ///@}

private:
  const GridField& field_;
  unsigned int threads_;
  int done_ = 0;
  int change_[2] = {0, 0}; ///< largest change of a message, by colour
  /// Messages that the sites of a colour have received: [direction][colour].
  std::vector<std::uint16_t> received_[4][2];
};

} // namespace pcl_mrf_planes
