// SPDX-License-Identifier: BSD-3-Clause
// The readers of single files. All throw std::runtime_error with what is wrong and what
// to do, without the file's name.
#pragma once

#include <pcl_mrf_planes/io/frame.h>

#include <cstddef>
#include <string>
#include <vector>

namespace pcl_mrf_planes::io {

/** \brief An organized PLY file: rows and columns by obj_info num_cols and num_rows, by
 * the camera that PCL writes, or by \a size. */
CloudFile readPly(const std::string& path, ImageSize size);

/** \brief A depth image in PCL's PCLZF format with the .xml that its grabbers write
 * beside it; the colour image NAME_rgb.pclzf is read where there is one. */
Frame readPclzf(const std::string& path, const ReadOptions& options);

/** \brief A 16-bit PNG or PGM with its camera.
 * \param[in] fallback camera of the data set, when none is given and none is beside it
 * \param[in] colour picture of the same size, or empty */
Frame readDepthImage(const std::string& path, const ReadOptions& options,
                     const CameraModel* fallback, const std::string& colour);

/** \brief ICL-NUIM's depth as text: distances along the rays, metres (POV-Ray). */
Frame readTextDepth(const std::string& path, const ReadOptions& options);

/** \brief A PCD file; the whole numbers of a field "intensity" are its ground truth where
 * \a synpeb. */
Frame readPcd(const std::string& path, const ReadOptions& options, bool synpeb);

/** \brief A range image of SegComp's structured-light scanner, 8 bits, with its ground
 * truth FILE.gt-seg where there is one. */
Frame readAbw(const std::string& path);

/** \brief A range image of SegComp's laser scanner, with its ground truth. */
Frame readPerceptron(const std::string& path);

/** \brief Number of frames of nyu_depth_v2_labeled.mat. */
std::size_t countNyuFrames(const std::string& path);

/** \brief Frame \a index of it. */
Frame readNyuFrame(const std::string& path, std::size_t index,
                   const ReadOptions& options);

/** \brief Whether a PGM with 16 bits is a raw dump of NYU: Kinect's 11-bit disparities
 * with the less significant byte first. */
bool isNyuDump(const std::string& path);

/** \brief The picture, when it can be read and has the size; or none. */
std::vector<Colour> coloursOf(const std::string& path, ImageSize size);

} // namespace pcl_mrf_planes::io
