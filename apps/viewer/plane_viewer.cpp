// SPDX-License-Identifier: BSD-3-Clause
/** \file Viewer: shows clouds segmented into planes, in a window or as pictures. */
#include "display.h"
#include "option_values.h"
#include "viewer_options.h"
#include "viewer_window.h"

#include <pcl/console/print.h>

#include <array>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <stdexcept>

namespace {

using namespace pcl_mrf_planes;
using namespace pcl_mrf_planes::viewer;

constexpr const char* PROGRAM = "pcl_mrf_plane_viewer";
constexpr int FAILURE = 1;
constexpr int WRONG_USAGE = 2;

void writeFilm(Session& session, ViewerWindow& window, const std::string& folder)
{
  std::filesystem::create_directories(folder);
  const bool steps = session.settings.film;
  const std::size_t count = steps ? session.film().steps.size() : session.frameCount();
  for (std::size_t k = 0; k < count; ++k) {
    if (steps)
      session.settings.film_step = static_cast<int>(k);
    else if (k > 0 && !session.showFrame(k))
      std::cerr << PROGRAM << ": " << session.message() << '\n';
    window.draw();
    std::array<char, 32> name{};
    std::snprintf(name.data(), name.size(), "frame_%05zu.png", k);
    window.writePicture((std::filesystem::path(folder) / name.data()).string());
  }
}

int show(const ViewerOptions& options)
{
  io::FrameList list = io::listFrames(options.inputs, options.read);
  Session session(std::move(list.frames), options.parameters, options.profile);
  session.setParameterFile(options.parameter_file);
  VirtualDisplay virtual_display; // outlives the window
  if (!hasDisplay() && !(options.window.off_screen && virtual_display.start()))
    throw std::runtime_error("there is no X display; set DISPLAY, or install xvfb and "
                             "give --screenshot FILE.png or --film FOLDER");
  ViewerWindow window(session, options.window);
  for (const std::string& key : options.keys)
    window.press(key);
  if (!options.screenshot.empty())
    window.writePicture(options.screenshot);
  if (!options.film.empty())
    writeFilm(session, window, options.film);
  if (!options.window.off_screen)
    window.run();
  return 0;
}

} // namespace

int main(int argc, char* argv[])
{
  // What PCL would print is said by the messages below, with what to do about it.
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  try {
    const ViewerOptions options = parseViewerOptions(argc, argv);
    if (options.help)
      std::cout << viewerHelp();
    else if (options.version)
      std::cout << PROGRAM << ' ' << PCL_MRF_PLANES_VERSION << '\n';
    else
      return show(options);
    return 0;
  }
  catch (const apps::UsageError& error) {
    std::cerr << PROGRAM << ": " << error.what() << '\n';
    return WRONG_USAGE;
  }
  catch (const std::bad_alloc&) {
    std::cerr << PROGRAM << ": not enough memory; cut the cloud into parts\n";
  }
  catch (const std::exception& error) {
    std::cerr << PROGRAM << ": " << error.what() << '\n';
  }
  return FAILURE;
}
