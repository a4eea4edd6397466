// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cstdint>
#include <ctime>
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
   * \param[out] milliseconds of processor time from points in the form that the method
   *             takes to labels in the form that it gives, normals included
   */
  std::function<Labels(const Cloud::ConstPtr& cloud, const Values& values,
                       double& milliseconds)>
      segment;
};

/** \brief Processor time of this program since it was made: on one core the same as time
 * by the clock, but other programs on the machine do not count. */
class Stopwatch {
public:
  double milliseconds() const
  {
    return 1000.0 * static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC;
  }

private:
  std::clock_t start_ = std::clock();
};

} // namespace pcl_mrf_planes::benchmarks
