// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkProp.h>
#include <vtkSmartPointer.h>

#include <Eigen/Core>

#include <string>

class vtkRenderer;
class vtkTextProperty;

namespace pcl_mrf_planes::viewer {

/** \brief Strokes on a plate that lets little through: readable on any colour. */
void dressText(vtkTextProperty* property, bool dark);

/** \brief A word at a place of the scene, of one size however far that is. */
vtkSmartPointer<vtkProp> markAt(const Eigen::Vector3d& place, const std::string& word,
                                bool dark, int font_size);

/** \brief Before every picture of \a renderer, move its marks so that none hides another;
 * those that were added first stay where they belong. */
void keepMarksApart(vtkRenderer* renderer);

} // namespace pcl_mrf_planes::viewer
