// SPDX-License-Identifier: BSD-3-Clause
#include "layers.h"
#include "marks.h"

#include <vtkActor.h>
#include <vtkArrowSource.h>
#include <vtkDoubleArray.h>
#include <vtkGlyph3D.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include <algorithm>
#include <cmath>

namespace pcl_mrf_planes::viewer {

namespace {

/// Long on large planes, and never lost on small ones; metres.
std::vector<Eigen::Vector3d> arrowsOf(const SegmentedView& view)
{
  double largest = 0.0;
  for (const ViewPlane& plane : view.planes)
    largest = std::max(largest, std::sqrt(plane.area));
  std::vector<Eigen::Vector3d> arrows;
  for (const ViewPlane& plane : view.planes)
    arrows.push_back(std::max({0.1, 0.06 * largest, 0.25 * std::sqrt(plane.area)}) *
                     plane.normal);
  return arrows;
}

} // namespace

vtkSmartPointer<vtkProp> normalLayer(const SegmentedView& view,
                                     const ViewSettings& settings)
{
  vtkNew<vtkPoints> places;
  vtkNew<vtkDoubleArray> normals;
  normals->SetNumberOfComponents(3);
  const std::vector<Eigen::Vector3d> arrows = arrowsOf(view);
  for (std::size_t k = 0; k < arrows.size(); ++k) {
    if (!settings.shows(static_cast<std::uint16_t>(k + 1)))
      continue;
    places->InsertNextPoint(view.planes[k].centroid.data());
    normals->InsertNextTuple(arrows[k].data());
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(places);
  data->GetPointData()->SetVectors(normals);
  vtkNew<vtkArrowSource> arrow;
  vtkNew<vtkGlyph3D> glyphs;
  glyphs->SetInputData(data);
  glyphs->SetSourceConnection(arrow->GetOutputPort());
  glyphs->SetScaleModeToScaleByVector();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(glyphs->GetOutputPort());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  const double shade = settings.dark ? 0.95 : 0.15;
  actor->GetProperty()->SetColor(shade, shade, shade);
  return actor;
}

Props numberMarks(const SegmentedView& view, const ViewSettings& settings)
{
  Props marks;
  const std::vector<Eigen::Vector3d> arrows = arrowsOf(view);
  for (std::size_t k = 0; k < arrows.size(); ++k)
    if (settings.shows(static_cast<std::uint16_t>(k + 1)))
      marks.push_back(markAt(view.planes[k].centroid + 1.15 * arrows[k],
                             std::to_string(k + 1), settings.dark, 16));
  return marks;
}

} // namespace pcl_mrf_planes::viewer
