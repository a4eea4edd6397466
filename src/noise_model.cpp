// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/noise_model.h>

#include <utility>

namespace pcl_mrf_planes {

namespace {

const std::vector<std::pair<std::string, NoiseModel>>& presets()
{
  static const std::vector<std::pair<std::string, NoiseModel>> all = {
      {"kinect", NoiseModel::kinect()},
      {"structured_light", NoiseModel::structuredLight()},
      {"time_of_flight", NoiseModel::timeOfFlight()},
      {"lidar", NoiseModel::lidar()},
      {"none", NoiseModel::none()}};
  return all;
}

} // namespace

bool NoiseModel::fromName(const std::string& name, NoiseModel& model)
{
  for (const auto& preset : presets())
    if (preset.first == name) {
      model = preset.second;
      return true;
    }
  return false;
}

std::vector<std::string> NoiseModel::names()
{
  std::vector<std::string> all;
  for (const auto& preset : presets())
    all.push_back(preset.first);
  return all;
}

} // namespace pcl_mrf_planes
