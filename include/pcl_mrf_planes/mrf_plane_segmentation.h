// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/export.h>
#include <pcl_mrf_planes/parameters.h>
#include <pcl_mrf_planes/plane_creases.h>
#include <pcl_mrf_planes/plane_projection.h>
#include <pcl_mrf_planes/plane_segmentation.h>
#include <pcl_mrf_planes/plane_uncertainty.h>
#include <pcl_mrf_planes/region_polygons.h>
#include <pcl_mrf_planes/segmentation_stages.h>
#include <pcl_mrf_planes/sensor_pose.h>
#include <pcl_mrf_planes/thread_scope.h>

#include <pcl/ModelCoefficients.h>
#include <pcl/PointIndices.h>
#include <pcl/pcl_base.h>
#include <pcl/pcl_macros.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/segmentation/planar_region.h>

#include <Eigen/Core>
#include <Eigen/StdVector>

#include <cstddef>
#include <vector>

namespace pcl {

/** \brief Segments an organized point cloud into planes by maximum a-posteriori
 * labelling of a Markov random field.
 *
 * Tiles of the image are fitted with planes, similar planes are merged, and every point
 * takes the label of one of them, or none, by loopy belief propagation. Profile PAPER is
 * "Towards Real-Time Segmentation of 3D Point Cloud Data into Local Planar Regions" as it
 * stands; profile DEFAULT, which an object starts with, goes the same way made right for
 * noisy sensors, small planes and scenes that are not all planes. Only geometry is used,
 * never colour.
 *
 * Drop-in beside pcl::OrganizedMultiPlaneSegmentation: same calls of segment(), no
 * normals needed. Differences: indices are honoured as a region of interest (points
 * outside take no part and get no label), outputs are cleared first, and planes come
 * largest area first.
 *
 * The cloud's sensor_origin_ and sensor_orientation_ say where the sensor was; normals
 * point towards it. A cloud in world coordinates should carry them: depth, noise and
 * the offsets that the merging compares are measured from there. If the stated origin
 * cannot be true (a cloud moved far away without it), the pose is found from the cloud
 * itself.
 *
 * Errors (no cloud, not organized, bad indices, bad parameters) are reported through
 * PCL_ERROR and leave all outputs empty; no exception leaves the class.
 *
 * \code
 * pcl::MRFPlaneSegmentation<pcl::PointXYZ> segmentation;
 * segmentation.setInputCloud(cloud);
 * std::vector<pcl::ModelCoefficients> planes;
 * std::vector<pcl::PointIndices> inliers;
 * segmentation.segment(planes, inliers);
 * \endcode
 *
 * \tparam PointT any point type with x, y and z. PCL's XYZ types are compiled into the
 *         library; for your own define PCL_NO_PRECOMPILE before including this header.
 */
template <typename PointT>
class PCL_MRF_PLANES_EXPORT MRFPlaneSegmentation : public PCLBase<PointT> {
public:
  /// Shared pointer to this class, as PCL's classes have it.
  using Ptr = shared_ptr<MRFPlaneSegmentation<PointT>>;
  /// The same to one that is not changed.
  using ConstPtr = shared_ptr<const MRFPlaneSegmentation<PointT>>;

  using typename PCLBase<PointT>::PointCloud;
  using typename PCLBase<PointT>::PointCloudPtr;
  using typename PCLBase<PointT>::PointCloudConstPtr;
  /// A label for each point.
  using PointCloudL = pcl::PointCloud<pcl::Label>;
  /// Shared pointer to one.
  using PointCloudLPtr = PointCloudL::Ptr;

  /// All values that a result depends on.
  using Parameters = pcl_mrf_planes::Parameters;
  /// Named sets of values.
  using Profile = pcl_mrf_planes::Profile;
  /// How a tile's plane is fitted; Method::PAPER.
  using PlaneFit = pcl_mrf_planes::PlaneFit;
  /// Price of two labels side by side; Method::PAPER.
  using Smoothness = pcl_mrf_planes::Smoothness;
  /// What counts as depth.
  using DepthMeasure = pcl_mrf_planes::DepthMeasure;
  /// Noise of the sensor over depth.
  using NoiseModel = pcl_mrf_planes::NoiseModel;
  /// Counts, times and energies of the last run.
  using Report = pcl_mrf_planes::SegmentationReport;
  /// Mean of each plane's points, (x, y, z, 1), metres.
  using Centroids =
      std::vector<Eigen::Vector4f, Eigen::aligned_allocator<Eigen::Vector4f>>;
  /// Covariance of each plane's points, square metres.
  using Covariances =
      std::vector<Eigen::Matrix3f, Eigen::aligned_allocator<Eigen::Matrix3f>>;
  /// PCL's regions: statistics, coefficients and contour.
  using PlanarRegions =
      std::vector<PlanarRegion<PointT>, Eigen::aligned_allocator<PlanarRegion<PointT>>>;

  /// PCL's polygons: contour and coefficients.
  using PlanarPolygons = std::vector<PlanarPolygon<PointT>,
                                     Eigen::aligned_allocator<PlanarPolygon<PointT>>>;
  /// Covariance of the parameters of a plane.
  using PlaneUncertainty = pcl_mrf_planes::PlaneUncertainty;
  /// Patches with their holes, and the convex hull, of a region.
  using RegionOutline = pcl_mrf_planes::RegionOutline;
  /// What outlines leave out.
  using OutlineParameters = pcl_mrf_planes::OutlineParameters;
  /// Where two planes meet.
  using PlaneCrease = pcl_mrf_planes::PlaneCrease;
  /// What counts as a crease.
  using CreaseParameters = pcl_mrf_planes::CreaseParameters;
  /// Which way points move onto their planes.
  using ProjectionWay = pcl_mrf_planes::ProjectionWay;

  MRFPlaneSegmentation() = default;
  ~MRFPlaneSegmentation() override = default;

  /// \name Parameters; units, ranges and effects stand at pcl_mrf_planes::Parameters
  ///@{
  /** \brief All values at once; one out of its range is reported by segment(). */
  void setParameters(const Parameters& parameters) { parameters_ = parameters; }
  /// All values in use.
  const Parameters& getParameters() const { return parameters_; }

  /** \brief Take all the values of a named profile. */
  void setProfile(Profile profile) { parameters_ = Parameters::fromProfile(profile); }

  /** \brief Width and height of a tile in points, section IV-A. */
  void setTileSize(int width, int height)
  {
    parameters_.tile_width = width;
    parameters_.tile_height = height;
  }
  /// Points; see setTileSize().
  int getTileWidth() const { return parameters_.tile_width; }
  /// Points; see setTileSize().
  int getTileHeight() const { return parameters_.tile_height; }

  /** \brief Least-squares fit of a tile's plane, equation (3). */
  void setPlaneFit(PlaneFit fit) { parameters_.fit = fit; }
  /// See setPlaneFit().
  PlaneFit getPlaneFit() const { return parameters_.fit; }

  /** \brief Sensor noise sigma(z) that distances are held against; the default profile
   * estimates it from the cloud unless it is set. */
  void setNoiseModel(const NoiseModel& noise)
  {
    parameters_.noise = noise;
    parameters_.adaptive.estimate_noise = false;
  }
  /// What setNoiseModel() or the profile set; not what was estimated.
  const NoiseModel& getNoiseModel() const { return parameters_.noise; }

  /** \brief How many sigma a tile's root mean square distance may reach. */
  void setNoiseMultiplier(double multiplier)
  {
    parameters_.noise_multiplier = multiplier;
  }
  /// Sigmas; see setNoiseMultiplier().
  double getNoiseMultiplier() const { return parameters_.noise_multiplier; }

  /** \brief Share of a tile's points that must be valid, 0 to 1. */
  void setMinValidShare(double share) { parameters_.min_valid_share = share; }
  /// 0 to 1; see setMinValidShare().
  double getMinValidShare() const { return parameters_.min_valid_share; }

  /** \brief What counts as depth: z of the sensor frame or the range. */
  void setDepthMeasure(DepthMeasure measure) { parameters_.depth_measure = measure; }
  /// As it was set, AUTO if nobody did; see setDepthMeasure().
  DepthMeasure getDepthMeasure() const { return parameters_.depth_measure; }

  /** \brief Weight beta of the offsets' difference in equations (5) and (9), 1/m. */
  void setBeta(double beta) { parameters_.beta = beta; }
  /// 1/m; see setBeta().
  double getBeta() const { return parameters_.beta; }

  /** \brief Similarity threshold v of equation (5). */
  void setMergeThreshold(double threshold) { parameters_.merge_threshold = threshold; }
  /// See setMergeThreshold().
  double getMergeThreshold() const { return parameters_.merge_threshold; }

  /** \brief Most label planes that are kept, the best supported first. */
  void setMaxPlanes(int count) { parameters_.max_planes = count; }
  /// See setMaxPlanes().
  int getMaxPlanes() const { return parameters_.max_planes; }

  /** \brief Weight lambda of the data term, equation (7), 1/m. */
  void setLambda(double lambda) { parameters_.lambda = lambda; }
  /// 1/m; see setLambda().
  double getLambda() const { return parameters_.lambda; }

  /** \brief Distance tau at which the data term (7) is cut off, metres. */
  void setTau(double tau) { parameters_.tau = tau; }
  /// Metres; see setTau().
  double getTau() const { return parameters_.tau; }

  /** \brief Smoothness term: (8), (9), (10) or the variant in the text. */
  void setSmoothness(Smoothness smoothness) { parameters_.smoothness = smoothness; }
  /// See setSmoothness().
  Smoothness getSmoothness() const { return parameters_.smoothness; }

  /** \brief Price gamma of a label change for Smoothness::POTTS, equation (8). */
  void setGamma(double gamma) { parameters_.gamma = gamma; }
  /// See setGamma().
  double getGamma() const { return parameters_.gamma; }

  /** \brief Checkerboard iterations of belief propagation, section IV-D. */
  void setIterations(int iterations) { parameters_.iterations = iterations; }
  /// See setIterations().
  int getIterations() const { return parameters_.iterations; }

  /** \brief Stop once no message changes by more than this; negative: never. */
  void setConvergenceTolerance(double tolerance)
  {
    parameters_.convergence_tolerance = tolerance;
  }
  /// Energy units; see setConvergenceTolerance().
  double getConvergenceTolerance() const { return parameters_.convergence_tolerance; }

  /** \brief Record the energy of every iteration in the report (slower). */
  void setComputeEnergy(bool compute) { parameters_.compute_energy = compute; }
  /// See setComputeEnergy().
  bool getComputeEnergy() const { return parameters_.compute_energy; }

  /** \brief Planes with fewer points than this are dropped. */
  void setMinInliers(int min_inliers) { parameters_.min_inliers = min_inliers; }
  /// Points; see setMinInliers().
  int getMinInliers() const { return parameters_.min_inliers; }

  /** \brief Planes with a smaller area than this, in square metres, are dropped. */
  void setMinArea(double square_metres) { parameters_.min_area = square_metres; }
  /// Square metres; see setMinArea().
  double getMinArea() const { return parameters_.min_area; }

  /** \brief Default profile: whether coplanar parts that do not touch share a label. */
  void setJoinCoplanar(bool join) { parameters_.adaptive.join_coplanar = join; }
  /// See setJoinCoplanar().
  bool getJoinCoplanar() const { return parameters_.adaptive.join_coplanar; }

  /** \brief Threads to use; 0: as many as the machine has cores. */
  void setNumberOfThreads(unsigned int threads = 0)
  {
    parameters_.number_of_threads = threads;
  }
  /// As it was set, 0 for all cores; see setNumberOfThreads().
  unsigned int getNumberOfThreads() const { return parameters_.number_of_threads; }

  /** \brief Move the contours of planar regions onto their planes. */
  void setProjectPoints(bool project) { project_points_ = project; }
  /// See setProjectPoints().
  bool getProjectPoints() const { return project_points_; }

  /** \brief Whether the connected patches of a plane are regions of their own, with the
   * same coefficients; min_inliers and min_area then hold for patches. */
  void setSeparatePatches(bool separate) { separate_patches_ = separate; }
  /// See setSeparatePatches().
  bool getSeparatePatches() const { return separate_patches_; }

  /** \brief Whether the contours of planar regions are corners of polygons, simplified to
   * the tolerance of the outlines, on the plane, in place of all points of the border. */
  void setSimplifyContours(bool simplify) { simplify_contours_ = simplify; }
  /// See setSimplifyContours().
  bool getSimplifyContours() const { return simplify_contours_; }

  /** \brief Tolerance of outlines, and what they leave out. */
  void setOutlineParameters(const OutlineParameters& outline) { outline_ = outline; }
  /// See setOutlineParameters().
  const OutlineParameters& getOutlineParameters() const { return outline_; }

  /** \brief What counts as a crease. */
  void setCreaseParameters(const CreaseParameters& crease) { crease_ = crease; }
  /// See setCreaseParameters().
  const CreaseParameters& getCreaseParameters() const { return crease_; }
  ///@}

  /** \brief Segment all planes of the input cloud.
   * \param[out] model_coefficients a, b, c, d of each plane in the frame of the cloud,
   *             largest area first, normals of unit length towards the sensor
   * \param[out] inlier_indices the points of each plane, ascending
   */
  void segment(std::vector<ModelCoefficients>& model_coefficients,
               std::vector<PointIndices>& inlier_indices);

  /** \brief Segment all planes of the input cloud.
   * \param[out] model_coefficients, inlier_indices as above
   * \param[out] centroids mean of each plane's points (x, y, z, 1), metres
   * \param[out] covariances covariance of each plane's points, square metres
   * \param[out] labels a label for each point of the cloud: 0 no plane, k the plane
   *             model_coefficients[k - 1]
   * \param[out] label_indices the points of each label; entry 0 is empty, as "no plane"
   *             is no region
   */
  void segment(std::vector<ModelCoefficients>& model_coefficients,
               std::vector<PointIndices>& inlier_indices, Centroids& centroids,
               Covariances& covariances, PointCloudL& labels,
               std::vector<PointIndices>& label_indices);

  /** \brief Segment all planes of the input cloud.
   * \param[out] regions for each plane its statistics, coefficients and the outer
   * contour of its largest connected part; see setSimplifyContours()
   */
  void segment(PlanarRegions& regions);

  /** \brief The same as segment(regions): labels by MAP inference are refined already.
   */
  void segmentAndRefine(PlanarRegions& regions) { segment(regions); }

  /** \brief Everything at once, in the shape of
   * pcl::OrganizedMultiPlaneSegmentation::segmentAndRefine().
   * \param[out] regions, model_coefficients, inlier_indices, labels, label_indices as
   *             in the calls above; a null \a labels is allocated
   * \param[out] boundary_indices the contour of each region as point indices
   */
  void segmentAndRefine(PlanarRegions& regions,
                        std::vector<ModelCoefficients>& model_coefficients,
                        std::vector<PointIndices>& inlier_indices,
                        PointCloudLPtr& labels,
                        std::vector<PointIndices>& label_indices,
                        std::vector<PointIndices>& boundary_indices);

  /** \brief Counts, energies and times of the last run. */
  const Report& getReport() const { return result_.report; }

  /** \brief The last run in the sensor frame: the image of planar fits, the
   * tile-to-plane map, regions with areas, and the label image. */
  const pcl_mrf_planes::PlaneSegmentation& getResult() const { return result_; }

  /// \name What follows from the last run, computed when it is asked for
  /// In the frame of the cloud, outputs cleared first, region k at place k. The cloud must
  /// be the one that was segmented.
  ///@{

  /** \brief Covariance and bias of the parameters of each region's plane. O(points) */
  void computeUncertainties(std::vector<PlaneUncertainty>& uncertainties) const;

  /** \brief Patches of each region as polygons with holes, and its convex hull. */
  void computeOutlines(std::vector<RegionOutline>& outlines) const;

  /** \brief The same without the holes, in the type of PCL.
   * \param[out] polygons of all patches, by region
   * \param[out] region_of_polygon indices of the regions */
  void computePolygons(PlanarPolygons& polygons,
                       std::vector<std::size_t>& region_of_polygon) const;

  /** \brief Convex hull of each region in the type of PCL. */
  void computeHulls(PlanarPolygons& hulls) const;

  /** \brief Pieces of lines along which two regions meet. */
  void computeCreases(std::vector<PlaneCrease>& creases) const;

  /** \brief Confidence of the label of every point, 0 to 1, 0 for invalid points. */
  void computeConfidence(std::vector<float>& confidence) const;

  /** \brief How the result came about: tiles, merged planes, the labels after every stage
   * with the energy of each iteration; see pcl_mrf_planes::recordStages(). Segments the
   * cloud anew, as often as there are iterations.
   * \param[out] stages planes are in the frame of the sensor; patches are not separated */
  void computeStages(pcl_mrf_planes::SegmentationStages& stages) const;

  /** \brief The cloud with the points of planes moved onto them; the others, and all other
   * fields, stay as they are. O(points) */
  void projectOntoPlanes(PointCloud& output,
                         ProjectionWay way = ProjectionWay::NORMAL) const;

  /** \brief Points that lie on some plane and measured points that lie on none, ascending,
   * for pcl::ExtractIndices and setIndices() of other classes. O(points) */
  void extractIndices(PointIndices& on_planes, PointIndices& rest) const;
  ///@}

protected:
  using PCLBase<PointT>::input_;
  using PCLBase<PointT>::indices_;
  using PCLBase<PointT>::fake_indices_;
  using PCLBase<PointT>::initCompute;
  using PCLBase<PointT>::deinitCompute;

  /** \brief Class name for messages. */
  virtual const char* getClassName() const { return "MRFPlaneSegmentation"; }

private:
  using SensorPose = pcl_mrf_planes::SensorPose;
  using Threads = pcl_mrf_planes::ThreadScope;

  /// Runs fill(threads) on a good result; reports what went wrong otherwise.
  /// \return whether there is a result
  template <typename Fill>
  bool run(const Fill& fill);
  template <typename Fill>
  bool tryToSegment(const Fill& fill);

  bool checkInput() const;
  SensorPose statedPose() const;
  /// Looks at some points, about \a most, and the pixels that they are at.
  void sightPoints(std::size_t most);
  void findPose();
  void readPoints();
  void copyPoints(int width, int height);
  void limitToIndices();
  void fillModels(const Threads& threads,
                  std::vector<ModelCoefficients>& model_coefficients,
                  std::vector<PointIndices>& inlier_indices);
  void fillLabels(const Threads& threads, PointCloudL& labels,
                  std::vector<PointIndices>& label_indices);
  /// What there is too much of goes to \a spare, with its memory, and comes back from there.
  template <typename Output>
  static void resizeOutput(std::vector<Output>& output, std::size_t size,
                           std::vector<Output>& spare);
  void fillRegions(PlanarRegions& regions, std::vector<PointIndices>& boundaries) const;
  std::vector<PointIndices> contours() const;
  Eigen::Vector4d coefficients(const pcl_mrf_planes::Plane& plane) const;

  /// Runs \a work on the last result; reports what went wrong otherwise.
  template <typename Work>
  void analyse(const char* name, const Work& work) const;

  void separatePatches();
  const std::vector<pcl_mrf_planes::PlaneRegion>& wholeRegions() const;
  std::size_t wholeRegion(std::size_t region) const;
  std::vector<RegionOutline> outlines() const;
  typename PointCloud::VectorType
  toContour(const pcl_mrf_planes::PlaneRing& ring) const;
  /// Moves points of the cloud onto a plane with the sensor as its origin.
  void projectPoints(const pcl_mrf_planes::Plane& plane,
                     const std::vector<int>& indices, ProjectionWay way,
                     PointCloud& cloud) const;
  PlanarPolygon<PointT> toPolygon(const pcl_mrf_planes::PlaneRing& ring,
                                  std::size_t region) const;

  Parameters parameters_;
  bool project_points_ = false;
  bool separate_patches_ = false;
  bool simplify_contours_ = false;
  OutlineParameters outline_;
  CreaseParameters crease_;
  /// Regions before their patches were told apart; empty if they were not.
  std::vector<pcl_mrf_planes::PlaneRegion> wholes_;
  SensorPose pose_; ///< of the last run
  pcl_mrf_planes::OrganizedPoints points_;
  pcl_mrf_planes::PlaneSegmenter segmenter_;
  pcl_mrf_planes::PlaneSegmentation result_;
  // Memory that is used again for the next cloud.
  std::vector<pcl_mrf_planes::Sighting> sightings_;
  std::vector<std::uint8_t> inside_;
  std::vector<ModelCoefficients> spare_coefficients_;
  std::vector<PointIndices> spare_inliers_;
  std::vector<PointIndices> spare_label_indices_;
};

} // namespace pcl

#ifdef PCL_NO_PRECOMPILE
#include <pcl_mrf_planes/impl/mrf_plane_segmentation.hpp>
#endif
