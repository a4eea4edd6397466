// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace pcl_mrf_planes::io {

/** \brief While there is one, PCL prints nothing: what it would say is said by the
 * errors that are thrown, or is no error at all. For several threads. */
class QuietPcl {
public:
  QuietPcl();
  ~QuietPcl();
  QuietPcl(const QuietPcl&) = delete;
  QuietPcl& operator=(const QuietPcl&) = delete;
};

} // namespace pcl_mrf_planes::io
