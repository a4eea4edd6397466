// SPDX-License-Identifier: BSD-3-Clause
#include "input_options.h"

#include "command_line.h"
#include "option_values.h"

#include <stdexcept>
#include <string>

namespace pcl_mrf_planes::apps {

namespace po = boost::program_options;

namespace {

constexpr int MOST_COLUMNS = 1 << 20;

io::ImageSize parseSize(const std::string& text)
{
  const std::size_t cross = text.find('x');
  if (cross == std::string::npos)
    throw UsageError("--size is '" + text + "'; give columns and rows, as 640x480");
  return {parseInteger("size", text.substr(0, cross), 2, MOST_COLUMNS),
          parseInteger("size", text.substr(cross + 1), 2, MOST_COLUMNS)};
}

} // namespace

po::options_description inputOptions()
{
  po::options_description inputs("Inputs");
  inputs.add_options() //
      ("camera", text("CAMERA"),
       ("camera of depth images: a file (JSON, YAML), fx,fy,cx,cy,values-per-metre, or "
        "one of " +
        join(io::cameraPresetNames()) +
        " (default: a camera.json beside the image, or "
        "that of its data set)")
           .c_str()) //
      ("size", text("COLUMNSxROWS"),
       "size of a cloud whose points are all there, row by row, in a file that does "
       "not "
       "say so") //
      ("wrap", po::bool_switch(),
       "the last column of a scan is the neighbour of its first: a lidar's full "
       "turn") //
      ("filled-depth", po::bool_switch(),
       "of the labeled set of NYU Depth V2 take the depth whose holes were filled");
  return inputs;
}

io::ReadOptions readInputOptions(const po::variables_map& values)
{
  io::ReadOptions options;
  const std::string camera = given(values, "camera");
  if (!camera.empty()) {
    try {
      options.camera = io::parseCamera(camera);
    }
    catch (const std::runtime_error& error) {
      throw UsageError(std::string("--camera: ") + error.what());
    }
  }
  const std::string size = given(values, "size");
  if (!size.empty())
    options.size = parseSize(size);
  options.filled_depth = values["filled-depth"].as<bool>();
  return options;
}

} // namespace pcl_mrf_planes::apps
