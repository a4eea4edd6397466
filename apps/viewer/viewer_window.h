// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "session.h"

#include <memory>
#include <string>

namespace pcl_mrf_planes::viewer {

/** \brief How the window is made. */
struct WindowOptions {
  int width = 1280; ///< pixels
  int height = 800;
  bool off_screen = false;
  bool log = false;              ///< print what is seen after every action
  std::string pictures = "view"; ///< what the key for pictures writes: view_1.png, ...
};

/** \brief The window of a session: draws it, and turns keys and clicks into actions. */
class ViewerWindow {
public:
  ViewerWindow(Session& session, const WindowOptions& options);
  ~ViewerWindow();

  /** \brief Do what a key does, and draw. \return false for a key without an action */
  bool press(const std::string& key);

  /** \brief Draw what the session has now. */
  void draw();

  /** \brief Write what is drawn as a PNG, whole or not at all.
   * \throws std::runtime_error with what is wrong and what to do */
  void writePicture(const std::string& path);

  /** \brief Handle the user until the window is closed. */
  void run();

private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

} // namespace pcl_mrf_planes::viewer
