// SPDX-License-Identifier: BSD-3-Clause
#include "slider_panel.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkNew.h>
#include <vtkProperty2D.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkSliderRepresentation2D.h>
#include <vtkSliderWidget.h>
#include <vtkSmartPointer.h>
#include <vtkTextProperty.h>

#include <iomanip>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace pcl_mrf_planes::viewer {

namespace {

constexpr double LEFT = 0.02; // shares of the window
constexpr double RIGHT = 0.26;
constexpr double LOWEST = 0.11;
constexpr double SPACING = 0.068;

/// Tells which slider was dragged.
class DragCommand : public vtkCommand {
public:
  static DragCommand* New() { return new DragCommand; }
  void Execute(vtkObject* caller, unsigned long event, void*) override
  {
    if (event == vtkCommand::EndInteractionEvent) {
      released();
      return;
    }
    auto* widget = static_cast<vtkSliderWidget*>(caller);
    moved(
        index,
        static_cast<vtkSliderRepresentation*>(widget->GetRepresentation())->GetValue());
  }
  std::size_t index = 0;
  SliderPanel::Moved moved;
  SliderPanel::Released released;
};

void dress(vtkSliderRepresentation2D* look, bool dark)
{
  const double shade = dark ? 1.0 : 0.0;
  look->GetTitleProperty()->SetColor(shade, shade, shade);
  look->GetLabelProperty()->SetColor(shade, shade, shade);
  for (vtkTextProperty* text : {look->GetTitleProperty(), look->GetLabelProperty()}) {
    text->ShadowOff();
    text->ItalicOff();
    text->BoldOff();
    text->SetBackgroundColor(1.0 - shade, 1.0 - shade, 1.0 - shade);
    text->SetBackgroundOpacity(0.75);
  }
  look->GetTubeProperty()->SetColor(0.5, 0.5, 0.5);
  look->GetCapProperty()->SetColor(0.5, 0.5, 0.5);
  look->GetSliderProperty()->SetColor(0.9, 0.62, 0.0);
  look->GetSelectedProperty()->SetColor(0.34, 0.71, 0.91);
  look->SetSliderLength(0.016);
  look->SetSliderWidth(0.018);
  look->SetTubeWidth(0.006);
  look->SetEndCapLength(0.004);
  look->SetEndCapWidth(0.018);
  look->SetTitleHeight(0.018);
  look->SetLabelHeight(0.017);
}

std::string titleOf(const ParameterSlider& slider, double value)
{
  std::ostringstream text;
  text << slider.title << ": " << std::fixed
       << std::setprecision(slider.whole || value >= 100.0 ? 0 : 3) << value;
  return text.str();
}

} // namespace

struct SliderPanel::Parts {
  vtkRenderWindowInteractor* interactor;
  vtkRenderer* renderer;
  Moved moved;
  Released released;
  std::vector<vtkSmartPointer<vtkSliderWidget>> widgets;
  std::optional<Method> method; ///< that the widgets are for

  void build(Method wanted);
  void addWidget(const ParameterSlider& slider, std::size_t index, std::size_t count);
};

void SliderPanel::Parts::build(Method wanted)
{
  for (auto& widget : widgets)
    widget->Off();
  widgets.clear();
  method = wanted;
  const auto& sliders = slidersOf(wanted);
  for (std::size_t k = 0; k < sliders.size(); ++k)
    addWidget(sliders[k], k, sliders.size());
}

void SliderPanel::Parts::addWidget(const ParameterSlider& slider, std::size_t index,
                                   std::size_t count)
{
  const double y = LOWEST + SPACING * static_cast<double>(count - 1 - index);
  vtkNew<vtkSliderRepresentation2D> look;
  look->SetMinimumValue(slider.low);
  look->SetMaximumValue(slider.high);
  look->ShowSliderLabelOff(); // the value stands in the title
  look->GetPoint1Coordinate()->SetCoordinateSystemToNormalizedDisplay();
  look->GetPoint1Coordinate()->SetValue(LEFT, y);
  look->GetPoint2Coordinate()->SetCoordinateSystemToNormalizedDisplay();
  look->GetPoint2Coordinate()->SetValue(RIGHT, y);
  auto widget = vtkSmartPointer<vtkSliderWidget>::New();
  widget->SetInteractor(interactor);
  widget->SetDefaultRenderer(renderer);
  widget->SetCurrentRenderer(renderer);
  widget->SetRepresentation(look);
  widget->SetAnimationModeToJump();
  vtkNew<DragCommand> command;
  command->index = index;
  command->moved = moved;
  command->released = released;
  widget->AddObserver(vtkCommand::InteractionEvent, command);
  widget->AddObserver(vtkCommand::EndInteractionEvent, command);
  widgets.push_back(widget);
}

SliderPanel::SliderPanel(vtkRenderWindowInteractor* interactor, vtkRenderer* renderer,
                         Moved moved, Released released)
: parts_(new Parts{interactor, renderer, std::move(moved), std::move(released), {}, {}})
{}

SliderPanel::~SliderPanel() = default;

void SliderPanel::show(bool visible, const Parameters& parameters, bool dark)
{
  if (visible && parts_->method != parameters.method)
    parts_->build(parameters.method);
  for (std::size_t k = 0; k < parts_->widgets.size(); ++k) {
    vtkSliderWidget* widget = parts_->widgets[k];
    auto* look = static_cast<vtkSliderRepresentation2D*>(widget->GetRepresentation());
    if (visible) {
      dress(look, dark);
      const ParameterSlider& slider = slidersOf(parameters.method)[k];
      look->SetValue(slider.get(parameters));
      look->SetTitleText(titleOf(slider, slider.get(parameters)).c_str());
    }
    if ((widget->GetEnabled() != 0) != visible)
      widget->SetEnabled(visible ? 1 : 0);
  }
}

} // namespace pcl_mrf_planes::viewer
