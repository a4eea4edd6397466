// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/impl/mrf_plane_segmentation.hpp>

#include <pcl/impl/instantiate.hpp>
#include <pcl/impl/pcl_base.hpp>
#include <pcl/point_types.h>

PCL_INSTANTIATE(MRFPlaneSegmentation, PCL_XYZ_POINT_TYPES)
