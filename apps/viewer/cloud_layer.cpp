// SPDX-License-Identifier: BSD-3-Clause
#include "layers.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>

namespace pcl_mrf_planes::viewer {

namespace {

vtkSmartPointer<vtkActor> actorOf(vtkPolyData* data)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  return actor;
}

std::vector<std::size_t> shownPoints(const Cloud& cloud, const PointColours& colours,
                                     int step)
{
  std::vector<std::size_t> shown;
  const auto width = static_cast<int>(cloud.width);
  for (int y = 0; y < static_cast<int>(cloud.height); y += step)
    for (int x = 0; x < width; x += step) {
      const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                     static_cast<std::size_t>(x);
      if (colours.shown[i])
        shown.push_back(i);
    }
  return shown;
}

} // namespace

vtkSmartPointer<vtkProp> cloudLayer(const Cloud& cloud, const PointColours& colours,
                                    float size, int step)
{
  const std::vector<std::size_t> shown = shownPoints(cloud, colours, step);
  const auto count = static_cast<vtkIdType>(shown.size());
  vtkNew<vtkFloatArray> places;
  places->SetNumberOfComponents(3);
  places->SetNumberOfTuples(count);
  vtkNew<vtkUnsignedCharArray> shades;
  shades->SetNumberOfComponents(3);
  shades->SetNumberOfTuples(count);
  vtkNew<vtkIdTypeArray> ids;
  ids->SetNumberOfTuples(count);
  float* place = places->GetPointer(0);
  unsigned char* shade = shades->GetPointer(0);
  vtkIdType next = 0;
  for (const std::size_t i : shown) {
    const pcl::PointXYZ& p = cloud[i];
    place = std::copy(p.data, p.data + 3, place);
    shade = std::copy(colours.colours[i].begin(), colours.colours[i].end(), shade);
    ids->SetValue(next, next);
    ++next;
  }
  vtkNew<vtkPoints> points;
  points->SetData(places);
  vtkNew<vtkCellArray> vertices;
  vertices->SetData(1, ids);
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetVerts(vertices);
  data->GetPointData()->SetScalars(shades);
  vtkSmartPointer<vtkActor> actor = actorOf(data);
  actor->GetProperty()->SetPointSize(size);
  return actor;
}

vtkSmartPointer<vtkProp> contourLayer(const Cloud& cloud,
                                      const std::vector<LabelContour>& contours,
                                      const ViewSettings& settings)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  for (const LabelContour& contour : contours) {
    if (!settings.shows(contour.label))
      continue;
    const vtkIdType first = points->GetNumberOfPoints();
    lines->InsertNextCell(static_cast<int>(contour.points.size()) + 1);
    for (const int index : contour.points) {
      const pcl::PointXYZ& p = cloud[static_cast<std::size_t>(index)];
      lines->InsertCellPoint(points->InsertNextPoint(p.data));
    }
    lines->InsertCellPoint(first);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(lines);
  vtkSmartPointer<vtkActor> actor = actorOf(data);
  const double shade = settings.dark ? 1.0 : 0.0;
  actor->GetProperty()->SetColor(shade, shade, shade);
  actor->GetProperty()->SetLineWidth(2.0f);
  // In front of the points that they run through.
  actor->GetMapper()->SetResolveCoincidentTopologyToPolygonOffset();
  actor->GetMapper()->SetRelativeCoincidentTopologyLineOffsetParameters(0.0, -66000.0);
  return actor;
}

} // namespace pcl_mrf_planes::viewer
