// SPDX-License-Identifier: BSD-3-Clause
/** \file Viewer: shows clouds segmented into planes, in a window or as pictures. */
#include "app_main.h"
#include "display.h"
#include "viewer_options.h"
#include "viewer_window.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <system_error>

namespace {

using namespace pcl_mrf_planes;
using namespace pcl_mrf_planes::viewer;

constexpr const char* PROGRAM = "pcl_mrf_plane_viewer";

void createFolder(const std::string& folder)
{
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder, error))
    throw std::runtime_error("cannot create the folder '" + folder +
                             "'; name another one for --film");
}

/// A frame that cannot be read has no picture; the numbers are those of the frames.
void writeFilm(Session& session, ViewerWindow& window, const std::string& folder)
{
  createFolder(folder);
  const bool steps = session.settings.film;
  const std::size_t count = steps ? session.film().steps.size() : session.frameCount();
  for (std::size_t k = 0; k < count; ++k) {
    if (steps)
      session.settings.film_step = static_cast<int>(k);
    else if (k > 0 && !session.showFrame(k)) {
      std::cerr << PROGRAM << ": " << session.message() << '\n';
      continue;
    }
    window.draw();
    std::array<char, 32> name{};
    std::snprintf(name.data(), name.size(), "frame_%05zu.png", k);
    window.writePicture((std::filesystem::path(folder) / name.data()).string());
  }
}

void show(const ViewerOptions& options)
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
}

} // namespace

int main(int argc, char* argv[])
{
  return apps::runApp({PROGRAM, "cut the cloud into parts"}, [&] {
    const ViewerOptions options = parseViewerOptions(argc, argv);
    if (options.help)
      std::cout << viewerHelp();
    else if (options.version)
      std::cout << PROGRAM << ' ' << PCL_MRF_PLANES_VERSION << '\n';
    else
      show(options);
    return 0;
  });
}
