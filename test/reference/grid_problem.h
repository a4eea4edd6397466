// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/grid_field.h>

#include <algorithm>
#include <cstdint>

namespace pcl_mrf_planes::reference {

/** \brief A GridField as a problem for propagation.h, read through its accessors. */
class GridProblem {
public:
  using Cost = std::int64_t;

  explicit GridProblem(const GridField& field)
  : field_(field)
  {}

  int width() const { return field_.width(); }
  int height() const { return field_.height(); }
  int labels() const { return field_.labels(); }
  Cost data(int x, int y, int l) const { return field_.data(x, y, l); }

  bool connected(int x, int y, int u, int v) const
  {
    return u >= 0 && v >= 0 && u < width() && v < height() &&
           weight(x, y, u, v) != GridField::NO_EDGE;
  }

  Cost price(int x, int y, int u, int v, int a, int b) const
  {
    return field_.price(a, b, weight(x, y, u, v));
  }

private:
  std::uint16_t weight(int x, int y, int u, int v) const
  {
    return y == v ? field_.rightEdge(std::min(x, u), y)
                  : field_.downEdge(x, std::min(y, v));
  }

  const GridField& field_;
};

} // namespace pcl_mrf_planes::reference
