// SPDX-License-Identifier: BSD-3-Clause
/** \file Command line: writes a picture of a made-up scene with its ground truth. */
#include "app_main.h"
#include "option_values.h"
#include "output_file.h"

#include "scenes/render.h"
#include "scenes/scene_library.h"

#include <pcl/io/pcd_io.h>
#include <pcl/io/png_io.h>
#include <pcl/point_types.h>

#include <boost/program_options.hpp>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

namespace {

namespace po = boost::program_options;
namespace apps = pcl_mrf_planes::apps;
namespace scenes = pcl_mrf_planes::scenes;
using apps::checkWritable;
using apps::UsageError;
using apps::writeAtomically;

constexpr const char* PROGRAM = "pcl_mrf_plane_scene";
constexpr double GAUSSIAN_UNIT = 0.01; // metres: what --noise 1 means
constexpr int LARGEST_SIDE = 8192;     // pixels

struct Options {
  bool help = false;
  std::string output, truth, planes;
  std::string scene = "room", sensor = "camera", noise_model, format;
  std::string seed, width, height, noise;
};

std::string sceneList()
{
  std::string list;
  for (const std::string& name : scenes::sceneNames())
    list += (list.empty() ? "" : ", ") + name;
  return list;
}

po::options_description describe(Options& o)
{
  po::options_description all("Options");
  auto add = all.add_options();
  add("help,h", po::bool_switch(&o.help), "print this and exit");
  add("scene", po::value(&o.scene)->default_value("room"), sceneList().c_str());
  add("truth", po::value(&o.truth),
      "write the labels as a 16-bit PNG: 0 no plane, k plane k");
  add("planes", po::value(&o.planes), "write the exact planes and the camera as JSON");
  add("seed", po::value(&o.seed)->default_value("0"),
      "whole number >= 0: another room, other noise");
  add("width", po::value(&o.width), "columns, 1 to 8192 (camera 640, lidar 1024)");
  add("height", po::value(&o.height), "rows, 1 to 8192 (camera 480, lidar 64)");
  add("noise", po::value(&o.noise)->default_value("1"),
      "factor >= 0; 1: kinect as a real Kinect v1 (1.4 mm at 1 m, growing with the "
      "square of the depth), gaussian 10 mm along the ray");
  add("noise-model", po::value(&o.noise_model),
      "none, gaussian, kinect (camera kinect, lidar gaussian)");
  add("sensor", po::value(&o.sensor)->default_value("camera"),
      "camera (x right, y down, z forward) or lidar (x forward, z up)");
  add("format", po::value(&o.format)->default_value("binary_compressed"),
      "of the PCD file: binary_compressed, binary, ascii");
  return all;
}

Options parseOptions(int argc, char* argv[])
{
  Options options;
  po::options_description all = describe(options);
  all.add_options()("output", po::value(&options.output));
  po::positional_options_description positional;
  positional.add("output", 1);
  namespace style = po::command_line_style;
  try {
    po::variables_map values;
    po::store(po::command_line_parser(argc, argv)
                  .options(all)
                  .positional(positional)
                  .style(style::default_style & ~style::allow_guessing)
                  .run(),
              values);
    po::notify(values);
  }
  catch (const po::error& error) {
    throw UsageError(std::string(error.what()) + "; --help lists the options");
  }
  if (!options.help && options.output.empty())
    throw UsageError("name the PCD file to write; --help lists the options");
  return options;
}

/// Number from text whatever the locale; the whole text must be used.
template <typename Number>
Number parse(const char* option, const std::string& text, Number low, Number high)
{
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  Number value{};
  const bool negative = !text.empty() && text[0] == '-'; // unsigned types would wrap
  if (negative || !(stream >> value) || !stream.eof() ||
      !(value >= low && value <= high)) {
    std::ostringstream message;
    message.imbue(std::locale::classic());
    message << "--" << option << " is \"" << text << "\"; give a number from " << low
            << " to " << high;
    throw UsageError(message.str());
  }
  return value;
}

int parseSide(const char* option, const std::string& text, int otherwise)
{
  return text.empty() ? otherwise : parse<int>(option, text, 1, LARGEST_SIDE);
}

scenes::SensorNoise parseNoise(const Options& options, bool lidar)
{
  const double factor = parse<double>("noise", options.noise, 0.0, 1000.0);
  const std::string model = !options.noise_model.empty() ? options.noise_model
                            : lidar                      ? "gaussian"
                                                         : "kinect";
  if (model == "none")
    return scenes::SensorNoise::none();
  if (model == "gaussian")
    return scenes::SensorNoise::gaussian(factor * GAUSSIAN_UNIT);
  if (model != "kinect")
    throw UsageError("--noise-model is \"" + model +
                     "\"; choose one of none, gaussian, kinect");
  if (lidar)
    throw UsageError(
        "a lidar has no kinect noise; choose --noise-model gaussian or none");
  return scenes::SensorNoise::kinect(factor);
}

scenes::SceneFrame renderScene(const Options& options)
{
  if (options.sensor != "camera" && options.sensor != "lidar")
    throw UsageError("--sensor is \"" + options.sensor + "\"; choose camera or lidar");
  const bool lidar = options.sensor == "lidar";
  const auto seed = parse<std::uint64_t>("seed", options.seed, 0, UINT64_MAX);
  const int width = parseSide("width", options.width, lidar ? 1024 : 640);
  const int height = parseSide("height", options.height, lidar ? 64 : 480);
  const scenes::SensorNoise noise = parseNoise(options, lidar);
  scenes::View view = [&] {
    try {
      return scenes::makeScene(options.scene, seed);
    }
    catch (const std::invalid_argument& error) {
      throw UsageError(error.what());
    }
  }();
  if (lidar)
    view.camera.makeLidar(width, height);
  else
    view.camera.resize(width, height);
  return scenes::render(view.scene, view.camera, noise, seed);
}

pcl::PointCloud<pcl::PointXYZRGB> toCloud(const scenes::SceneFrame& frame)
{
  pcl::PointCloud<pcl::PointXYZRGB> cloud(static_cast<std::uint32_t>(frame.width),
                                          static_cast<std::uint32_t>(frame.height));
  cloud.is_dense = true;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    pcl::PointXYZRGB point(frame.r[i], frame.g[i], frame.b[i]);
    point.x = frame.x[i];
    point.y = frame.y[i];
    point.z = frame.z[i];
    cloud[i] = point;
    cloud.is_dense = cloud.is_dense && frame.valid(i);
  }
  return cloud;
}

void writeCloud(const std::string& path, const std::string& format,
                const scenes::SceneFrame& frame)
{
  const pcl::PointCloud<pcl::PointXYZRGB> cloud = toCloud(frame);
  writeAtomically(path, [&](const std::string& file) {
    // PCL maps binary files into memory: a disk that fills up would end the program.
    std::error_code unknown;
    const auto space =
        std::filesystem::space(std::filesystem::absolute(file).parent_path(), unknown);
    if (!unknown && space.available < 2 * cloud.size() * sizeof(pcl::PointXYZRGB))
      throw std::runtime_error("cannot write '" + path +
                               "': the disk is nearly full; " +
                               "make room or name a file elsewhere");
    pcl::PCDWriter writer;
    constexpr int DIGITS = 9; // enough to give every float back
    const int status = format == "ascii"    ? writer.writeASCII(file, cloud, DIGITS)
                       : format == "binary" ? writer.writeBinary(file, cloud)
                                            : writer.writeBinaryCompressed(file, cloud);
    if (status != 0)
      throw std::runtime_error("cannot write '" + path + "'; is the disk full?");
  });
}

/// PCL reports no failure of its PNG writer: a whole PNG file ends with IEND.
void checkPng(const std::string& file, const std::string& path)
{
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  if (bytes.size() < 12 || bytes.compare(bytes.size() - 8, 4, "IEND") != 0)
    throw std::runtime_error("cannot write '" + path + "'; is the disk full?");
}

void writeTruth(const std::string& path, const scenes::SceneFrame& frame)
{
  writeAtomically(path, [&](const std::string& file) {
    pcl::io::saveShortPNGFile(file, frame.labels.data(), frame.width, frame.height, 1);
    checkPng(file, path);
  });
}

nlohmann::ordered_json describeFrame(const Options& options,
                                     const scenes::SceneFrame& frame)
{
  nlohmann::ordered_json root;
  root["scene"] = options.scene;
  root["seed"] = parse<std::uint64_t>("seed", options.seed, 0, UINT64_MAX);
  root["width"] = frame.width;
  root["height"] = frame.height;
  nlohmann::ordered_json camera;
  if (const auto* pinhole = std::get_if<scenes::Pinhole>(&frame.camera.projection))
    camera = {{"fx", pinhole->fx},
              {"fy", pinhole->fy},
              {"cx", pinhole->cx},
              {"cy", pinhole->cy}};
  else if (const auto* angles =
               std::get_if<scenes::Spherical>(&frame.camera.projection))
    camera = {{"azimuth_left", angles->azimuth_left},
              {"azimuth_right", angles->azimuth_right},
              {"elevation_top", angles->elevation_top},
              {"elevation_bottom", angles->elevation_bottom}};
  const Eigen::Vector3d position = frame.camera.to_world.translation();
  const Eigen::Quaterniond turn(frame.camera.to_world.linear());
  camera["position"] = {position.x(), position.y(), position.z()};
  camera["orientation_wxyz"] = {turn.w(), turn.x(), turn.y(), turn.z()};
  root["camera"] = camera;
  const std::vector<std::size_t> counts = frame.labelCounts();
  root["planes"] = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < frame.planes.size(); ++k) {
    const Eigen::Vector4d& p = frame.planes[k];
    nlohmann::ordered_json plane;
    plane["label"] = k + 1;
    plane["coefficients"] = {p[0], p[1], p[2], p[3]};
    plane["points"] = counts[k + 1];
    root["planes"].push_back(plane);
  }
  return root;
}

void writePlanes(const std::string& path, const Options& options,
                 const scenes::SceneFrame& frame)
{
  writeAtomically(path, [&](const std::string& file) {
    std::ofstream stream(file, std::ios::binary);
    stream << describeFrame(options, frame).dump(2) << '\n';
    if (!stream.flush())
      throw std::runtime_error("cannot write '" + path + "'; is the disk full?");
  });
}

void run(const Options& options)
{
  if (options.format != "binary_compressed" && options.format != "binary" &&
      options.format != "ascii")
    throw UsageError("--format is \"" + options.format +
                     "\"; choose one of binary_compressed, binary, ascii");
  for (const std::string& path : {options.output, options.truth, options.planes})
    if (!path.empty())
      checkWritable(path);
  const scenes::SceneFrame frame = renderScene(options);
  if (!options.truth.empty())
    writeTruth(options.truth, frame);
  if (!options.planes.empty())
    writePlanes(options.planes, options, frame);
  writeCloud(options.output, options.format, frame);
}

void printHelp()
{
  Options defaults;
  std::cout << "Usage: " << PROGRAM << " out.pcd [options]\n\n"
            << "Writes an organized cloud of a made-up scene, seen by a depth camera "
               "or a lidar,\nand its exact planes.\n\n"
            << describe(defaults);
}

} // namespace

int main(int argc, char* argv[])
{
  return apps::runApp({PROGRAM, "make fewer points with --width and --height"}, [&] {
    const Options options = parseOptions(argc, argv);
    if (options.help)
      printHelp();
    else
      run(options);
    return 0;
  });
}
