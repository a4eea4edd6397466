// SPDX-License-Identifier: BSD-3-Clause
#include "label_colours.h"
#include "layers.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>

namespace pcl_mrf_planes::viewer {

namespace {

constexpr double SHRUNK = 0.9; // share of a tile's side: neighbours stay apart

using Corners = std::array<Eigen::Vector3d, 4>;

/// The valid point nearest to a corner on the way to the middle of the tile.
bool findCorner(const ViewFrame& frame, int x, int y, int to_x, int to_y,
                Eigen::Vector3d& corner)
{
  constexpr int STEPS = 16;
  for (int k = 0; k <= STEPS; ++k) {
    const int px = x + (to_x - x) * k / STEPS;
    const int py = y + (to_y - y) * k / STEPS;
    const int pixel = py * frame.points.width + px;
    const auto i = static_cast<std::size_t>(pixel);
    if (frame.points.valid[i] == 0)
      continue;
    corner = (*frame.cloud)[i].getVector3fMap().cast<double>();
    return true;
  }
  return false;
}

bool cornersOf(const ViewFrame& frame, const StageTile& tile, Corners& corners)
{
  const int left = tile.x;
  const int top = tile.y;
  const int right = left + tile.width - 1;
  const int bottom = top + tile.height - 1;
  const std::array<std::array<int, 2>, 4> places = {
      {{left, top}, {right, top}, {right, bottom}, {left, bottom}}};
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < 4; ++k) {
    if (!findCorner(frame, places[k][0], places[k][1], (left + right) / 2,
                    (top + bottom) / 2, corners[k]))
      return false;
    middle += corners[k] / 4.0;
  }
  for (Eigen::Vector3d& corner : corners)
    corner = middle + SHRUNK * (corner - middle);
  return true;
}

void addCell(const Corners& corners, bool closed, vtkPoints* points,
             vtkCellArray* cells)
{
  const vtkIdType first = points->GetNumberOfPoints();
  cells->InsertNextCell(closed ? 5 : 4);
  for (const Eigen::Vector3d& corner : corners)
    cells->InsertCellPoint(points->InsertNextPoint(corner.data()));
  if (closed)
    cells->InsertCellPoint(first);
}

vtkSmartPointer<vtkActor> flatActor(vtkPolyData* data, double opacity)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetOpacity(opacity);
  actor->GetProperty()->SetColor(0.6, 0.6, 0.6);
  // In front of the points that they lie on.
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(0.0, -66000.0);
  mapper->SetRelativeCoincidentTopologyLineOffsetParameters(0.0, -66000.0);
  return actor;
}

} // namespace

Props tileLayer(const ViewFrame& frame, const TileCells& cells)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> kept, refused;
  vtkNew<vtkUnsignedCharArray> shades;
  shades->SetNumberOfComponents(3);
  for (const StageTile& tile : cells.tiles) {
    Corners corners;
    if (!cornersOf(frame, tile, corners))
      continue;
    const bool merged = tile.merged != StageTile::NONE;
    addCell(corners, !merged, points, merged ? kept : refused);
    if (merged) {
      const io::Colour c =
          apps::labelColour(cells.classes[static_cast<std::size_t>(tile.merged)]);
      shades->InsertNextTuple3(c[0], c[1], c[2]);
    }
  }
  vtkNew<vtkPolyData> filled, outlines;
  filled->SetPoints(points);
  filled->SetPolys(kept);
  filled->GetCellData()->SetScalars(shades);
  outlines->SetPoints(points);
  outlines->SetLines(refused);
  return {flatActor(filled, 1.0), flatActor(outlines, 1.0)};
}

} // namespace pcl_mrf_planes::viewer
