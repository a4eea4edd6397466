// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/furniture.h"

namespace pcl_mrf_planes::scenes {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

Isometry3d shifted(const Isometry3d& pose, double x, double y, double z)
{
  return pose * Eigen::Translation3d(x, y, z);
}

} // namespace

Isometry3d standAt(const Vector3d& foot, double yaw)
{
  Isometry3d pose = Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(yaw, Vector3d::UnitZ()).toRotationMatrix();
  pose.translation() = foot;
  return pose;
}

int addPatch(Scene& scene, const Vector3d& corner, const Vector3d& a, const Vector3d& b,
             const Colour& colour)
{
  return scene.addPolygon({corner, corner + a, corner + a + b, corner + b}, colour);
}

void addPatchTo(Scene& scene, int plane, const Vector3d& corner, const Vector3d& a,
                const Vector3d& b, const Colour& colour)
{
  scene.addPiece(plane, {corner, corner + a, corner + a + b, corner + b}, colour);
}

void addBox(Scene& scene, const Isometry3d& pose, const Vector3d& size,
            const Colour& colour, bool bottom)
{
  scene.beginObject();
  const Vector3d a = pose.linear().col(0) * size.x();
  const Vector3d b = pose.linear().col(1) * size.y();
  const Vector3d c = pose.linear().col(2) * size.z();
  const Vector3d corner = pose.translation() - 0.5 * (a + b);
  addPatch(scene, corner, a, c, colour);
  addPatch(scene, corner + b, a, c, colour);
  addPatch(scene, corner, b, c, colour);
  addPatch(scene, corner + a, b, c, colour);
  addPatch(scene, corner + c, a, b, colour);
  if (bottom)
    addPatch(scene, corner, a, b, colour);
}

void addTable(Scene& scene, const Isometry3d& pose, const Vector3d& size,
              bool round_legs, const Colour& colour)
{
  constexpr double THICKNESS = 0.04;
  constexpr double LEG = 0.06;
  const double height = size.z() - THICKNESS;
  addBox(scene, shifted(pose, 0, 0, height), {size.x(), size.y(), THICKNESS}, colour,
         true);
  for (const double right : {-0.5, 0.5})
    for (const double back : {-0.5, 0.5}) {
      const Isometry3d leg =
          shifted(pose, right * (size.x() - 2 * LEG), back * (size.y() - 2 * LEG), 0);
      if (!round_legs) {
        addBox(scene, leg, {LEG, LEG, height}, 0.8 * colour);
        continue;
      }
      scene.beginObject();
      scene.addCurved(Cylinder{leg.translation(), leg.linear().col(2), height, LEG / 2},
                      0.8 * colour);
    }
}

void addCabinet(Scene& scene, const Isometry3d& pose, const Vector3d& size,
                const Colour& colour)
{
  const double lower = 0.45 * size.z();
  const double upper_depth = 0.65 * size.y();
  addBox(scene, pose, {size.x(), size.y(), lower}, colour);
  addBox(scene, shifted(pose, 0, 0.5 * (size.y() - upper_depth), lower),
         {size.x(), upper_depth, size.z() - lower}, 0.9 * colour);
}

void addRamp(Scene& scene, const Isometry3d& pose, const Vector3d& size,
             const Colour& colour)
{
  scene.beginObject();
  const Vector3d a = pose.linear().col(0) * size.x();
  const Vector3d b = pose.linear().col(1) * size.y();
  const Vector3d c = pose.linear().col(2) * size.z();
  const Vector3d corner = pose.translation() - 0.5 * (a + b);
  addPatch(scene, corner, a, b + c, colour);
  addPatch(scene, corner + b, a, c, colour);
  scene.addPolygon({corner, corner + b, corner + b + c}, colour);
  scene.addPolygon({corner + a, corner + a + b, corner + a + b + c}, colour);
}

void addStairs(Scene& scene, const Isometry3d& pose, const Vector3d& size, int steps,
               const Colour& colour)
{
  scene.beginObject();
  const Vector3d a = pose.linear().col(0) * size.x();
  const Vector3d run = pose.linear().col(1) * (size.y() / steps);
  const Vector3d rise = pose.linear().col(2) * (size.z() / steps);
  const Vector3d corner = pose.translation() - 0.5 * (a + steps * run);
  int left = -1;
  int right = -1;
  for (int i = 0; i < steps; ++i) {
    const Vector3d front = corner + i * run;
    const Vector3d tall = (i + 1) * rise;
    addPatch(scene, front + i * rise, a, rise, colour);  // riser
    addPatch(scene, front + tall, a, run, 0.9 * colour); // tread
    if (i == 0) {
      left = addPatch(scene, front, run, tall, colour);
      right = addPatch(scene, front + a, run, tall, colour);
      continue;
    }
    addPatchTo(scene, left, front, run, tall, colour);
    addPatchTo(scene, right, front + a, run, tall, colour);
  }
  addPatch(scene, corner + steps * run, a, steps * rise, colour); // back
}

void addBall(Scene& scene, const Isometry3d& pose, double radius, const Colour& colour)
{
  scene.beginObject();
  scene.addCurved(Sphere{pose.translation() + radius * pose.linear().col(2), radius},
                  colour);
}

void addDrum(Scene& scene, const Isometry3d& pose, double radius, double height,
             const Colour& colour)
{
  scene.beginObject();
  const Vector3d axis = pose.linear().col(2);
  scene.addCurved(Cylinder{pose.translation(), axis, height, radius}, colour);
  scene.addDisk(Disk{pose.translation() + height * axis, axis, radius}, 0.9 * colour);
}

} // namespace pcl_mrf_planes::scenes
