// SPDX-License-Identifier: BSD-3-Clause
#include "display.h"

#include <X11/Xlib.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

namespace pcl_mrf_planes::viewer {

namespace {

/// The child's part: the server writes the number that it chose into the pipe.
[[noreturn]] void becomeServer(int number_pipe)
{
  prctl(PR_SET_PDEATHSIG, SIGTERM); // it must not outlive a program that was killed
  const int nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  const std::string pipe_name = std::to_string(number_pipe);
  // Without -noreset it starts anew whenever its last client leaves, as the one does that
  // asks whether it answers; who comes meanwhile is turned away.
  execlp("Xvfb", "Xvfb", "-displayfd", pipe_name.c_str(), "-screen", "0",
         "1280x1024x24", "-nolisten", "tcp", "-noreset", static_cast<char*>(nullptr));
  _exit(127);
}

/// Up to the end of the line, which comes when the server is ready; empty if it ended.
std::string readLine(int pipe)
{
  std::string line;
  for (char c = 0; read(pipe, &c, 1) == 1;) {
    if (c == '\n')
      return line;
    line += c;
  }
  return {};
}

} // namespace

bool hasDisplay()
{
  Display* display = XOpenDisplay(nullptr);
  if (display == nullptr)
    return false;
  XCloseDisplay(display);
  return true;
}

// The server chooses the number itself: two that start at once cannot choose the same, as
// those of xvfb-run -a can.
bool VirtualDisplay::start()
{
  int ends[2];
  if (pipe(ends) != 0)
    return false;
  server_ = fork();
  if (server_ == 0) {
    close(ends[0]);
    becomeServer(ends[1]);
  }
  close(ends[1]);
  const std::string number = server_ > 0 ? readLine(ends[0]) : "";
  close(ends[0]);
  if (number.empty())
    return false;
  setenv("DISPLAY", (":" + number).c_str(), 1);
  return hasDisplay();
}

VirtualDisplay::~VirtualDisplay()
{
  if (server_ <= 0)
    return;
  kill(server_, SIGTERM);
  waitpid(server_, nullptr, 0);
}

} // namespace pcl_mrf_planes::viewer
