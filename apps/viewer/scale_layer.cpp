// SPDX-License-Identifier: BSD-3-Clause
#include "layers.h"
#include "marks.h"

#include <vtkActor2D.h>
#include <vtkCoordinate.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkScalarBarActor.h>
#include <vtkTextProperty.h>

namespace pcl_mrf_planes::viewer {

namespace {

constexpr int SHADES = 256;
constexpr double BOTTOM = 0.42; // shares of the window
constexpr double HEIGHT = 0.5;

vtkSmartPointer<vtkLookupTable> tableOf(const ColourScale& scale)
{
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(SHADES);
  table->SetTableRange(scale.low, scale.high);
  if (scale.logarithmic)
    table->SetScaleToLog10();
  for (int k = 0; k < SHADES; ++k) {
    const io::Colour c = rampColour(k / (SHADES - 1.0));
    table->SetTableValue(k, c[0] / 255.0, c[1] / 255.0, c[2] / 255.0);
  }
  return table;
}

/// A little more than the bar and its numbers need; the bar's own one ends at their middle.
vtkSmartPointer<vtkProp> plateBehind(double left, double right, bool dark)
{
  vtkNew<vtkPlaneSource> plate;
  plate->SetOrigin(left, BOTTOM - 0.025, 0.0);
  plate->SetPoint1(right, BOTTOM - 0.025, 0.0);
  plate->SetPoint2(left, BOTTOM + HEIGHT + 0.025, 0.0);
  vtkNew<vtkCoordinate> shares;
  shares->SetCoordinateSystemToNormalizedViewport();
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputConnection(plate->GetOutputPort());
  mapper->SetTransformCoordinate(shares);
  auto actor = vtkSmartPointer<vtkActor2D>::New();
  actor->SetMapper(mapper);
  const double shade = dark ? 0.0 : 1.0;
  actor->GetProperty()->SetColor(shade, shade, shade);
  actor->GetProperty()->SetOpacity(0.7);
  return actor;
}

} // namespace

Props scaleLayer(const ColourScale& scale, double right, bool dark)
{
  auto bar = vtkSmartPointer<vtkScalarBarActor>::New();
  bar->SetLookupTable(tableOf(scale));
  bar->SetMaximumNumberOfColors(SHADES);
  bar->SetNumberOfLabels(5);
  bar->SetLabelFormat(scale.high < 10.0 ? "%.2f" : "%.0f");
  bar->UnconstrainedFontSizeOn();
  bar->SetBarRatio(0.3);
  bar->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  bar->SetPosition(right - 0.07, BOTTOM);
  bar->SetWidth(0.06);
  bar->SetHeight(HEIGHT);
  vtkTextProperty* labels = bar->GetLabelTextProperty();
  dressText(labels, dark);
  labels->SetBackgroundOpacity(0.0);
  labels->SetFontSize(14);
  labels->ShadowOff();
  labels->ItalicOff();
  labels->BoldOff();
  return {plateBehind(right - 0.075, right - 0.003, dark), bar};
}

} // namespace pcl_mrf_planes::viewer
