// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_mrf_planes {

/** \brief Where the sites of a grid lie in memory: the two colours of the checkerboard
 * apart, a row of one colour after another, padded so that whole vectors can be read
 * and written one site beyond either end.
 *
 * Site (x, y) has colour (x + y) % 2 and is number x / 2 of its row and colour.
 */
struct CheckerboardLayout {
  static constexpr int PADDING = 32; ///< elements before and behind a row of sites

  int width = 0;
  int height = 0;
  int stride = 0; ///< elements from one row of a colour to the next

  CheckerboardLayout() = default;
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

  /** \brief Elements of a buffer with \a planes rows for each image row. */
  std::size_t bufferSize(int planes = 1) const
  {
    return static_cast<std::size_t>(height) * static_cast<std::size_t>(planes) *
           static_cast<std::size_t>(stride);
  }
};

/** \brief How two labels and the weight of an edge give the price of the pair. */
enum class EdgeModel {
  SOFT_THRESHOLD, ///< max(0, pairwise(a, b) - weight): (8), (9), (10) less a constant
  SCALED_MAXIMUM ///< max(pairwise(a, b), scale(a, b) * weight): the variant in the text
};

/** \brief Energy of a labelling of the sites of a grid, in 16-bit units.
 *
 * E(x) = sum over sites of data(site, x) + sum over edges of price(x, x', weight), with
 * 4-neighbours. It knows nothing of planes: any problem of this shape can be put into
 * it and solved by BeliefPropagation.
 *
 * All costs are unsigned 16-bit integers, and maxData() + 4 maxPrice() <= 65535 must
 * hold, so that no sum of a site's data cost and its four messages overflows.
 */
class GridField {
public:
  /** \brief Weight of an edge that does not exist: it carries no message. */
  static constexpr std::uint16_t NO_EDGE = 65535;

  GridField() = default;

  /** \brief Set the size; no edges, zero costs.
   * \param[in] width, height sites, >= 1
   * \param[in] labels >= 1
   */
  GridField(int width, int height, int labels,
            EdgeModel model = EdgeModel::SOFT_THRESHOLD);

  int width() const { return layout_.width; }
  int height() const { return layout_.height; }
  int labels() const { return labels_; }
  EdgeModel edgeModel() const { return model_; }
  const CheckerboardLayout& layout() const { return layout_; }

  /** \brief Data cost of label \a l at site (x, y). */
  std::uint16_t data(int x, int y, int l) const
  {
    return data_[colour(x, y)][at(x, y, l)];
  }
  void setData(int x, int y, int l, std::uint16_t cost)
  {
    data_[colour(x, y)][at(x, y, l)] = cost;
  }

  /** \brief Cost of the label pair (a, b), symmetric, 0 on the diagonal. */
  std::uint16_t pairwise(int a, int b) const { return pairwise_[pair(a, b)]; }
  void setPairwise(int a, int b, std::uint16_t cost)
  {
    pairwise_[pair(a, b)] = pairwise_[pair(b, a)] = cost;
  }

  /** \brief Scale of the weight for the pair in EdgeModel::SCALED_MAXIMUM, in 1/65536.
   */
  std::uint16_t scale(int a, int b) const { return scale_[pair(a, b)]; }
  void setScale(int a, int b, std::uint16_t factor)
  {
    scale_[pair(a, b)] = scale_[pair(b, a)] = factor;
  }

  /** \brief Weight of the edge from (x, y) to (x + 1, y); NO_EDGE for none. */
  std::uint16_t rightEdge(int x, int y) const { return right_[colour(x, y)][at(x, y)]; }
  void setRightEdge(int x, int y, std::uint16_t w)
  {
    right_[colour(x, y)][at(x, y)] = w;
  }

  /** \brief Weight of the edge from (x, y) to (x, y + 1); NO_EDGE for none. */
  std::uint16_t downEdge(int x, int y) const { return down_[colour(x, y)][at(x, y)]; }
  void setDownEdge(int x, int y, std::uint16_t w) { down_[colour(x, y)][at(x, y)] = w; }

  /** \brief Price of labels \a a and \a b over an edge of the given weight. */
  std::uint32_t price(int a, int b, std::uint16_t weight) const;

  /** \brief Energy of a labelling (row by row, values below labels()). O(sites) */
  std::uint64_t energy(const std::vector<std::uint16_t>& labelling) const;

  /// \name Raw rows, for the kernels
  ///@{
  const std::uint16_t* dataRow(int colour, int y, int l) const
  {
    return data_[colour].data() + layout_.rowStart(y, labels_, l);
  }
  std::uint16_t* dataRow(int colour, int y, int l)
  {
    return data_[colour].data() + layout_.rowStart(y, labels_, l);
  }
  const std::uint16_t* rightRow(int colour, int y) const
  {
    return right_[colour].data() + layout_.rowStart(y);
  }
  const std::uint16_t* downRow(int colour, int y) const
  {
    return down_[colour].data() + layout_.rowStart(y);
  }
  const std::uint16_t* pairwiseRow(int a) const { return &pairwise_[pair(a, 0)]; }
  const std::uint16_t* scaleRow(int a) const { return &scale_[pair(a, 0)]; }
  ///@}

private:
  static int colour(int x, int y) { return (x + y) & 1; }
  std::size_t at(int x, int y) const
  {
    return layout_.rowStart(y) + static_cast<std::size_t>(x / 2);
  }
  std::size_t at(int x, int y, int l) const
  {
    return layout_.rowStart(y, labels_, l) + static_cast<std::size_t>(x / 2);
  }
  std::size_t pair(int a, int b) const
  {
    return static_cast<std::size_t>(a) * static_cast<std::size_t>(labels_) +
           static_cast<std::size_t>(b);
  }

  CheckerboardLayout layout_;
  int labels_ = 0;
  EdgeModel model_ = EdgeModel::SOFT_THRESHOLD;
  std::vector<std::uint16_t> data_[2];
  std::vector<std::uint16_t> right_[2];
  std::vector<std::uint16_t> down_[2];
  std::vector<std::uint16_t> pairwise_;
  std::vector<std::uint16_t> scale_;
};

} // namespace pcl_mrf_planes
