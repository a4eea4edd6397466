// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/scene_library.h"

#include "scenes/furniture.h"

#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>

namespace pcl_mrf_planes::scenes {

namespace {

using Eigen::Vector3d;

const Colour WALL{0.85, 0.82, 0.74};
const Colour SIDE_WALL{0.72, 0.78, 0.82};
const Colour FLOOR{0.62, 0.48, 0.36};
const Colour WOOD{0.80, 0.60, 0.36};
const Colour RED{0.85, 0.30, 0.26};
const Colour GREEN{0.36, 0.66, 0.42};
const Colour BLUE{0.30, 0.46, 0.80};

void addFloor(Scene& scene, double width = 8.0, double depth = 8.0)
{
  scene.beginObject();
  addPatch(scene, {-width / 2, -1.0, 0}, {width, 0, 0}, {0, depth + 1.0, 0}, FLOOR);
}

/// Wall across the view at y metres.
void addBackWall(Scene& scene, double y, double width = 8.0, double height = 5.0)
{
  scene.beginObject();
  addPatch(scene, {-width / 2, y, 0}, {width, 0, 0}, {0, 0, height}, WALL);
}

const std::vector<std::pair<std::string, std::function<View(std::uint64_t)>>>&
catalogue()
{
  static const std::vector<std::pair<std::string, std::function<View(std::uint64_t)>>>
      all = {{"room", [](std::uint64_t seed) { return makeRoom(seed); }},
             {"single_plane", [](std::uint64_t) { return singlePlane(); }},
             {"corner", [](std::uint64_t) { return corner(); }},
             {"step", [](std::uint64_t) { return step(); }},
             {"ramp", [](std::uint64_t) { return ramp(); }},
             {"stairs", [](std::uint64_t) { return stairs(); }},
             {"box_on_table", [](std::uint64_t) { return boxOnTable(); }},
             {"sphere_on_plane", [](std::uint64_t) { return sphereOnPlane(); }},
             {"cylinder_room", [](std::uint64_t) { return cylinderRoom(); }}};
  return all;
}

} // namespace

View singlePlane(double distance, double tilt)
{
  View view;
  const double extent = 100.0 * distance;
  const Vector3d along = Vector3d(std::cos(tilt), std::sin(tilt), 0) * extent;
  const Vector3d up(0, 0, extent);
  view.scene.beginObject();
  addPatch(view.scene, Vector3d(0, distance, 0) - 0.5 * (along + up), along, up, WALL);
  view.camera = lookAt({0, 0, 0}, {0, 1, 0});
  return view;
}

View corner()
{
  View view;
  const Vector3d x(10, 0, 0);
  const Vector3d y(0, -10, 0);
  const Vector3d z(0, 0, 10);
  view.scene.beginObject();
  addPatch(view.scene, Vector3d::Zero(), x, y, FLOOR);
  addPatch(view.scene, Vector3d::Zero(), x, z, WALL);
  addPatch(view.scene, Vector3d::Zero(), y, z, SIDE_WALL);
  view.camera = lookAt({1.7, -1.9, 1.4}, {0.1, 0.0, 0.5});
  return view;
}

View step(double gap, double distance)
{
  View view;
  const double extent = 10.0 * (distance + gap);
  const Vector3d up(0, 0, 2 * extent);
  view.scene.beginObject();
  addPatch(view.scene, {-extent, distance, -extent}, {extent, 0, 0}, up, WALL);
  view.scene.beginObject();
  addPatch(view.scene, {-extent, distance + gap, -extent}, {2 * extent, 0, 0}, up,
           SIDE_WALL);
  view.camera = lookAt({0, 0, 0}, {0, 1, 0});
  return view;
}

View ramp()
{
  View view;
  addFloor(view.scene);
  addBackWall(view.scene, 4.5);
  addRamp(view.scene, standAt({0.2, 2.8, 0}, 0.35), {1.2, 1.8, 0.7}, GREEN);
  view.camera = lookAt({0, 0, 1.5}, {0.1, 3.0, 0.5});
  return view;
}

View stairs(int steps)
{
  View view;
  addFloor(view.scene);
  addBackWall(view.scene, 5.0);
  addStairs(view.scene, standAt({0, 1.9 + 0.14 * steps, 0}, 0.2),
            {1.6, 0.28 * steps, 0.17 * steps}, steps, WOOD);
  view.camera = lookAt({0, 0, 1.6}, {0, 2.6, 0.4});
  return view;
}

View boxOnTable()
{
  View view;
  addFloor(view.scene);
  addBackWall(view.scene, 3.2);
  addTable(view.scene, standAt({0, 2.0, 0}, 0.25), {1.4, 0.8, 0.74}, true, WOOD);
  addBox(view.scene, standAt({0.15, 1.95, 0.74}, 0.7), {0.35, 0.25, 0.3}, RED);
  view.camera = lookAt({0, 0, 1.45}, {0, 2.0, 0.7});
  return view;
}

View sphereOnPlane()
{
  View view;
  view.scene.beginObject();
  addPatch(view.scene, {-50, -50, 0}, {100, 0, 0}, {0, 100, 0}, FLOOR);
  addBall(view.scene, standAt({0, 1.6, 0}), 0.3, BLUE);
  view.camera = lookAt({0, 0, 1.4}, {0, 1.6, 0.2});
  return view;
}

View cylinderRoom()
{
  View view;
  addFloor(view.scene, 5.0, 4.2);
  addBackWall(view.scene, 4.2, 5.0, 2.6);
  for (const double x : {-2.5, 2.5}) {
    view.scene.beginObject();
    addPatch(view.scene, {x, -1, 0}, {0, 5.2, 0}, {0, 0, 2.6}, SIDE_WALL);
  }
  view.scene.beginObject();
  addPatch(view.scene, {-2.5, -1, 2.6}, {5, 0, 0}, {0, 5.2, 0}, WALL);
  addDrum(view.scene, standAt({-0.9, 2.9, 0}), 0.22, 2.6, WALL);
  addDrum(view.scene, standAt({0.7, 2.2, 0}), 0.3, 0.8, RED);
  addDrum(view.scene, standAt({1.4, 3.5, 0}), 0.25, 1.2, GREEN);
  view.scene.beginObject();
  view.scene.addCurved(Cylinder{{-0.2, 1.9, 0.18}, {0.8, 0.6, 0}, 0.9, 0.18}, BLUE);
  view.camera = lookAt({0, 0, 1.5}, {0, 3.0, 0.8});
  return view;
}

std::vector<std::string> sceneNames()
{
  std::vector<std::string> names;
  for (const auto& entry : catalogue())
    names.push_back(entry.first);
  return names;
}

View makeScene(const std::string& name, std::uint64_t seed)
{
  std::string known;
  for (const auto& entry : catalogue()) {
    if (entry.first == name)
      return entry.second(seed);
    known += (known.empty() ? "" : ", ") + entry.first;
  }
  throw std::invalid_argument("there is no scene \"" + name + "\"; choose one of " +
                              known);
}

} // namespace pcl_mrf_planes::scenes
