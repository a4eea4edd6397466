// SPDX-License-Identifier: BSD-3-Clause
#include "viewer_test.h"

#include <png.h>

#include <algorithm>
#include <cstring>

namespace pcl_mrf_planes::test {

std::string ViewerTest::room(const std::string& name, int seed) const
{
  const std::string file = path(name);
  const Outcome made =
      run(PCL_MRF_PLANES_SCENE_APP, {file, "--seed", std::to_string(seed), "--noise",
                                     "1", "--width", "320", "--height", "240"});
  EXPECT_EQ(made.status, 0) << made.err;
  return file;
}

std::string ViewerTest::brokenFrame(const std::string& name) const
{
  write(name, "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\n");
  return path(name);
}

Outcome ViewerTest::view(const std::vector<std::string>& arguments) const
{
  std::vector<std::string> words = {"-u", "DISPLAY", PCL_MRF_PLANES_VIEWER_APP};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return run("/usr/bin/env", words);
}

Outcome ViewerTest::drive(const std::string& input, const std::string& commands,
                          const std::string& options) const
{
  // No window manager: the window lies at the upper left, keys go to it once the pointer
  // is over it. xdotool speaks to the server as a keyboard and a mouse would (XTest).
  // -r: on a machine under load a key would come up late enough to repeat itself.
  const std::string script = path("drive.sh");
  // Its first line of log says that it takes keys.
  write("drive.sh",
        "cd '" + path("") + "'\n" + "timeout 60 '" PCL_MRF_PLANES_VIEWER_APP "' '" +
            input + "' --log --window 1000x700 " + options +
            " >log 2>errors &\n"
            "viewer=$!\n"
            "while kill -0 $viewer 2>/dev/null && ! [ -s log ]; do\n"
            "  sleep 0.02\n"
            "done\n"
            "window=$(timeout 30 xdotool search --sync --onlyvisible --name "
            "pcl_mrf_plane_viewer 2>/dev/null | head -n 1)\n"
            "xdotool mousemove 500 350\n" +
            commands +
            "\nwait $viewer\nstatus=$?\ncat log\ncat errors >&2\n"
            "exit $status\n");
  return run("/usr/bin/env", {"-u", "DISPLAY", "xvfb-run", "-a", "-s",
                              "-noreset -r -screen 0 1280x1024x24", "sh", script});
}

io::ColourImage readPicture(const std::string& path)
{
  png_image png;
  std::memset(&png, 0, sizeof(png));
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&png, path.c_str()) == 0)
    return {};
  png.format = PNG_FORMAT_RGB;
  io::ColourImage picture(static_cast<int>(png.width), static_cast<int>(png.height));
  png_image_finish_read(&png, nullptr, picture.pixels.data(), 0, nullptr);
  return picture;
}

std::size_t countColour(const io::ColourImage& picture, const io::Colour& colour)
{
  return static_cast<std::size_t>(
      std::count(picture.pixels.begin(), picture.pixels.end(), colour));
}

std::size_t countDifferences(const io::ColourImage& a, const io::ColourImage& b)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < std::min(a.pixels.size(), b.pixels.size()); ++i)
    count += a.pixels[i] != b.pixels[i];
  return count;
}

} // namespace pcl_mrf_planes::test
