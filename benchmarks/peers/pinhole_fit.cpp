// SPDX-License-Identifier: BSD-3-Clause
#include "pinhole_fit.h"

#include <cmath>

namespace pcl_mrf_planes::benchmarks {

namespace {

/// Line through pairs (a, b) by least squares.
class LineFit {
public:
  void add(double a, double b)
  {
    n_ += 1.0;
    a_ += a;
    b_ += b;
    aa_ += a * a;
    ab_ += a * b;
  }
  double slope() const
  {
    const double spread = n_ * aa_ - a_ * a_;
    return spread > 0.0 ? (n_ * ab_ - a_ * b_) / spread : 1.0;
  }
  double offset() const { return n_ > 0.0 ? (b_ - slope() * a_) / n_ : 0.0; }

private:
  double n_ = 0.0, a_ = 0.0, b_ = 0.0, aa_ = 0.0, ab_ = 0.0;
};

} // namespace

PinholeFit fitPinhole(const Cloud& cloud)
{
  LineFit columns, rows;
  for (std::uint32_t row = 0; row < cloud.height; ++row)
    for (std::uint32_t column = 0; column < cloud.width; ++column) {
      const pcl::PointXYZ& point = cloud(column, row);
      if (!(point.z > 0.0f) || !std::isfinite(point.z))
        continue;
      columns.add(static_cast<double>(point.x) / point.z, column);
      rows.add(static_cast<double>(point.y) / point.z, row);
    }
  return {columns.slope(), rows.slope(), columns.offset(), rows.offset()};
}

} // namespace pcl_mrf_planes::benchmarks
