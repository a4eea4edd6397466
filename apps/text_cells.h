// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

namespace pcl_mrf_planes::apps {

/** \brief A number with so many decimals, whatever the locale. */
std::string fixed(double value, int decimals);

/** \brief A cell of a table: blanks in front, at least so wide. */
std::string cell(const std::string& text, std::size_t width);

/** \brief Text as a cell of a CSV: in quotes where a reader of the file would see something
 * else than the text (RFC 4180). */
std::string csvText(const std::string& text);

} // namespace pcl_mrf_planes::apps
