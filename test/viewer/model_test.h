// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "session.h"
#include "viewer_test.h"

#include <pcl_mrf_planes/mrf_plane_segmentation.h>

#include <string>
#include <vector>

namespace pcl_mrf_planes::test {

/** \brief What is seen, without a window. */
class ModelTest : public ViewerTest {
protected:
  static viewer::Session open(const std::vector<std::string>& inputs,
                              Profile profile = Profile::DEFAULT)
  {
    return viewer::Session(io::listFrames(inputs, {}).frames,
                           Parameters::fromProfile(profile), profile);
  }

  /// Of the planes of a session's frame in profile DEFAULT, by the class itself.
  static std::vector<PlaneUncertainty> uncertaintiesOf(const viewer::Session& session)
  {
    pcl::MRFPlaneSegmentation<pcl::PointXYZ> segmentation;
    segmentation.setInputCloud(session.frame().cloud);
    std::vector<pcl::ModelCoefficients> models;
    std::vector<pcl::PointIndices> inliers;
    segmentation.segment(models, inliers);
    std::vector<PlaneUncertainty> uncertainties;
    segmentation.computeUncertainties(uncertainties);
    return uncertainties;
  }
};

} // namespace pcl_mrf_planes::test
