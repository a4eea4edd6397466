// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/parameters.h>

#include <pcl_mrf_planes/parameter_table.h>

#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>

namespace pcl_mrf_planes {

namespace {

constexpr double LARGEST_NOISE = 1e6; // metres

/// Appends the first complaint only: one clear sentence helps more than ten.
class RangeCheck {
public:
  void check(const char* name, double value, double low, double high)
  {
    // Written so that NaN fails.
    if (!message_.empty() || (value >= low && value <= high))
      return;
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text << name << " is " << value << "; choose a value from " << low << " to "
         << high;
    message_ = text.str();
  }
  const std::string& message() const { return message_; }

private:
  std::string message_;
};

} // namespace

Parameters Parameters::fromProfile(Profile profile)
{
  Parameters parameters;
  parameters.method = profile == Profile::PAPER ? Method::PAPER : Method::ADAPTIVE;
  if (profile == Profile::FAST) {
    AdaptiveParameters& adaptive = parameters.adaptive;
    adaptive.sampling = 3;
    adaptive.least_samples = 12000;
    // As large in the image as the three first tiles and half the window of all points.
    adaptive.levels = 3;
    adaptive.local_reach = 1;
    adaptive.min_points = 13;
    adaptive.min_evidence = 200.0;
    adaptive.bend_angle = 24.0;
    adaptive.support_reach = 2;
    adaptive.none_cost = 4.0;
  }
  return parameters;
}

std::string Parameters::validate() const
{
  RangeCheck range;
  for (const ParameterEntry& entry : parameterTable())
    if (entry.choices.empty())
      range.check(entry.name.c_str(), entry.get(*this), entry.low, entry.high);
  range.check("smallest_level", adaptive.smallest_level, 0,
              std::max(adaptive.levels, 1) - 1);
  if (!range.message().empty())
    return range.message();
  if (adaptive.fan_parts == 1)
    return "fan_parts is 1; choose 0 for off, or 2 and more: one plane is no row";
  const double probe = noise.sigma(1.0);
  if (std::isnan(probe) || std::isnan(noise.sigma(10.0)) || probe <= 0.0)
    return "noise gives no positive standard deviation at 1 m; choose a preset or "
           "coefficients a, b, c with a + b + c > 0";
  if (method == Method::ADAPTIVE && !adaptive.estimate_noise &&
      !(noise.sigma(1.0) < LARGEST_NOISE && noise.sigma(10.0) < LARGEST_NOISE))
    return "noise has no limit, so that every plane would fit; choose a preset other "
           "than "
           "none, or estimate the noise from the cloud";
  return {};
}

} // namespace pcl_mrf_planes
