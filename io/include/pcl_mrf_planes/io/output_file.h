// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/export.h>

#include <functional>
#include <string>

namespace pcl_mrf_planes::io {

/** \brief Write a file so that it is there whole or not at all.
 *
 * \a write gets the name of a temporary file beside the target, with the target's
 * extension. On success that file takes the target's place; on failure it is removed
 * and the target stays as it was. A link is followed; into a device or pipe the
 * finished file is copied.
 *
 * \param[in] path the file to write
 * \param[in] write writes the file that it is given the name of, throws if it cannot
 * \throws std::runtime_error with a sentence that says what to do
 */
PCL_MRF_PLANES_EXPORT void
writeAtomically(const std::string& path,
                const std::function<void(const std::string& temporary)>& write);

/** \brief Write bytes so that the file is there whole or not at all.
 * \throws std::runtime_error with a sentence that says what to do */
PCL_MRF_PLANES_EXPORT void writeBytes(const std::string& path,
                                      const std::string& bytes);

/** \brief Remove the temporary files of every writeAtomically() that is under way.
 *
 * For a signal handler that ends the program: calls nothing but unlink(). */
PCL_MRF_PLANES_EXPORT void removePartialFiles();

/** \brief Throw what writeAtomically() would throw for a target that cannot be written,
 * before the work that leads to it. Leaves no trace. */
PCL_MRF_PLANES_EXPORT void checkWritable(const std::string& path);

} // namespace pcl_mrf_planes::io
