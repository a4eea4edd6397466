// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/export.h>
#include <pcl_mrf_planes/organized_points.h>
#include <pcl_mrf_planes/parameters.h>
#include <pcl_mrf_planes/plane_clustering.h>
#include <pcl_mrf_planes/plane_field.h>
#include <pcl_mrf_planes/plane_regions.h>
#include <pcl_mrf_planes/tile_plane_detection.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace pcl_mrf_planes {

/** \brief What a run did: counts, energies and times. */
struct PCL_MRF_PLANES_EXPORT SegmentationReport {
  std::size_t points = 0;       ///< points of the image
  std::size_t valid_points = 0; ///< measured points inside the region of interest
  std::size_t tiles_tried = 0;  ///< tiles of the image, of all sizes
  std::size_t tiles_kept = 0;   ///< those whose plane went on to the merging
  std::size_t planes_after_merging = 0; ///< L, the number of labels
  std::size_t planes = 0;               ///< planes that won points
  int iterations = 0;                   ///< belief propagation iterations done
  double labelled_share = 0.0;          ///< of the valid points, 0 to 1
  /// Energy of the initial labels and after each iteration (parameters.compute_energy).
  std::vector<FieldEnergy> energy;
  /// Milliseconds of each stage in order: tiles, merging, field, propagation, regions,
  /// and in Method::ADAPTIVE sampling, cells and refinement where they are;
  /// MRFPlaneSegmentation puts its own "points" in front.
  std::vector<std::pair<std::string, double>> stage_ms;

  /// Milliseconds of all stages together.
  double totalMs() const;

  /** \brief Fill in what follows from the points and the regions.
   * \param[in] organized_points, regions what was segmented, and the result
   * \param[in] threads 0: as many as there are cores */
  void count(const OrganizedPoints& organized_points,
             const std::vector<PlaneRegion>& regions, unsigned int threads = 1);
};

namespace adaptive {
struct BlockNoise;
} // namespace adaptive
struct SegmenterMemory;

/** \brief Result of a run, in the sensor frame. */
struct PCL_MRF_PLANES_EXPORT PlaneSegmentation {
  std::vector<PlaneRegion> regions;  ///< largest area first
  std::vector<std::uint16_t> labels; ///< per point: 0 no plane, k regions[k - 1]
  TileImage tiles;                   ///< the image of planar fits
  PlaneClusters clusters;            ///< label planes and the tile-to-plane map
  SegmentationReport report;         ///< counts, times, energies
  /// What labelConfidence() need not find anew; may be null.
  std::shared_ptr<const adaptive::BlockNoise> block_noise;
};

/** \brief Segment organized points into planes by the method that the parameters name.
 * \param[in] points the cloud in the sensor frame
 * \param[in] parameters must pass Parameters::validate()
 */
PCL_MRF_PLANES_EXPORT PlaneSegmentation segmentPlanes(const OrganizedPoints& points,
                                                      const Parameters& parameters);

/** \brief Segments one cloud after the other as segmentPlanes() does each, in memory that it
 * keeps in between: some 15 MB for 640x480 points.
 *
 * A copy has memory of its own. An object is for one thread at a time. */
class PCL_MRF_PLANES_EXPORT PlaneSegmenter {
public:
  /** \brief Without memory yet. */
  PlaneSegmenter();
  /** \brief Without memory yet: there is nothing else to copy. */
  PlaneSegmenter(const PlaneSegmenter& other);
  /** \brief With the memory of the other. */
  PlaneSegmenter(PlaneSegmenter&& other) noexcept;
  /** \brief Changes nothing: each keeps its memory. */
  PlaneSegmenter& operator=(const PlaneSegmenter& other);
  /** \brief Takes the memory of the other. */
  PlaneSegmenter& operator=(PlaneSegmenter&& other) noexcept;
  ~PlaneSegmenter();

  /** \brief The same as segmentPlanes().
   * \param[in] points the cloud in the sensor frame
   * \param[in] parameters must pass Parameters::validate()
   * \param[in,out] result is replaced; the memory of the one before is used again */
  void segment(const OrganizedPoints& points, const Parameters& parameters,
               PlaneSegmentation& result);

private:
  std::unique_ptr<SegmenterMemory> memory_; ///< null until it is needed
};

/** \brief Method::PAPER: section IV of the paper in one function.
 * \param[in] points the cloud in the sensor frame
 * \param[in] parameters must pass Parameters::validate()
 */
PCL_MRF_PLANES_EXPORT PlaneSegmentation segmentAsInPaper(const OrganizedPoints& points,
                                                         const Parameters& parameters);

/** \brief Method::ADAPTIVE: tiles of several sizes kept by the noise that the cloud shows,
 * merging on pooled sums, a random field in which a plane competes only where it has
 * support and "no plane" is a label, and a refit.
 *
 * The result has no image of planar fits and no tile-to-plane map.
 * \param[in] points the cloud in the sensor frame
 * \param[in] parameters must pass Parameters::validate()
 */
PCL_MRF_PLANES_EXPORT PlaneSegmentation segmentAdaptively(const OrganizedPoints& points,
                                                          const Parameters& parameters);

} // namespace pcl_mrf_planes
