// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/parameters.h>

#include <cmath>
#include <locale>
#include <sstream>

namespace pcl_mrf_planes {

namespace {

constexpr double LARGEST = 1e6; // metres or 1/m: beyond it a value is a mistake

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
  switch (profile) {
  case Profile::PAPER:
    break;
  }
  return {};
}

std::string Parameters::validate() const
{
  RangeCheck range;
  range.check("tile_width", tile_width, 2, 4096);
  range.check("tile_height", tile_height, 2, 4096);
  range.check("noise_multiplier", noise_multiplier, 1e-6, LARGEST);
  range.check("min_valid_share", min_valid_share, 0, 1);
  range.check("beta", beta, 0, LARGEST);
  range.check("merge_threshold", merge_threshold, 0, LARGEST);
  range.check("max_planes", max_planes, 1, 4096);
  range.check("lambda", lambda, 0, LARGEST);
  range.check("tau", tau, 1e-6, LARGEST);
  range.check("gamma", gamma, 0, LARGEST);
  range.check("iterations", iterations, 0, 100000);
  range.check("convergence_tolerance", convergence_tolerance, -LARGEST, LARGEST);
  range.check("min_inliers", min_inliers, 0, 1e9);
  range.check("number_of_threads", number_of_threads, 0, 1024);
  if (!range.message().empty())
    return range.message();
  const double probe = noise.sigma(1.0);
  if (std::isnan(probe) || std::isnan(noise.sigma(10.0)) || probe <= 0.0)
    return "noise gives no positive standard deviation at 1 m; choose a preset or "
           "coefficients a, b, c with a + b + c > 0";
  return {};
}

} // namespace pcl_mrf_planes
