// SPDX-License-Identifier: BSD-3-Clause
#include "option_values.h"

#include <cmath>
#include <limits>
#include <locale>
#include <sstream>

namespace pcl_mrf_planes::apps {

namespace {

template <typename T>
bool parseWhole(const std::string& text, T& value)
{
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  return stream >> std::noskipws >> value && stream.peek() == EOF;
}

} // namespace

bool parseNumber(const std::string& text, double& value)
{
  return parseWhole(text, value);
}

bool parseNumber(const std::string& text, int& value)
{
  return parseWhole(text, value);
}

double parseReal(const std::string& option, const std::string& text)
{
  double value = 0.0;
  if (!parseNumber(text, value) || !std::isfinite(value))
    throw UsageError("--" + option + " is '" + text +
                     "'; give a number such as 0.5 or 1e-3");
  return value;
}

int parseInteger(const std::string& option, const std::string& text, int low, int high)
{
  int value = 0;
  const bool any = low == std::numeric_limits<int>::min();
  if (!parseNumber(text, value) || value < low || value > high)
    throw UsageError(
        "--" + option + " is '" + text + "'; give a whole number" +
        (any ? std::string()
             : " from " + std::to_string(low) + " to " + std::to_string(high)));
  return value;
}

std::string printReal(double value)
{
  for (int digits = 6;; ++digits) {
    std::ostringstream stream;
    stream.imbue(std::locale::classic());
    stream.precision(digits);
    stream << value;
    double back = 0.0;
    if (digits >= std::numeric_limits<double>::max_digits10 ||
        (parseNumber(stream.str(), back) && back == value))
      return stream.str();
  }
}

std::string join(const std::vector<std::string>& words, const char* between)
{
  std::string result;
  for (const std::string& word : words)
    result += (result.empty() ? "" : between) + word;
  return result;
}

} // namespace pcl_mrf_planes::apps
