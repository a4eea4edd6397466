// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/export.h>
#include <pcl_mrf_planes/parameters.h>

#include <string>
#include <variant>
#include <vector>

namespace pcl_mrf_planes {

/** \brief Who takes a parameter. */
enum class ParameterUse {
  ALL,     ///< both methods
  PAPER,   ///< Method::PAPER only
  ADAPTIVE ///< Method::ADAPTIVE only
};

/** \brief What is to be known of one value of Parameters: name, range, unit, effect.
 *
 * The one place for it: Parameters::validate(), the options of the apps, parameter files and
 * sliders all go by these. Every value is a number here; that of a choice is its place
 * among the choices, that of a switch is 0 or 1.
 */
struct PCL_MRF_PLANES_EXPORT ParameterEntry {
  /// Which value of Parameters or of its AdaptiveParameters.
  using Member = std::variant<int Parameters::*, double Parameters::*,
                              unsigned int Parameters::*, bool Parameters::*,
                              PlaneFit Parameters::*, DepthMeasure Parameters::*,
                              Smoothness Parameters::*, int AdaptiveParameters::*,
                              double AdaptiveParameters::*, bool AdaptiveParameters::*>;

  std::string name;  ///< of the member
  Member member;     ///< where the value is
  double low;        ///< least value that validate() lets pass
  double high;       ///< largest value that validate() lets pass
  double usual_low;  ///< least value that is worth trying, as the end of a slider
  double usual_high; ///< largest value that is worth trying
  std::string unit;  ///< in capitals, POINTS, METRES, SHARE (0 to 1), COUNT, ...
  std::string help;  ///< effect
  ParameterUse use = ParameterUse::ALL;  ///< by which method
  std::vector<std::string> choices = {}; ///< their names; empty for numbers

  /// Numbers without a fraction, choices among them.
  bool isWhole() const;
  /// Whether the method takes the value.
  bool isUsedBy(Method method) const;

  /** \brief The value, as a number. */
  double get(const Parameters& parameters) const;

  /** \brief Set the value; a fraction of whole numbers is cut off. A value outside of the
   * range is brought to its nearer end, NaN to the lower one. */
  void set(Parameters& parameters, double value) const;

  /** \brief The value as text: the shortest that reads back the same, or a choice. */
  std::string print(const Parameters& parameters) const;
};

/** \brief All parameters but the noise model, which is three numbers, in the order of
 * --help. */
PCL_MRF_PLANES_EXPORT const std::vector<ParameterEntry>& parameterTable();

/** \brief The entry of that name, or null. */
PCL_MRF_PLANES_EXPORT const ParameterEntry* findParameter(const std::string& name);

} // namespace pcl_mrf_planes
