// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cli/cli_test.h"

#include <pcl_mrf_planes/io/image.h>

#include <string>
#include <vector>

namespace pcl_mrf_planes::test {

/** \brief A room as a PCD, and the viewer as a process: off-screen, or in a real window of
 * an X server of its own with keys and a mouse from XTest. */
class ViewerTest : public CliTest {
protected:
  /** \brief Write a generated room of 320x240 points. */
  std::string room(const std::string& name, int seed = 0) const;

  /** \brief Write a PCD that ends within its header. */
  std::string brokenFrame(const std::string& name) const;

  /** \brief Run the viewer without a display of its own. */
  Outcome view(const std::vector<std::string>& arguments) const;

  /** \brief Run the viewer in a real window, drive it by xdotool, wait for its end.
   * \param[in] input what it opens \param[in] commands of xdotool, a line each; "q" ends it
   * \return the viewer's outcome; out is its log, a line for every action */
  Outcome drive(const std::string& input, const std::string& commands,
                const std::string& options = {}) const;
};

/** \brief Read a PNG of three channels; empty if it is none. */
io::ColourImage readPicture(const std::string& path);

/** \brief Pixels of a colour. */
std::size_t countColour(const io::ColourImage& picture, const io::Colour& colour);

/** \brief Pixels in which two pictures of one size differ. */
std::size_t countDifferences(const io::ColourImage& a, const io::ColourImage& b);

} // namespace pcl_mrf_planes::test
