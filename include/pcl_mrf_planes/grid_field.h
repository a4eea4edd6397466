// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/export.h>
#include <pcl_mrf_planes/field_rows.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_mrf_planes {

/** \brief Energy of a labelling of the sites of a grid, in 16-bit units.
 *
 * E(x) = sum over sites of data(site, x) + sum over edges of price(x, x', weight), with
 * 4-neighbours. It knows nothing of planes: any problem of this shape can be put into
 * it and solved by BeliefPropagation or propagateRows().
 *
 * \code
 * GridField field(width, height, labels);      // Potts: a change costs 500 anywhere
 * for (int a = 0; a < labels; ++a)
 *   for (int b = 0; b < a; ++b)
 *     field.setPairwise(a, b, 500);
 * field.setData(x, y, l, cost);                // for every site and label
 * field.setRightEdge(x, y, 0);                 // for every edge: the whole price
 * field.setDownEdge(x, y, 0);
 * BeliefPropagation propagation(field);
 * propagation.iterate(40, 0);
 * std::vector<std::uint16_t> labelling = propagation.mapLabels();
 * std::vector<std::uint16_t> how_sure = beliefGaps(field, propagation);
 * \endcode
 * examples/denoise_labels.cpp is a whole program.
 *
 * All costs are unsigned 16-bit integers. The largest data cost plus four times the
 * largest price must not exceed 65535, so that no sum of a site's data cost and its
 * four messages overflows.
 */
class PCL_MRF_PLANES_EXPORT GridField : public FieldRows {
public:
  /** \brief Weight of an edge that does not exist: it carries no message. */
  static constexpr std::uint16_t NO_EDGE = PairPrices::NO_EDGE;

  GridField() = default;

  /** \brief A field with no edges and zero costs.
   * \param[in] width, height sites, >= 1
   * \param[in] labels number of labels, >= 1
   * \param[in] model how weights and labels give a price
   */
  GridField(int width, int height, int labels,
            EdgeModel model = EdgeModel::SOFT_THRESHOLD)
  : GridField(CheckerboardLayout(width, height), PairPrices(labels, model))
  {}

  /** \brief A copy of all the rows of another field. O(sites * labels) */
  explicit GridField(const FieldRows& rows);

  /// Columns of sites.
  int width() const { return layout_.width; }
  /// Rows of sites.
  int height() const { return layout_.height; }
  /// Number of labels.
  int labels() const { return prices_.labels(); }
  /// How weights and labels give a price.
  EdgeModel edgeModel() const { return prices_.edgeModel(); }
  const CheckerboardLayout& layout() const override { return layout_; }
  const PairPrices& prices() const override { return prices_; }

  /** \brief Data cost of label \a l at site (x, y). */
  std::uint16_t data(int x, int y, int l) const
  {
    return data_[colour(x, y)][at(x, y, l)];
  }
  /// Set the data cost of label \a l at site (x, y).
  void setData(int x, int y, int l, std::uint16_t cost)
  {
    data_[colour(x, y)][at(x, y, l)] = cost;
  }

  /// \name See PairPrices
  ///@{
  /** \brief PairPrices::pairwise() */
  std::uint16_t pairwise(int a, int b) const { return prices_.pairwise(a, b); }
  /// PairPrices::setPairwise()
  void setPairwise(int a, int b, std::uint16_t cost)
  {
    prices_.setPairwise(a, b, cost);
  }
  /// PairPrices::scale()
  std::uint16_t scale(int a, int b) const { return prices_.scale(a, b); }
  /// PairPrices::setScale()
  void setScale(int a, int b, std::uint16_t factor) { prices_.setScale(a, b, factor); }
  /// PairPrices::price()
  std::uint32_t price(int a, int b, std::uint16_t weight) const
  {
    return prices_.price(a, b, weight);
  }
  ///@}

  /** \brief Weight of the edge from (x, y) to (x + 1, y); NO_EDGE for none. */
  std::uint16_t rightEdge(int x, int y) const { return right_[colour(x, y)][at(x, y)]; }
  /// Set the weight of the edge from (x, y) to (x + 1, y); NO_EDGE for none.
  void setRightEdge(int x, int y, std::uint16_t w)
  {
    right_[colour(x, y)][at(x, y)] = w;
  }

  /** \brief Weight of the edge from (x, y) to (x, y + 1); NO_EDGE for none. */
  std::uint16_t downEdge(int x, int y) const { return down_[colour(x, y)][at(x, y)]; }
  /// Set the weight of the edge from (x, y) to (x, y + 1); NO_EDGE for none.
  void setDownEdge(int x, int y, std::uint16_t w) { down_[colour(x, y)][at(x, y)] = w; }

  /** \brief Energy of a labelling (row by row, values below labels()). O(sites) */
  std::uint64_t energy(const std::vector<std::uint16_t>& labelling) const;

  void fillRow(int y, const FieldRow& row) const override;

  /// \name Raw rows of one colour, for the kernels
  ///@{
  /** \brief Data costs of label \a l in row \a y. */
  const std::uint16_t* dataRow(int colour, int y, int l) const
  {
    return data_[colour].data() + layout_.rowStart(y, labels(), l);
  }
  /// Weights of the edges to the right in row \a y.
  const std::uint16_t* rightRow(int colour, int y) const
  {
    return right_[colour].data() + layout_.rowStart(y);
  }
  /// Weights of the edges below row \a y.
  const std::uint16_t* downRow(int colour, int y) const
  {
    return down_[colour].data() + layout_.rowStart(y);
  }
  ///@}

private:
  GridField(const CheckerboardLayout& layout, const PairPrices& prices);

  static int colour(int x, int y) { return (x + y) & 1; }
  std::size_t at(int x, int y) const
  {
    return layout_.rowStart(y) + static_cast<std::size_t>(x / 2);
  }
  std::size_t at(int x, int y, int l) const
  {
    return layout_.rowStart(y, labels(), l) + static_cast<std::size_t>(x / 2);
  }

  CheckerboardLayout layout_;
  PairPrices prices_;
  std::vector<std::uint16_t> data_[2];
  std::vector<std::uint16_t> right_[2];
  std::vector<std::uint16_t> down_[2];
};

} // namespace pcl_mrf_planes
