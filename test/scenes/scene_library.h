// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scenes/camera.h"
#include "scenes/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace pcl_mrf_planes::scenes {

/** \brief A scene and a 640x480 Kinect that looks at it. */
struct View {
  Scene scene;
  Camera camera;
};

/** \brief A wall across the whole image. \param[in] distance metres
 * \param[in] tilt radians about the vertical, 0: the wall faces the camera,
 *                 less than 0.9 either way */
View singlePlane(double distance = 2.0, double tilt = 0.0);

/** \brief A floor and two walls that meet in a corner: three planes, no gaps. */
View corner();

/** \brief Two parallel walls that face the camera, the right one farther by \a gap.
 * \param[in] gap metres, > 0
 * \param[in] distance of the near one, metres */
View step(double gap = 0.2, double distance = 2.0);

/** \brief A ramp on a floor before a wall. */
View ramp();

/** \brief A flight of stairs. \param[in] steps 1 or more */
View stairs(int steps = 5);

/** \brief A box on a table in front of a wall. */
View boxOnTable();

/** \brief A ball on a floor: one plane, one thing that is none. */
View sphereOnPlane();

/** \brief A room whose pillars and drums are round. */
View cylinderRoom();

/** \brief A plausible furnished room; another seed, another room. See room.cpp. */
View makeRoom(std::uint64_t seed);

/** \brief Names of all scenes, for makeScene(). */
std::vector<std::string> sceneNames();

/** \brief Scene by name. \param[in] seed used by "room" only
 * \throws std::invalid_argument that lists the names when there is none such */
View makeScene(const std::string& name, std::uint64_t seed = 0);

} // namespace pcl_mrf_planes::scenes
