// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <hdf5.h>

#include <vector>

namespace pcl_mrf_planes::test {

/** \brief An array as MATLAB's v7.3 files have it: the last dimension first. */
inline void writeArray(hid_t file, const char* name, hid_t type,
                       const std::vector<hsize_t>& shape, const void* values)
{
  const hid_t space =
      H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
  const hid_t data =
      H5Dcreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
  H5Dclose(data);
  H5Sclose(space);
}

} // namespace pcl_mrf_planes::test
