// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/parameters.h>

#include <functional>
#include <string>
#include <vector>

namespace pcl_mrf_planes::viewer {

/** \brief A parameter as a slider. */
struct ParameterSlider {
  std::string title; ///< with the unit
  double low;
  double high;
  bool whole; ///< takes whole numbers only
  std::function<double(const Parameters&)> get;
  std::function<void(Parameters&, double)> set;
};

/** \brief The sliders of a method: what it does not take has none. */
const std::vector<ParameterSlider>& slidersOf(Method method);

/** \brief Set a parameter, within the slider's range and rounded if it is a whole one. */
void moveSlider(const ParameterSlider& slider, double value, Parameters& parameters);

} // namespace pcl_mrf_planes::viewer
