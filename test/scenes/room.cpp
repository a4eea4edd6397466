// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/furniture.h"
#include "scenes/random.h"
#include "scenes/scene_library.h"

#include <cmath>

namespace pcl_mrf_planes::scenes {

namespace {

using Eigen::Vector3d;

constexpr double HALF_TURN = 3.14159265358979323846;

/** \brief Builds one room: x from 0 to width, y from 0 to depth, z from 0 to height.
 *
 * The camera stands near the wall y = 0 and looks towards the wall y = depth, which has
 * a door gap or a niche. Furniture is placed at random where there is still room for
 * it.
 */
class RoomBuilder {
public:
  explicit RoomBuilder(std::uint64_t seed)
  : random_(seed)
  , width_(random_.uniform(3.4, 5.2))
  , depth_(random_.uniform(3.8, 6.0))
  , height_(random_.uniform(2.4, 2.8))
  {}

  View build()
  {
    placeCamera();
    addShell();
    addBackWall();
    addCabinets();
    const int things = random_.integer(4, 7);
    for (int i = 0; i < things; ++i)
      addThing();
    return view_;
  }

private:
  struct Circle {
    double x, y, radius;
  };

  Colour pastel()
  {
    const double r = random_.uniform(0.3, 0.9);
    const double g = random_.uniform(0.3, 0.9);
    return {r, g, random_.uniform(0.3, 0.9)};
  }

  void placeCamera()
  {
    const double side = random_.uniform(0.25, 0.75);
    // One draw a statement: the order of a call's arguments is the compiler's.
    const double up = random_.uniform(1.2, 1.7);
    const double ahead = random_.uniform(0.3, 0.7);
    const Vector3d position(side * width_, ahead, up);
    const Vector3d target((1.0 - side) * width_ * 0.6 + 0.2 * width_, 0.75 * depth_,
                          random_.uniform(0.5, 0.9));
    view_.camera = lookAt(position, target);
    taken_.push_back({position.x(), position.y(), 0.9});
  }

  void addShell()
  {
    const Colour wall(0.85, 0.83, 0.76);
    Scene& scene = view_.scene;
    scene.beginObject();
    addPatch(scene, {0, 0, 0}, {width_, 0, 0}, {0, depth_, 0}, {0.62, 0.48, 0.36});
    addPatch(scene, {0, 0, height_}, {width_, 0, 0}, {0, depth_, 0}, {0.92, 0.92, 0.9});
    addPatch(scene, {0, 0, 0}, {width_, 0, 0}, {0, 0, height_}, wall);
    addPatch(scene, {0, 0, 0}, {0, depth_, 0}, {0, 0, height_}, wall);
    addPatch(scene, {width_, 0, 0}, {0, depth_, 0}, {0, 0, height_}, wall);
  }

  /// The far wall in pieces around an opening, and what lies in the opening.
  void addBackWall()
  {
    const bool door = random_.chance(0.5);
    const double opening = door ? 0.9 : random_.uniform(0.6, 1.1);
    const double low = door ? 0.0 : random_.uniform(0.8, 1.1);
    const double high = door ? 2.05 : low + random_.uniform(0.5, 0.9);
    const double deep = door ? 1.3 : random_.uniform(0.15, 0.35);
    const double left = random_.uniform(0.3, width_ - opening - 0.3);
    const double right = left + opening;
    const Colour wall(0.74, 0.79, 0.82);
    const Vector3d at(0, depth_, 0);
    Scene& scene = view_.scene;

    scene.beginObject();
    const int plane = addPatch(scene, at, {left, 0, 0}, {0, 0, height_}, wall);
    addPatchTo(scene, plane, at + Vector3d(right, 0, 0), {width_ - right, 0, 0},
               {0, 0, height_}, wall);
    addPatchTo(scene, plane, at + Vector3d(left, 0, high), {opening, 0, 0},
               {0, 0, height_ - high}, wall);
    if (!door)
      addPatchTo(scene, plane, at + Vector3d(left, 0, 0), {opening, 0, 0}, {0, 0, low},
                 wall);

    const Vector3d corner(left, depth_, low);
    const Vector3d a(opening, 0, 0);
    const Vector3d b(0, deep, 0);
    const Vector3d c(0, 0, high - low);
    scene.beginObject();
    addPatch(scene, corner + b, a, c, 0.9 * wall);
    addPatch(scene, corner, b, c, 0.8 * wall);
    addPatch(scene, corner + a, b, c, 0.8 * wall);
    addPatch(scene, corner + c, a, b, 0.7 * wall);
    // The sill of a niche is a plane of its own, the floor behind a door is the floor.
    if (door)
      addPatchTo(scene, 0, corner, a, b, {0.55, 0.43, 0.33});
    else
      addPatch(scene, corner, a, b, 0.7 * wall);
    taken_.push_back({0.5 * (left + right), depth_, door ? 0.8 : 0.1});
  }

  bool take(double x, double y, double radius)
  {
    for (const Circle& other : taken_)
      if (std::hypot(other.x - x, other.y - y) < other.radius + radius)
        return false;
    taken_.push_back({x, y, radius});
    return true;
  }

  /// Up to two cabinets with their backs against the side walls.
  void addCabinets()
  {
    for (const bool right : {false, true}) {
      const double wide = random_.uniform(0.8, 1.4);
      const double deep = random_.uniform(0.4, 0.6);
      const double tall = random_.uniform(1.0, 2.1);
      const double y = random_.uniform(0.5 * depth_, depth_ - 0.5 * wide - 0.2);
      const Colour colour = pastel();
      const double x = right ? width_ - 0.5 * deep : 0.5 * deep;
      if (!random_.chance(0.7) || !take(x, y, 0.5 * wide + 0.1))
        continue;
      const double yaw = right ? -0.5 * HALF_TURN : 0.5 * HALF_TURN;
      addCabinet(view_.scene, standAt({x, y, 0}, yaw), {wide, deep, tall}, colour);
    }
  }

  /// Looks for a free place; false when the room is full.
  bool findPlace(double radius, Eigen::Isometry3d& pose)
  {
    constexpr int TRIES = 30;
    for (int i = 0; i < TRIES; ++i) {
      const double x = random_.uniform(radius + 0.05, width_ - radius - 0.05);
      const double y = random_.uniform(0.3 * depth_, depth_ - radius - 0.05);
      const double yaw = random_.uniform(0.0, 2.0 * HALF_TURN);
      if (!take(x, y, radius))
        continue;
      pose = standAt({x, y, 0}, yaw);
      return true;
    }
    return false;
  }

  void addThing()
  {
    Scene& scene = view_.scene;
    const int kind = random_.integer(0, 6);
    const double a = random_.uniform();
    const double b = random_.uniform();
    const double c = random_.uniform();
    const Colour colour = pastel();
    Eigen::Isometry3d pose;
    if (kind == 0 && findPlace(0.25, pose))
      addBall(scene, pose, 0.12 + 0.13 * a, colour);
    else if (kind == 1 && findPlace(0.25, pose))
      addDrum(scene, pose, 0.12 + 0.13 * a, 0.4 + 0.6 * b, colour);
    else if (kind == 2 && findPlace(0.6, pose))
      addRamp(scene, pose, {0.5 + 0.3 * a, 0.7 + 0.2 * b, 0.2 + 0.3 * c}, colour);
    else if (kind == 3 && findPlace(0.7, pose))
      addStairs(scene, pose, {0.7 + 0.2 * a, 0.9, 0.45 + 0.3 * b}, 3, colour);
    else if (kind <= 5 && findPlace(0.75, pose))
      addLaidTable(pose, {1.0 + 0.3 * a, 0.6 + 0.2 * b, 0.5 + 0.25 * c});
    else if (findPlace(0.4, pose))
      addBox(scene, pose, {0.3 + 0.25 * a, 0.3 + 0.25 * b, 0.2 + 0.5 * c}, colour);
  }

  /// A table with a box at one end and a box, a ball or a drum at the other.
  void addLaidTable(const Eigen::Isometry3d& pose, const Vector3d& size)
  {
    Scene& scene = view_.scene;
    addTable(scene, pose, size, random_.chance(0.5), {0.80, 0.62, 0.40});
    const Eigen::Isometry3d left = pose * standAt({-0.28 * size.x(), 0, size.z()},
                                                  random_.uniform(0.0, HALF_TURN));
    const Eigen::Isometry3d right = pose * standAt({0.28 * size.x(), 0, size.z()});
    const Colour colour = pastel();
    const Vector3d box{random_.uniform(0.15, 0.3), random_.uniform(0.15, 0.3),
                       random_.uniform(0.1, 0.35)};
    addBox(scene, left, box, colour);
    const int kind = random_.integer(0, 3);
    if (kind > 1)
      return;
    const Colour other = pastel();
    if (kind == 0)
      addBall(scene, right, random_.uniform(0.07, 0.13), other);
    else
      addDrum(scene, right, 0.08, random_.uniform(0.15, 0.3), other);
  }

  Random random_;
  double width_, depth_, height_; // metres
  View view_;
  std::vector<Circle> taken_;
};

} // namespace

View makeRoom(std::uint64_t seed)
{
  return RoomBuilder(seed).build();
}

} // namespace pcl_mrf_planes::scenes
