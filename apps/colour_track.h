// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/plane.h>

#include <cstdint>
#include <vector>

namespace pcl_mrf_planes::apps {

/** \brief Which planes of a sequence are one and the same, so that a wall keeps its colour.
 *
 * A plane of a frame takes the number of the plane of the frames before that it shares
 * most of its points of the image with, if their normals and offsets agree; without common
 * points they have to agree better. Planes that are gone keep their numbers for some
 * frames. A new plane takes the smallest number that is free, so that numbers, and with
 * them colours, stay few.
 *
 * The sensor may move between frames by what the tolerances allow.
 */
class ColourTrack {
public:
  /// Tolerances of two planes that are taken for one.
  struct Tolerances {
    double degrees = 15.0;    ///< between normals, of planes that overlap
    double metres = 0.15;     ///< between offsets, of planes that overlap
    double share = 0.3;       ///< of the smaller one's points that overlap
    double far_degrees = 4.0; ///< the same of planes that do not overlap
    double far_metres = 0.03;
    int frames = 30; ///< that a plane may be gone
  };

  ColourTrack() = default;
  explicit ColourTrack(const Tolerances& tolerances)
  : tolerances_(tolerances)
  {}

  /** \brief Numbers of the planes of the next frame, each different and from 1:
   * labelColour(number) is the plane's colour. O(points + planes^2)
   * \param[in] planes in the sensor frame
   * \param[in] labels of all points: 0 no plane, k planes[k - 1]. Images of another size
   *            than the last are compared by planes alone */
  std::vector<std::uint32_t> update(const std::vector<Plane>& planes,
                                    const std::vector<std::uint16_t>& labels);

  /** \brief Forget all planes: another sequence begins. */
  void reset();

private:
  struct Known {
    Plane plane;
    std::uint32_t number;
    int gone; ///< frames since it was seen
  };

  struct Match {
    double score;
    std::size_t known, plane;
  };

  std::vector<Match> findMatches(const std::vector<Plane>& planes,
                                 const std::vector<std::uint16_t>& labels) const;
  void addMatch(const Plane& plane, std::size_t k, std::size_t known, double share,
                std::vector<Match>& matches) const;
  std::uint32_t freeNumber(const std::vector<std::uint32_t>& taken) const;
  void remember(const std::vector<Plane>& planes,
                const std::vector<std::uint16_t>& labels,
                const std::vector<std::uint32_t>& numbers);

  Tolerances tolerances_;
  std::vector<Known> known_; ///< those of the last frame first, by label
  std::vector<std::uint16_t> labels_;
};

} // namespace pcl_mrf_planes::apps
