// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scenes/scene.h"

#include <Eigen/Geometry>

namespace pcl_mrf_planes::scenes {

/** \brief Where a thing stands: the centre of its foot, turned about the vertical.
 * \param[in] foot metres, world frame
 * \param[in] yaw radians, counterclockwise seen from above
 */
Eigen::Isometry3d standAt(const Eigen::Vector3d& foot, double yaw = 0.0);

/** \brief Parallelogram corner, corner + a, corner + a + b, corner + b.
 * \return the index of its plane */
int addPatch(Scene& scene, const Eigen::Vector3d& corner, const Eigen::Vector3d& a,
             const Eigen::Vector3d& b, const Colour& colour);

/** \brief Another such piece of a plane that exists. */
void addPatchTo(Scene& scene, int plane, const Eigen::Vector3d& corner,
                const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                const Colour& colour);

/** \brief Four sides and a lid, and a bottom if asked. Size in metres. */
void addBox(Scene& scene, const Eigen::Isometry3d& pose, const Eigen::Vector3d& size,
            const Colour& colour, bool bottom = false);

/** \brief A top, 4 cm thick, on four legs, round (no planes) or square (planes).
 * \param[in] size whole width, depth and height, metres */
void addTable(Scene& scene, const Eigen::Isometry3d& pose, const Eigen::Vector3d& size,
              bool round_legs, const Colour& colour);

/** \brief A cabinet whose upper doors stand back behind its lower part. */
void addCabinet(Scene& scene, const Eigen::Isometry3d& pose,
                const Eigen::Vector3d& size, const Colour& colour);

/** \brief Wedge that rises along its own y from 0 to size.z(). */
void addRamp(Scene& scene, const Eigen::Isometry3d& pose, const Eigen::Vector3d& size,
             const Colour& colour);

/** \brief Stairs that rise along their own y; size of the whole flight in metres. */
void addStairs(Scene& scene, const Eigen::Isometry3d& pose, const Eigen::Vector3d& size,
               int steps, const Colour& colour);

/** \brief Ball lying on the foot point. */
void addBall(Scene& scene, const Eigen::Isometry3d& pose, double radius,
             const Colour& colour);

/** \brief Upright cylinder with a lid (a plane). */
void addDrum(Scene& scene, const Eigen::Isometry3d& pose, double radius, double height,
             const Colour& colour);

} // namespace pcl_mrf_planes::scenes
