// SPDX-License-Identifier: BSD-3-Clause
#include "layers.h"
#include "marks.h"

#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkProperty2D.h>
#include <vtkScalarBarActor.h>
#include <vtkTextProperty.h>

namespace pcl_mrf_planes::viewer {

namespace {

constexpr int SHADES = 256;

vtkSmartPointer<vtkLookupTable> tableOf(const ColourScale& scale)
{
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(SHADES);
  table->SetTableRange(scale.low, scale.high);
  for (int k = 0; k < SHADES; ++k) {
    const io::Colour c = rampColour(k / (SHADES - 1.0));
    table->SetTableValue(k, c[0] / 255.0, c[1] / 255.0, c[2] / 255.0);
  }
  return table;
}

} // namespace

vtkSmartPointer<vtkProp> scaleLayer(const ColourScale& scale, double right, bool dark)
{
  auto bar = vtkSmartPointer<vtkScalarBarActor>::New();
  bar->SetLookupTable(tableOf(scale));
  bar->SetMaximumNumberOfColors(SHADES);
  bar->SetNumberOfLabels(5);
  bar->SetLabelFormat(scale.high < 10.0 ? "%.2f" : "%.0f");
  bar->UnconstrainedFontSizeOn();
  bar->SetBarRatio(0.3);
  bar->DrawBackgroundOn();
  const double plate = dark ? 0.0 : 1.0;
  bar->GetBackgroundProperty()->SetColor(plate, plate, plate);
  bar->GetBackgroundProperty()->SetOpacity(0.7);
  bar->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  bar->SetPosition(right - 0.07, 0.42);
  bar->SetWidth(0.06);
  bar->SetHeight(0.5);
  vtkTextProperty* labels = bar->GetLabelTextProperty();
  dressText(labels, dark);
  labels->SetBackgroundOpacity(0.0);
  labels->SetFontSize(14);
  labels->ShadowOff();
  labels->ItalicOff();
  labels->BoldOff();
  return bar;
}

} // namespace pcl_mrf_planes::viewer
