// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "session.h"
#include "viewer_test.h"

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
};

} // namespace pcl_mrf_planes::test
