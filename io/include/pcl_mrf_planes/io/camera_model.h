// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/export.h>
#include <pcl_mrf_planes/io/cloud_file.h>
#include <pcl_mrf_planes/io/image.h>

#include <cstdint>
#include <string>
#include <vector>

namespace pcl_mrf_planes::io {

/** \brief A pinhole camera, and what its depth values mean.
 *
 * Column u, row v and depth z metres are the point
 * ((u - cx) z / fx, (v - cy) z / fy, z): x right, y down, z forward.
 */
struct PCL_MRF_PLANES_EXPORT CameraModel {
  double fx = 0.0; ///< focal length across, points
  double fy = 0.0; ///< focal length down, points
  double cx = 0.0; ///< principal point, columns from the centre of the first point
  double cy = 0.0; ///< the same in rows
  double depth_scale = 1000.0; ///< values per metre
  /// Where both are set, values are Kinect's disparities: metres = a / (b - value).
  double disparity_a = 0.0;
  double disparity_b = 0.0;                 ///< disparity at infinity
  std::vector<std::uint16_t> invalid = {0}; ///< values that mean "not measured"
  bool along_ray = false; ///< depth is the distance to the point, not its z
  ImageSize size;         ///< of the image that it was calibrated for; none: any
  bool scalable = false;  ///< nominal values: fits other sizes of the same shape, too
  std::string source;     ///< where the numbers are from, for messages and reports
};

/** \brief Names that cameraPreset() knows. */
PCL_MRF_PLANES_EXPORT std::vector<std::string> cameraPresetNames();

/** \brief Camera of a sensor or of a data set by its published values.
 * \throws std::runtime_error for an unknown name, with the known ones */
PCL_MRF_PLANES_EXPORT CameraModel cameraPreset(const std::string& name);

/** \brief Camera from an option: a preset's name, the name of a file, or
 * fx,fy,cx,cy[,depth_scale].
 * \throws std::runtime_error with what is wrong and what to do */
PCL_MRF_PLANES_EXPORT CameraModel parseCamera(const std::string& text);

/** \brief Camera from a JSON or YAML file.
 *
 * Understood are fx fy cx cy [depth_scale width height invalid], ROS's camera_info
 * (camera_matrix or K), Open3D's (intrinsic_matrix, column by column) and ORB-SLAM's
 * (Camera.fx ..., DepthMapFactor).
 *
 * \throws std::runtime_error with the file's name, what is wrong and what to do */
PCL_MRF_PLANES_EXPORT CameraModel readCameraFile(const std::string& path);

/** \brief The camera's file beside an image: NAME.camera.json for NAME.depth.png or
 * NAME.png, else camera.json, each also as .yaml and .yml; empty: there is none. */
PCL_MRF_PLANES_EXPORT std::string findCameraFile(const std::string& image);

/** \brief The camera for an image of a size; nominal ones are scaled to it.
 * \throws std::runtime_error when it cannot be this image's camera, with what to do */
PCL_MRF_PLANES_EXPORT CameraModel fittedTo(const CameraModel& camera, ImageSize size);

/** \brief Metres from the values of a sensor; NaN for those that are not measured. */
PCL_MRF_PLANES_EXPORT DepthMap toMetres(const Image16& values,
                                        const CameraModel& camera);

/** \brief The organized cloud x, y, z that a camera sees; invalid points are NaN.
 * \param[in] depth metres, NaN where nothing was measured
 * \param[in] camera fitted to the map */
PCL_MRF_PLANES_EXPORT CloudFile cloudFromDepth(const DepthMap& depth,
                                               const CameraModel& camera);

} // namespace pcl_mrf_planes::io
