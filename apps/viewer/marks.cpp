// SPDX-License-Identifier: BSD-3-Clause
#include "marks.h"

#include <vtkBillboardTextActor3D.h>
#include <vtkCallbackCommand.h>
#include <vtkNew.h>
#include <vtkPropCollection.h>
#include <vtkRenderer.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

namespace pcl_mrf_planes::viewer {

namespace {

/// A mark's plate in the window, pixels.
struct Plate {
  Eigen::Vector2d middle;
  Eigen::Vector2d extent;

  bool hides(const Plate& other) const
  {
    const Eigen::Array2d off = (middle - other.middle).array().abs();
    return (off < 0.5 * (extent + other.extent).array()).all();
  }
};

/// Where a mark goes when its place is taken, in plates: the nearest first.
constexpr std::array<std::array<int, 2>, 13> WAYS_OUT = {{{0, 0},
                                                          {0, 1},
                                                          {0, -1},
                                                          {1, 0},
                                                          {-1, 0},
                                                          {1, 1},
                                                          {-1, 1},
                                                          {1, -1},
                                                          {-1, -1},
                                                          {0, 2},
                                                          {0, -2},
                                                          {2, 0},
                                                          {-2, 0}}};

/// As VTK's Arial draws it, a little more rather than less.
Eigen::Vector2d extentOf(vtkBillboardTextActor3D* mark)
{
  const double size = mark->GetTextProperty()->GetFontSize();
  return {0.65 * size * static_cast<double>(std::strlen(mark->GetInput())) + 2.0,
          1.2 * size};
}

Eigen::Vector2d placeInWindow(vtkRenderer* renderer, const double* place)
{
  renderer->SetWorldPoint(place[0], place[1], place[2], 1.0);
  renderer->WorldToDisplay();
  return Eigen::Map<const Eigen::Vector2d>(renderer->GetDisplayPoint());
}

void spread(vtkRenderer* renderer)
{
  std::vector<Plate> taken;
  vtkPropCollection* props = renderer->GetViewProps();
  vtkCollectionSimpleIterator next;
  props->InitTraversal(next);
  while (vtkProp* prop = props->GetNextProp(next)) {
    auto* mark = vtkBillboardTextActor3D::SafeDownCast(prop);
    if (mark == nullptr)
      continue;
    const Eigen::Vector2d extent = extentOf(mark);
    const Plate home{placeInWindow(renderer, mark->GetPosition()), extent};
    const auto moved = [&](const std::array<int, 2>& way) {
      const Eigen::Vector2d by(way[0] * extent.x(), way[1] * extent.y());
      return Plate{home.middle + by, extent};
    };
    const auto* way =
        std::find_if(WAYS_OUT.begin(), WAYS_OUT.end(), [&](const auto& w) {
          return std::none_of(taken.begin(), taken.end(), [&](const Plate& other) {
            return moved(w).hides(other);
          });
        });
    const Plate plate = moved(way == WAYS_OUT.end() ? WAYS_OUT[0] : *way);
    const Eigen::Vector2d by = plate.middle - home.middle;
    mark->SetDisplayOffset(static_cast<int>(std::lround(by.x())),
                           static_cast<int>(std::lround(by.y())));
    taken.push_back(plate);
  }
}

} // namespace

void dressText(vtkTextProperty* property, bool dark)
{
  const double shade = dark ? 1.0 : 0.0;
  property->SetColor(shade, shade, shade);
  property->SetBackgroundColor(1.0 - shade, 1.0 - shade, 1.0 - shade);
  property->SetBackgroundOpacity(0.7);
}

vtkSmartPointer<vtkProp> markAt(const Eigen::Vector3d& place, const std::string& word,
                                bool dark, int font_size)
{
  auto actor = vtkSmartPointer<vtkBillboardTextActor3D>::New();
  actor->SetInput(word.c_str());
  actor->SetPosition(place.x(), place.y(), place.z());
  vtkTextProperty* property = actor->GetTextProperty();
  dressText(property, dark);
  property->SetFontSize(font_size);
  property->BoldOn();
  property->SetJustificationToCentered();
  property->SetVerticalJustificationToCentered();
  return actor;
}

void keepMarksApart(vtkRenderer* renderer)
{
  vtkNew<vtkCallbackCommand> before;
  before->SetCallback([](vtkObject* caller, unsigned long, void*, void*) {
    spread(static_cast<vtkRenderer*>(caller));
  });
  renderer->AddObserver(vtkCommand::StartEvent, before);
}

} // namespace pcl_mrf_planes::viewer
