// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/region_polygons.h>

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <array>
#include <cstdint>
#include <vector>

namespace pcl_mrf_planes::apps {

/** \brief Triangles between the rings of all patches, and "colour" of every point.
 * \param[in] colours one for each outline */
vtkSmartPointer<vtkPolyData>
polygonMesh(const std::vector<RegionOutline>& outlines,
            const std::vector<std::array<std::uint8_t, 3>>& colours);

/** \brief Add a ring to \a lines, closed, and its corners to \a points. */
void addRing(const PlaneRing& ring, vtkPoints& points, vtkCellArray& lines);

} // namespace pcl_mrf_planes::apps
