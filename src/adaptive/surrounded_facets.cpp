// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/surrounded_facets.h"

#include <Eigen/Dense>

namespace pcl_mrf_planes::adaptive {

namespace {

/// What lies around a region.
struct Surroundings {
  double all = 0;    ///< points of its border
  double smooth = 0; ///< those in folds, or where the surface goes on without a plane
  /// Scatter of the differences of the normals across the folds.
  Eigen::Matrix3d turns = Eigen::Matrix3d::Zero();

  void fold(const Eigen::Vector3d& turn, double length)
  {
    smooth += length;
    turns += length * turn * turn.transpose();
  }

  /// Whether a tenth of the turning is across the rest of it.
  bool turnsBothWays() const
  {
    constexpr double LEAST = 0.1;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(turns,
                                                              Eigen::EigenvaluesOnly);
    return axes.eigenvalues()(1) > LEAST * turns.trace();
  }
};

} // namespace

FrameVector<bool> findSurroundedFacets(const FittedRegions& regions,
                                       const RegionBorders& borders,
                                       const FrameVector<Fold>& folds,
                                       double least_share)
{
  FrameVector<Surroundings> around(regions.planes.size());
  for (std::size_t k = 0; k < around.size(); ++k) {
    around[k].all = borders.open[k];
    around[k].smooth = borders.goes_on[k];
  }
  for (const auto& [pair, border] : borders.between) {
    around[static_cast<std::size_t>(pair.first)].all += border.length;
    around[static_cast<std::size_t>(pair.second)].all += border.length;
  }
  for (const Fold& fold : folds) {
    const Eigen::Vector3d turn =
        regions.planes[fold.a].normal - regions.planes[fold.b].normal;
    around[fold.a].fold(turn, fold.length);
    around[fold.b].fold(turn, fold.length);
  }
  FrameVector<bool> surrounded;
  surrounded.reserve(around.size());
  for (const Surroundings& of_region : around)
    surrounded.push_back(of_region.all > 0 &&
                         of_region.smooth >= least_share * of_region.all &&
                         of_region.turnsBothWays());
  return surrounded;
}

} // namespace pcl_mrf_planes::adaptive
