// SPDX-License-Identifier: BSD-3-Clause
#include "image_shape.h"

#include "scenes/render.h"
#include "scenes/scene_library.h"

#include <map>

namespace pcl_mrf_planes::benchmarks {

namespace {

constexpr std::uint64_t SEED = 1;
constexpr double LIDAR_NOISE = 0.01; // metres

scenes::SceneFrame renderRoom(const ImageShape& shape)
{
  scenes::View view = scenes::makeRoom(SEED);
  if (shape.lidar)
    view.camera.makeLidar(shape.width, shape.height);
  else
    view.camera.resize(shape.width, shape.height);
  const scenes::SensorNoise noise = shape.lidar
                                        ? scenes::SensorNoise::gaussian(LIDAR_NOISE)
                                        : scenes::SensorNoise::kinect();
  return scenes::render(view.scene, view.camera, noise, SEED);
}

Cloud::ConstPtr makeCloud(const ImageShape& shape)
{
  const scenes::SceneFrame frame = renderRoom(shape);
  const Cloud::Ptr cloud(new Cloud(static_cast<std::uint32_t>(frame.width),
                                   static_cast<std::uint32_t>(frame.height)));
  cloud->is_dense = false;
  for (std::size_t i = 0; i < cloud->size(); ++i)
    (*cloud)[i] = {frame.x[i], frame.y[i], frame.z[i]};
  return cloud;
}

} // namespace

std::string ImageShape::name() const
{
  return std::string(lidar ? "lidar:" : "camera:") + std::to_string(width) + 'x' +
         std::to_string(height);
}

std::vector<ImageShape> allShapes()
{
  return {{160, 120}, {320, 240}, VGA, {1280, 960}, {2048, 1536}, {2048, 128, true}};
}

const Cloud::ConstPtr& roomCloud(const ImageShape& shape)
{
  static std::map<ImageShape, Cloud::ConstPtr> clouds;
  Cloud::ConstPtr& cloud = clouds[shape];
  if (!cloud)
    cloud = makeCloud(shape);
  return cloud;
}

const OrganizedPoints& roomPoints(const ImageShape& shape)
{
  static std::map<ImageShape, OrganizedPoints> images;
  OrganizedPoints& points = images[shape];
  if (points.size() == 0) {
    const Cloud& cloud = *roomCloud(shape);
    points.load(shape.width, shape.height, cloud[0].data,
                sizeof(cloud[0]) / sizeof(float));
    points.resolveDepthMeasure(DepthMeasure::AUTO);
  }
  return points;
}

} // namespace pcl_mrf_planes::benchmarks
