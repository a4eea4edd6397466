// SPDX-License-Identifier: BSD-3-Clause
#include "display.h"

#include <X11/Xlib.h>
#include <unistd.h>

#include <cstdlib>
#include <string>
#include <vector>

namespace pcl_mrf_planes::viewer {

bool hasDisplay()
{
  Display* display = XOpenDisplay(nullptr);
  if (display == nullptr)
    return false;
  XCloseDisplay(display);
  return true;
}

void restartUnderXvfb(char* argv[])
{
  constexpr const char* MARK = "PCL_MRF_PLANES_VIEWER_XVFB";
  if (std::getenv(MARK) != nullptr) // it was tried, and its display does not answer
    return;
  setenv(MARK, "1", 1);
  std::string server = "-screen 0 1280x1024x24";
  std::string self = "/proc/self/exe";
  char resolved[4096];
  const ssize_t length = readlink(self.c_str(), resolved, sizeof(resolved) - 1);
  self = length > 0 ? std::string(resolved, static_cast<std::size_t>(length)) : argv[0];
  std::string run = "xvfb-run", any = "-a", with = "-s";
  std::vector<char*> words = {run.data(), any.data(), with.data(), server.data(),
                              self.data()};
  for (char** word = argv + 1; *word != nullptr; ++word)
    words.push_back(*word);
  words.push_back(nullptr);
  execvp("xvfb-run", words.data());
}

} // namespace pcl_mrf_planes::viewer
