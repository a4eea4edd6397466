// SPDX-License-Identifier: BSD-3-Clause
#include "text_cells.h"

#include <iomanip>
#include <locale>
#include <sstream>

namespace pcl_mrf_planes::apps {

std::string fixed(double value, int decimals)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::fixed << std::setprecision(decimals) << value;
  return text.str();
}

std::string cell(const std::string& text, std::size_t width)
{
  return (text.size() < width ? std::string(width - text.size(), ' ') : "") + text;
}

std::string csvText(const std::string& text)
{
  if (text.find_first_of(",\"\r\n") == std::string::npos)
    return text;
  std::string quoted = "\"";
  for (const char c : text)
    quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

} // namespace pcl_mrf_planes::apps
