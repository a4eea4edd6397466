// SPDX-License-Identifier: BSD-3-Clause
#include "layers.h"

#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkChartXY.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPen.h>
#include <vtkPlot.h>
#include <vtkPlotPoints.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

#include <algorithm>

namespace pcl_mrf_planes::viewer {

namespace {

void dressAxis(vtkAxis* axis, const char* title, double low, double high, bool dark)
{
  const double shade = dark ? 1.0 : 0.0;
  axis->SetTitle(title);
  axis->SetBehavior(vtkAxis::FIXED);
  axis->SetRange(low, high);
  axis->GetTitleProperties()->SetColor(shade, shade, shade);
  axis->GetLabelProperties()->SetColor(shade, shade, shade);
  const auto gray = static_cast<unsigned char>(dark ? 230 : 30);
  axis->GetPen()->SetColor(gray, gray, gray);
  axis->GetGridPen()->SetColor(128, 128, 128, 90);
}

/// Whole numbers only: there is nothing between two iterations.
void countIterations(vtkAxis* axis, int last)
{
  vtkNew<vtkDoubleArray> places;
  vtkNew<vtkStringArray> names;
  for (int k = 0; k <= last; k += std::max(1, last / 8)) {
    places->InsertNextValue(k);
    names->InsertNextValue(std::to_string(k));
  }
  axis->SetCustomTickPositions(places, names);
}

} // namespace

vtkSmartPointer<vtkProp> energyLayer(const std::vector<double>& energy, int shown,
                                     bool dark)
{
  vtkNew<vtkTable> table;
  vtkNew<vtkFloatArray> iterations, energies;
  iterations->SetName("iterations");
  energies->SetName("energy");
  table->AddColumn(iterations);
  table->AddColumn(energies);
  const int count = std::min(shown + 1, static_cast<int>(energy.size()));
  table->SetNumberOfRows(count);
  for (int k = 0; k < count; ++k) {
    table->SetValue(k, 0, k);
    table->SetValue(k, 1, energy[static_cast<std::size_t>(k)]);
  }
  vtkNew<vtkChartXY> chart;
  const auto plate = static_cast<unsigned char>(dark ? 0 : 255);
  chart->GetBackgroundBrush()->SetColor(plate, plate, plate, 190);
  if (count > 0) {
    // A line needs two points.
    vtkPlot* plot = chart->AddPlot(count > 1 ? vtkChart::LINE : vtkChart::POINTS);
    plot->SetInputData(table, 0, 1);
    plot->SetColor(230, 159, 0, 255); // orange of Okabe and Ito, on dark and on light
    plot->SetWidth(3.0f);
    vtkPlotPoints::SafeDownCast(plot)->SetMarkerStyle(vtkPlotPoints::CIRCLE);
  }
  const double high =
      energy.empty() ? 1.0 : *std::max_element(energy.begin(), energy.end());
  const double low =
      energy.empty() ? 0.0 : *std::min_element(energy.begin(), energy.end());
  const double margin = 0.05 * std::max(high - low, 1e-9);
  const double last = std::max(1.0, static_cast<double>(energy.size()) - 1.0);
  dressAxis(chart->GetAxis(vtkAxis::BOTTOM), "iterations", -0.03 * last, 1.03 * last,
            dark);
  dressAxis(chart->GetAxis(vtkAxis::LEFT), "energy", low - margin, high + margin, dark);
  countIterations(chart->GetAxis(vtkAxis::BOTTOM), static_cast<int>(energy.size()) - 1);
  auto actor = vtkSmartPointer<vtkContextActor>::New();
  actor->GetScene()->AddItem(chart);
  return actor;
}

} // namespace pcl_mrf_planes::viewer
