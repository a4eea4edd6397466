// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pcl_mrf_planes::reference {

/** \brief A plane on its way through the merging of section IV-B. */
struct MergedPlane {
  Eigen::Vector4d plane;
  double error = 0.0;               ///< root mean square distance of its tile
  double points = 0.0;              ///< of the tiles that refer to it
  std::vector<std::size_t> members; ///< input planes that refer to it
};

/** \brief Equations (5) and (9). */
inline double dissimilarity(const Eigen::Vector4d& p, const Eigen::Vector4d& q,
                            double beta)
{
  return std::max(0.0, 1.0 - p.head<3>().dot(q.head<3>())) +
         beta * std::abs(p[3] - q[3]);
}

/** \brief Smaller error first; equal ones by what they are, not by where they stood. */
inline bool betterPlane(const MergedPlane& p, const MergedPlane& q)
{
  const auto key = [](const MergedPlane& m) {
    return std::array<double, 5>{m.error, m.plane[0], m.plane[1], m.plane[2],
                                 m.plane[3]};
  };
  return key(p) < key(q);
}

/** \brief The winner keeps its coefficients and takes over the loser's data. */
inline void absorb(MergedPlane& winner, const MergedPlane& loser)
{
  winner.points += loser.points;
  winner.members.insert(winner.members.end(), loser.members.begin(),
                        loser.members.end());
}

/** \brief Section IV-B: adjacent planes on each axis in turn, until nothing merges;
 * then every pair that is left below the threshold, best plane first.
 * \return the planes, most points first */
inline std::vector<MergedPlane> mergePlanes(std::vector<MergedPlane> planes,
                                            double beta, double threshold)
{
  const auto similar = [&](const MergedPlane& p, const MergedPlane& q) {
    return dissimilarity(p.plane, q.plane, beta) < threshold;
  };
  for (bool merged = true; merged;) {
    merged = false;
    for (int axis = 0; axis < 4; ++axis) {
      std::sort(planes.begin(), planes.end(),
                [&](const MergedPlane& p, const MergedPlane& q) {
                  return p.plane[axis] != q.plane[axis] ? p.plane[axis] < q.plane[axis]
                                                        : betterPlane(p, q);
                });
      for (std::size_t i = 0; i + 1 < planes.size();) {
        if (!similar(planes[i], planes[i + 1])) {
          ++i;
          continue;
        }
        const std::size_t winner = betterPlane(planes[i], planes[i + 1]) ? i : i + 1;
        const std::size_t loser = winner == i ? i + 1 : i;
        absorb(planes[winner], planes[loser]);
        planes.erase(planes.begin() + static_cast<std::ptrdiff_t>(loser));
        merged = true;
      }
    }
  }
  std::sort(planes.begin(), planes.end(), betterPlane);
  std::vector<MergedPlane> kept;
  for (const MergedPlane& plane : planes) {
    MergedPlane* closest = nullptr;
    for (MergedPlane& candidate : kept)
      if (similar(candidate, plane) &&
          (closest == nullptr || dissimilarity(candidate.plane, plane.plane, beta) <
                                     dissimilarity(closest->plane, plane.plane, beta)))
        closest = &candidate;
    if (closest != nullptr)
      absorb(*closest, plane);
    else
      kept.push_back(plane);
  }
  std::sort(kept.begin(), kept.end(), [](const MergedPlane& p, const MergedPlane& q) {
    return p.points != q.points ? p.points > q.points : betterPlane(p, q);
  });
  return kept;
}

} // namespace pcl_mrf_planes::reference
