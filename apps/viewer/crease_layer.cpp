// SPDX-License-Identifier: BSD-3-Clause
#include "layers.h"
#include "marks.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>

namespace pcl_mrf_planes::viewer {

namespace {

bool isShown(const PlaneCrease& crease, const ViewSettings& settings)
{
  return settings.shows(static_cast<std::uint16_t>(crease.first + 1)) &&
         settings.shows(static_cast<std::uint16_t>(crease.second + 1));
}

/// Vermilion and blue of Okabe and Ito, which nobody takes for each other.
const double* colourOf(const PlaneCrease& crease)
{
  static constexpr double CONVEX[] = {213.0, 94.0, 0.0};
  static constexpr double CONCAVE[] = {0.0, 114.0, 178.0};
  return crease.convex ? CONVEX : CONCAVE;
}

vtkSmartPointer<vtkPolyData> linesOf(const std::vector<PlaneCrease>& creases,
                                     const ViewSettings& settings)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkUnsignedCharArray> shades;
  shades->SetNumberOfComponents(3);
  for (const PlaneCrease& crease : creases) {
    if (!isShown(crease, settings))
      continue;
    lines->InsertNextCell(2);
    lines->InsertCellPoint(points->InsertNextPoint(crease.start.data()));
    lines->InsertCellPoint(points->InsertNextPoint(crease.end.data()));
    shades->InsertNextTuple(colourOf(crease));
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetLines(lines);
  data->GetCellData()->SetScalars(shades);
  return data;
}

/// \a nearness: how far in front of the points that the lines run through.
vtkSmartPointer<vtkActor> lineActor(vtkPolyData* data, float width, double nearness)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  mapper->SetRelativeCoincidentTopologyLineOffsetParameters(0.0, -nearness);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetLineWidth(width);
  return actor;
}

} // namespace

Props creaseLayer(const std::vector<PlaneCrease>& creases, const ViewSettings& settings)
{
  const vtkSmartPointer<vtkPolyData> lines = linesOf(creases, settings);
  // A rim sets them off from a plane of their own colour.
  const vtkSmartPointer<vtkActor> rim = lineActor(lines, 7.0f, 66000.0);
  rim->GetMapper()->ScalarVisibilityOff();
  const double shade = settings.dark ? 1.0 : 0.0;
  rim->GetProperty()->SetColor(shade, shade, shade);
  return {rim, lineActor(lines, 4.0f, 70000.0)};
}

Props angleMarks(const std::vector<PlaneCrease>& creases, const ViewSettings& settings)
{
  constexpr double DEGREES = 57.29577951308232; // a radian
  Props marks;
  for (const PlaneCrease& crease : creases)
    if (isShown(crease, settings))
      marks.push_back(
          markAt(0.5 * (crease.start + crease.end),
                 std::to_string(std::lround(DEGREES * crease.angle)) + "\u00b0",
                 settings.dark, 13));
  return marks;
}

} // namespace pcl_mrf_planes::viewer
