// SPDX-License-Identifier: BSD-3-Clause
#include "layers.h"

#include <vtkActor.h>
#include <vtkArrowSource.h>
#include <vtkBillboardTextActor3D.h>
#include <vtkDoubleArray.h>
#include <vtkGlyph3D.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>

namespace pcl_mrf_planes::viewer {

namespace {

/// Long on large planes, and never lost on small ones; metres.
double arrowLength(const ViewPlane& plane, double largest)
{
  return std::max(0.06 * largest, 0.25 * std::sqrt(static_cast<double>(plane.area)));
}

vtkSmartPointer<vtkProp> numberAt(const Eigen::Vector3d& place, std::size_t number,
                                  bool dark)
{
  auto actor = vtkSmartPointer<vtkBillboardTextActor3D>::New();
  actor->SetInput(std::to_string(number).c_str());
  actor->SetPosition(place.x(), place.y(), place.z());
  vtkTextProperty* property = actor->GetTextProperty();
  const double shade = dark ? 1.0 : 0.0;
  property->SetColor(shade, shade, shade);
  property->SetBackgroundColor(1.0 - shade, 1.0 - shade, 1.0 - shade);
  property->SetBackgroundOpacity(0.6);
  property->SetFontSize(16);
  property->BoldOn();
  property->SetJustificationToCentered();
  return actor;
}

} // namespace

Props normalLayer(const SegmentedView& view, bool dark)
{
  vtkNew<vtkPoints> places;
  vtkNew<vtkDoubleArray> normals;
  normals->SetNumberOfComponents(3);
  Props props(1);
  double largest = 0.0;
  for (const ViewPlane& plane : view.planes)
    largest = std::max(largest, std::sqrt(plane.area));
  for (std::size_t k = 0; k < view.planes.size(); ++k) {
    const ViewPlane& plane = view.planes[k];
    const Eigen::Vector3d arrow =
        std::max(0.1, arrowLength(plane, largest)) * plane.normal;
    places->InsertNextPoint(plane.centroid.data());
    normals->InsertNextTuple(arrow.data());
    props.push_back(numberAt(plane.centroid + 1.15 * arrow, k + 1, dark));
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
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  const double shade = dark ? 0.95 : 0.15;
  actor->GetProperty()->SetColor(shade, shade, shade);
  props[0] = actor;
  return props;
}

} // namespace pcl_mrf_planes::viewer
