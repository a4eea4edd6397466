// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/export.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_mrf_planes {

/** \brief How two labels and the weight of an edge give the price of the pair. */
enum class EdgeModel {
  SOFT_THRESHOLD, ///< max(0, pairwise(a, b) - weight): (8), (9), (10) less a constant
  SCALED_MAXIMUM ///< max(pairwise(a, b), scale(a, b) * weight): the variant in the text
};

/** \brief Prices of pairs of labels on neighbouring sites, in 16-bit units. */
class PCL_MRF_PLANES_EXPORT PairPrices {
public:
  /** \brief Weight of an edge that does not exist: its price is 0 for every pair. */
  static constexpr std::uint16_t NO_EDGE = 65535;

  PairPrices() = default;
  /// Prices of 0 for all pairs. \param[in] labels how many, >= 1
  /// \param[in] model how weights and labels give a price. O(labels^2)
  explicit PairPrices(int labels, EdgeModel model = EdgeModel::SOFT_THRESHOLD)
  {
    reset(labels, model);
  }

  /// As made anew, in the memory that is there. \param[in] labels how many, >= 1
  /// \param[in] model how weights and labels give a price. O(labels^2)
  void reset(int labels, EdgeModel model)
  {
    labels_ = labels;
    model_ = model;
    const auto count = static_cast<std::size_t>(labels);
    pairwise_.assign(count * count, 0);
    scale_.assign(count * count, 0);
  }

  /// Number of labels.
  int labels() const { return labels_; }
  /// How weights and labels give a price.
  EdgeModel edgeModel() const { return model_; }

  /** \brief Cost of the label pair (a, b), symmetric, 0 on the diagonal. */
  std::uint16_t pairwise(int a, int b) const { return pairwise_[pair(a, b)]; }
  /// Set the cost of (a, b) and (b, a). \param[in] a, b labels, 0 to labels() - 1
  /// \param[in] cost 0 if a equals b
  void setPairwise(int a, int b, std::uint16_t cost)
  {
    pairwise_[pair(a, b)] = pairwise_[pair(b, a)] = cost;
  }

  /** \brief Scale of the weight for the pair in EdgeModel::SCALED_MAXIMUM, in 1/65536.
   */
  std::uint16_t scale(int a, int b) const { return scale_[pair(a, b)]; }
  /// Set the scale of (a, b) and (b, a). \param[in] a, b labels, 0 to labels() - 1
  /// \param[in] factor in 1/65536
  void setScale(int a, int b, std::uint16_t factor)
  {
    scale_[pair(a, b)] = scale_[pair(b, a)] = factor;
  }

  /** \brief Price of labels \a a and \a b over an edge of the given weight. */
  std::uint32_t price(int a, int b, std::uint16_t weight) const
  {
    if (weight == NO_EDGE)
      return 0;
    const std::uint32_t cost = pairwise(a, b);
    if (model_ == EdgeModel::SOFT_THRESHOLD)
      return cost > weight ? cost - weight : 0;
    return std::max(cost, (static_cast<std::uint32_t>(scale(a, b)) * weight) >> 16);
  }

  /** \brief Least cost of two different labels; NO_EDGE for a single label. */
  std::uint16_t leastPairwise() const
  {
    std::uint16_t least = NO_EDGE;
    for (int a = 0; a < labels_; ++a)
      for (int b = 0; b < a; ++b)
        least = std::min(least, pairwise(a, b));
    return least;
  }

  /// The costs of all pairs, L x L, row by row.
  const std::uint16_t* pairwiseMatrix() const { return pairwise_.data(); }
  /// The scales of all pairs, L x L, row by row.
  const std::uint16_t* scaleMatrix() const { return scale_.data(); }

private:
  std::size_t pair(int a, int b) const
  {
    return static_cast<std::size_t>(a) * static_cast<std::size_t>(labels_) +
           static_cast<std::size_t>(b);
  }

  int labels_ = 0;
  EdgeModel model_ = EdgeModel::SOFT_THRESHOLD;
  std::vector<std::uint16_t> pairwise_;
  std::vector<std::uint16_t> scale_;
};

/** \brief Where the sites of a grid lie in memory: the two colours of the checkerboard
 * apart, a row of one colour after another, padded so that whole vectors can be read
 * and written one site beyond either end.
 *
 * Site (x, y) has colour (x + y) % 2 and is number x / 2 of its row and colour.
 */
struct PCL_MRF_PLANES_EXPORT CheckerboardLayout {
  static constexpr int PADDING = 32; ///< elements before and behind a row of sites

  int width = 0;  ///< columns of sites
  int height = 0; ///< rows of sites
  int stride = 0; ///< elements from one row of a colour to the next

  CheckerboardLayout() = default;
  /// For a grid of that many columns and rows, each >= 1.
  CheckerboardLayout(int grid_width, int grid_height);

  /** \brief 1 when the first site of \a colour in row \a y is at x = 1. */
  static int firstColumn(int y, int colour) { return (y + colour) & 1; }

  /** \brief Number of sites of \a colour in row \a y. */
  int sitesInRow(int y, int colour) const
  {
    return (width - firstColumn(y, colour) + 1) / 2;
  }

  /** \brief First element of row \a y, counting \a planes rows for each image row. */
  std::size_t rowStart(int y, int planes = 1, int plane = 0) const
  {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(planes) +
            static_cast<std::size_t>(plane)) *
               static_cast<std::size_t>(stride) +
           PADDING;
  }

  /** \brief Elements of a buffer with \a planes rows for each of \a rows image rows. */
  std::size_t bufferSize(int rows, int planes = 1) const
  {
    return static_cast<std::size_t>(rows) * static_cast<std::size_t>(planes) *
           static_cast<std::size_t>(stride);
  }
};

/** \brief Memory for the costs of one row of sites, the colours apart. */
struct PCL_MRF_PLANES_EXPORT FieldRow {
  std::uint16_t* data[2];  ///< by colour; label l is l * stride elements further on
  std::uint16_t* right[2]; ///< weight of the edge to the right of each site
  std::uint16_t* down[2];  ///< weight of the edge below each site
};

/** \brief A random field on a grid that gives its costs row by row, so that they need
 * not all be in memory at once. */
class PCL_MRF_PLANES_EXPORT FieldRows {
public:
  virtual ~FieldRows() = default;

  /// Size of the grid, and where its sites lie in memory.
  virtual const CheckerboardLayout& layout() const = 0;
  /// Number of labels, and what two of them side by side cost.
  virtual const PairPrices& prices() const = 0;

  /** \brief Write the costs of every site of row \a y, and nothing beside the sites.
   * Called from several threads at once. */
  virtual void fillRow(int y, const FieldRow& row) const = 0;
};

} // namespace pcl_mrf_planes
