// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/export.h>
#include <pcl_mrf_planes/grid_field.h>
#include <pcl_mrf_planes/organized_points.h>
#include <pcl_mrf_planes/parameters.h>
#include <pcl_mrf_planes/plane.h>

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_mrf_planes {

/** \brief Energy of a segmentation, equation (6) summed over all sites; energy units.
 */
struct PCL_MRF_PLANES_EXPORT FieldEnergy {
  double data = 0.0;       ///< sum of (7) over the valid points
  double smoothness = 0.0; ///< sum of V over the edges, each edge once
  /** \brief Data and smoothness together; energy units. */
  double total() const { return data + smoothness; }
};

/** \brief The Markov random field of section IV-C: a site for every valid point, an
 * edge between every two valid 4-neighbours, a label for every plane.
 *
 * As FieldRows it is the same energy in 16-bit units, one being 1 / unitsPerEnergy().
 * The scale is the largest for which no sum in the belief propagation can overflow, so
 * each term is off by at most half a unit: two labellings whose energies differ by more
 * than (sites + edges) / unitsPerEnergy() are ordered alike in both.
 */
class PCL_MRF_PLANES_EXPORT PlaneField : public FieldRows {
public:
  /** \brief Prepare the prices. O(points + planes^2); the data terms are computed where
   * they are asked for.
   * \param[in] points the cloud, must outlive this object
   * \param[in] planes the L label planes, at least one
   * \param[in] parameters lambda, tau, beta, gamma and the smoothness term
   */
  PlaneField(const OrganizedPoints& points, std::vector<Plane> planes,
             const Parameters& parameters);
  /** \brief The same in the memory of another one, which is of no more use then.
   * \param[in] points the cloud, must outlive this object
   * \param[in] planes the L label planes, at least one
   * \param[in] parameters lambda, tau, beta, gamma and the smoothness term
   * \param[in] memory any field */
  PlaneField(const OrganizedPoints& points, const std::vector<Plane>& planes,
             const Parameters& parameters, PlaneField&& memory);

  /** \brief All the costs in 16-bit units at once. O(points * planes) */
  GridField toGridField() const { return GridField(*this); }

  /// As in FieldRows.
  const CheckerboardLayout& layout() const override { return layout_; }
  /// As in FieldRows.
  const PairPrices& prices() const override { return prices_; }
  void fillRow(int y, const FieldRow& row) const override;

  /** \brief 16-bit units in one unit of energy. */
  double unitsPerEnergy() const { return units_; }

  /// The planes of the labels, in their order.
  const std::vector<Plane>& planes() const { return planes_; }

  /** \brief Truncated point-to-plane distance, equation (7), unrounded.
   * \param[in] index a valid point \param[in] l label */
  double dataTerm(std::size_t index, int l) const;

  /** \brief Price of labels \a a and \a b on sites whose depths differ by \a dz metres:
   * (8), (9), (10) or the variant in the text, as Parameters::smoothness says. */
  double smoothnessTerm(int a, int b, double dz) const;

  /** \brief Exact energy of a labelling, row by row, in double precision.
   * \param[in] labels label of every point; those of invalid points are not read */
  FieldEnergy energy(const std::vector<std::uint16_t>& labels) const;

private:
  void prepare();
  void choosePrices(double largest_depth_step);
  void fillData(int y, const FieldRow& row) const;
  void fillEdges(int y, const FieldRow& row) const;
  void split(const std::uint16_t* costs, int y, std::uint16_t* const colours[2],
             std::ptrdiff_t offset) const;
  double edgeScale() const;
  double labelDissimilarity(int a, int b) const
  {
    return dissimilarity_[static_cast<std::size_t>(a) * planes_.size() +
                          static_cast<std::size_t>(b)];
  }
  double largestDepthStep() const;

  const OrganizedPoints& points_;
  std::vector<Plane> planes_;
  Parameters parameters_;
  std::vector<double> dissimilarity_; ///< equation (9) for every pair of labels
  double units_ = 1.0;
  CheckerboardLayout layout_;
  PairPrices prices_;
};

} // namespace pcl_mrf_planes
