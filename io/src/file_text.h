// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <istream>
#include <string>
#include <vector>

namespace pcl_mrf_planes::io {

/** \brief All bytes of a regular file.
 * \throws std::runtime_error with what is wrong, without the file's name */
std::string readBytes(const std::string& path);

/** \brief The first bytes of a regular file, fewer when it is shorter.
 * \throws std::runtime_error as readBytes() */
std::string readStart(const std::string& path, std::size_t bytes);

/** \brief Whether \a text ends in \a end. */
bool endsIn(const std::string& text, const std::string& end);

/** \brief The words of a line, blanks between them. */
std::vector<std::string> words(const std::string& line);

/** \brief The number that makes up all of the text, whatever the locale; false if none. */
bool parseNumber(const std::string& text, double& value);

} // namespace pcl_mrf_planes::io
