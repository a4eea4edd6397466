// SPDX-License-Identifier: BSD-3-Clause
#include "polygon_mesh.h"

#include <vtkCellArray.h>
#include <vtkContourTriangulator.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>

namespace pcl_mrf_planes::apps {

namespace {

/// Triangles between the rings of a patch.
void addPatch(const PlanePolygon& patch, const std::array<std::uint8_t, 3>& colour,
              vtkPoints& points, vtkCellArray& triangles, vtkUnsignedCharArray& colours)
{
  vtkNew<vtkPoints> corners;
  corners->SetDataTypeToDouble();
  vtkNew<vtkCellArray> lines;
  addRing(patch.outer, *corners, *lines);
  for (const PlaneRing& hole : patch.holes)
    addRing(hole, *corners, *lines);
  vtkNew<vtkPolyData> rings;
  rings->SetPoints(corners);
  rings->SetLines(lines);
  vtkNew<vtkContourTriangulator> triangulator;
  triangulator->SetInputData(rings);
  triangulator->Update();
  vtkPolyData* mesh = triangulator->GetOutput();
  const vtkIdType start = points.GetNumberOfPoints();
  for (vtkIdType k = 0; k < mesh->GetNumberOfPoints(); ++k) {
    points.InsertNextPoint(mesh->GetPoint(k));
    colours.InsertNextTypedTuple(colour.data());
  }
  vtkIdType count = 0;
  const vtkIdType* ids = nullptr;
  vtkCellArray* cells = mesh->GetPolys();
  cells->InitTraversal();
  while (cells->GetNextCell(count, ids) != 0) {
    std::vector<vtkIdType> moved(ids, ids + count);
    for (vtkIdType& id : moved)
      id += start;
    triangles.InsertNextCell(count, moved.data());
  }
}

} // namespace

void addRing(const PlaneRing& ring, vtkPoints& points, vtkCellArray& lines)
{
  lines.InsertNextCell(static_cast<int>(ring.size()) + 1);
  const vtkIdType first = points.GetNumberOfPoints();
  for (const Eigen::Vector3d& corner : ring)
    lines.InsertCellPoint(points.InsertNextPoint(corner.data()));
  lines.InsertCellPoint(first);
}

vtkSmartPointer<vtkPolyData>
polygonMesh(const std::vector<RegionOutline>& outlines,
            const std::vector<std::array<std::uint8_t, 3>>& colours)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> triangles;
  vtkNew<vtkUnsignedCharArray> shades;
  shades->SetName("colour");
  shades->SetNumberOfComponents(3);
  for (std::size_t k = 0; k < outlines.size(); ++k)
    for (const PlanePolygon& patch : outlines[k].patches)
      addPatch(patch, colours[k], *points, *triangles, *shades);
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetPolys(triangles);
  mesh->GetPointData()->SetScalars(shades);
  return mesh;
}

} // namespace pcl_mrf_planes::apps
