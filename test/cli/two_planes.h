// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/PCLPointCloud2.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstdint>
#include <cstring>
#include <string>

namespace pcl_mrf_planes::test {

/** \brief What a depth camera sees of a wall 2 m away and a floor, in the world frame,
 * with more fields than a segmentation needs.
 *
 * The wall fills the rows above FLOOR_ROW and is the larger plane; points of every
 * 50th index and of a block in the upper left corner are invalid.
 */
struct TwoPlanes {
  static constexpr int WIDTH = 160;
  static constexpr int HEIGHT = 120;
  static constexpr int FLOOR_ROW = 80;
  static constexpr std::size_t POINTS = WIDTH * HEIGHT;

  pcl::PCLPointCloud2 cloud; ///< x y z rgb ring time tag[3] label
  Eigen::Vector4f origin = Eigen::Vector4f(1.2345678f, -20.000001f, 3.5f, 0.0f);
  Eigen::Quaternionf orientation = Eigen::Quaternionf(
      Eigen::AngleAxisf(0.4f, Eigen::Vector3f(1.0f, 2.0f, -1.0f).normalized()));

  TwoPlanes();

  /** \brief Whether point \a i is a measured one. */
  static bool valid(std::size_t i);
  /** \brief 1 the wall, 2 the floor. */
  static std::uint32_t label(std::size_t i) { return i / WIDTH < FLOOR_ROW ? 1 : 2; }
  /** \brief Red, green and blue of point \a i. */
  static std::uint32_t colour(std::size_t i);

  /** \brief Write as ascii, binary or binary_compressed. */
  void write(const std::string& path, const std::string& format) const;
};

/** \brief The field of that name, or null. */
const pcl::PCLPointField* findField(const pcl::PCLPointCloud2& cloud,
                                    const std::string& name);

/** \brief Add a field behind the others. */
void addField(pcl::PCLPointCloud2& cloud, const std::string& name,
              std::uint8_t datatype, std::uint32_t count, std::uint32_t size);

/** \brief Put a value into a field of point \a i. */
template <typename T>
void setField(pcl::PCLPointCloud2& cloud, std::size_t i, const std::string& name,
              T value, std::size_t element = 0)
{
  std::memcpy(&cloud.data[i * cloud.point_step + findField(cloud, name)->offset +
                          element * sizeof value],
              &value, sizeof value);
}

/** \brief The value of a field of point \a i. */
template <typename T>
T getField(const pcl::PCLPointCloud2& cloud, std::size_t i, const std::string& name,
           std::size_t element = 0)
{
  T value{};
  std::memcpy(&value,
              &cloud.data[i * cloud.point_step + findField(cloud, name)->offset +
                          element * sizeof value],
              sizeof value);
  return value;
}

} // namespace pcl_mrf_planes::test
