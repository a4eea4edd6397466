// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace pcl_mrf_planes::benchmarks {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

/** \brief One label for each point, row by row: 0 no plane, k plane k. */
using Labels = std::vector<std::uint16_t>;

/** \brief Parameters of a method by name; the units stand at the method. */
using Values = std::map<std::string, double>;

/** \brief Parameters under a name: "published" or "tuned". */
struct Setting {
  std::string name;
  std::string description; ///< where the values are from
  Values values;
};

/** \brief A method that is compared. */
struct Peer {
  std::string name; ///< as in the CSV and in --methods
  std::string description;
  std::vector<Setting> settings; ///< the last is what --try starts from

  /** \brief Segment an organized cloud, on one core, the same labels on every call.
   * \param[out] milliseconds from points in the form that the method takes to labels
   *             in the form that it gives; normals are part of it
   */
  std::function<Labels(const Cloud::ConstPtr& cloud, const Values& values,
                       double& milliseconds)>
      segment;
};

/** \brief Milliseconds since it was made. */
class Stopwatch {
public:
  double milliseconds() const
  {
    return std::chrono::duration<double, std::milli>(Clock::now() - start_).count();
  }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

} // namespace pcl_mrf_planes::benchmarks
