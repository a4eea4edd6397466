// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/io/camera_model.h>
#include <pcl_mrf_planes/io/cloud_file.h>
#include <pcl_mrf_planes/io/frame.h>

#include <gtest/gtest.h>

#include <Eigen/Core>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace pcl_mrf_planes::test {

/** \brief A folder of its own for each test. */
class IoTest : public ::testing::Test {
protected:
  void SetUp() override;
  void TearDown() override;

  /** \brief Path of a file in the test's folder; the folders on the way are made. */
  std::string path(const std::string& name) const;
  void write(const std::string& name, const std::string& bytes) const;
  std::string read(const std::string& name) const;

  /** \brief The frames of the test's folder or of something in it. */
  io::FrameList list(const std::string& name = "",
                     const io::ReadOptions& options = {}) const;

  /** \brief The only frame of a file. */
  io::Frame frameOf(const std::string& name, const io::ReadOptions& options = {}) const;

  /** \brief That reading fails with a message that holds all of \a parts. */
  void expectError(const std::string& name, const std::vector<std::string>& parts,
                   const io::ReadOptions& options = {}) const;

private:
  std::filesystem::path folder_;
};

/** \brief Point \a i of a cloud. */
Eigen::Vector3f pointOf(const io::CloudFile& file, std::size_t i);

/** \brief Depth values of a slanted wall: 1000 + 2 column + 3 row, one in seven 0. */
std::vector<std::uint16_t> slantedWall(int width, int height);

/** \brief Write a gray PNG of 16 bits by VTK, not by the library under test. */
void writePng16(const std::string& path, const std::vector<std::uint16_t>& values,
                int width, int height);

/** \brief Write a colour PNG, red = column, green = row, blue = 33. */
void writeColourPng(const std::string& path, int width, int height);

/** \brief Bytes of a PGM of 16 bits in either byte order. */
std::string pgm16(const std::vector<std::uint16_t>& values, int width, int height,
                  bool big_endian);

/** \brief The camera looks along z, so every point lies on the ray of its place.
 * \param[in] depth metres of each point; NaN or not positive: invalid */
void expectSeenBy(const io::Frame& frame, const io::CameraModel& camera,
                  const std::vector<double>& depth);

} // namespace pcl_mrf_planes::test
