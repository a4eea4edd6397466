// SPDX-License-Identifier: BSD-3-Clause
#include "label_colours.h"
#include "layers.h"
#include "polygon_mesh.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>

namespace pcl_mrf_planes::viewer {

namespace {

constexpr double FILLED = 0.5; // opacity

// In steps of a depth buffer of 16 bits.
constexpr double OVER_NOISE = 1000.0; // of the points that a polygon lies among
constexpr double OVER_ALL = 66000.0;

bool isShown(std::size_t k, const ViewSettings& settings)
{
  return settings.shows(static_cast<std::uint16_t>(k + 1));
}

/// \a nearness: how far in front of where it is it is drawn.
vtkSmartPointer<vtkActor> actorOf(vtkPolyData* data, double nearness)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(0.0, -nearness);
  mapper->SetRelativeCoincidentTopologyLineOffsetParameters(0.0, -nearness);
  mapper->SetRelativeCoincidentTopologyPointOffsetParameter(-nearness);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  return actor;
}

/// Rings as closed lines, and a dot on every corner of them.
class Rings {
public:
  explicit Rings(double shade)
  : shade_(shade)
  {
    colours_->SetNumberOfComponents(3);
  }

  void add(const PlaneRing& ring, const io::Colour& colour)
  {
    if (ring.empty())
      return;
    apps::addRing(ring, *points_, *lines_);
    colours_->InsertNextTypedTuple(colour.data());
  }

  /// In their colours, or all in that of the strokes.
  vtkSmartPointer<vtkActor> draw(float width, double nearness, bool coloured) const
  {
    vtkNew<vtkPolyData> data;
    data->SetPoints(points_);
    data->SetLines(lines_);
    data->GetCellData()->SetScalars(colours_);
    vtkSmartPointer<vtkActor> actor = actorOf(data, nearness);
    actor->GetMapper()->SetScalarVisibility(coloured ? 1 : 0);
    actor->GetProperty()->SetColor(shade_, shade_, shade_);
    actor->GetProperty()->SetLineWidth(width);
    return actor;
  }

  vtkSmartPointer<vtkActor> drawCorners(float size, double nearness) const
  {
    vtkNew<vtkCellArray> dots;
    for (vtkIdType k = 0; k < points_->GetNumberOfPoints(); ++k)
      dots->InsertNextCell({k});
    vtkNew<vtkPolyData> data;
    data->SetPoints(points_);
    data->SetVerts(dots);
    vtkSmartPointer<vtkActor> actor = actorOf(data, nearness);
    actor->GetProperty()->SetColor(shade_, shade_, shade_);
    actor->GetProperty()->SetPointSize(size);
    return actor;
  }

private:
  double shade_; ///< of strokes
  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> lines_;
  vtkNew<vtkUnsignedCharArray> colours_;
};

Props polygons(const std::vector<RegionOutline>& outlines,
               const std::vector<io::Colour>& colours, double shade)
{
  Rings rings(shade);
  for (const RegionOutline& outline : outlines)
    for (const PlanePolygon& patch : outline.patches) {
      rings.add(patch.outer, {});
      for (const PlaneRing& hole : patch.holes)
        rings.add(hole, {});
    }
  const vtkSmartPointer<vtkActor> filled =
      actorOf(apps::polygonMesh(outlines, colours), OVER_NOISE);
  filled->GetProperty()->SetOpacity(FILLED);
  return {filled, rings.draw(1.0f, OVER_ALL, false), rings.drawCorners(3.0f, OVER_ALL)};
}

Props hulls(const std::vector<RegionOutline>& outlines,
            const std::vector<io::Colour>& colours, double shade)
{
  Rings rings(shade);
  for (std::size_t k = 0; k < outlines.size(); ++k)
    rings.add(outlines[k].hull, colours[k]);
  // A rim sets them off from a plane of their own colour.
  return {rings.draw(5.0f, OVER_ALL, false), rings.draw(3.0f, OVER_ALL, true)};
}

} // namespace

Props shapeLayer(const std::vector<RegionOutline>& outlines,
                 const std::vector<std::uint32_t>& classes,
                 const ViewSettings& settings)
{
  std::vector<RegionOutline> shown;
  std::vector<io::Colour> colours;
  for (std::size_t k = 0; k < outlines.size() && k < classes.size(); ++k) {
    if (!isShown(k, settings))
      continue;
    shown.push_back(outlines[k]);
    colours.push_back(apps::labelColour(classes[k]));
  }
  const double shade = settings.dark ? 1.0 : 0.0;
  return settings.shapes == Shapes::HULLS ? hulls(shown, colours, shade)
                                          : polygons(shown, colours, shade);
}

} // namespace pcl_mrf_planes::viewer
