// SPDX-License-Identifier: BSD-3-Clause
#include "integral_normals.h"

#include <pcl/features/integral_image_normal.h>

namespace pcl_mrf_planes::benchmarks {

pcl::PointCloud<pcl::Normal>::Ptr integralNormals(const Cloud::ConstPtr& cloud,
                                                  const Values& values)
{
  pcl::IntegralImageNormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setNormalEstimationMethod(estimation.COVARIANCE_MATRIX);
  estimation.setMaxDepthChangeFactor(static_cast<float>(values.at("depth_change")));
  estimation.setNormalSmoothingSize(static_cast<float>(values.at("smoothing")));
  estimation.setInputCloud(cloud);
  pcl::PointCloud<pcl::Normal>::Ptr normals(new pcl::PointCloud<pcl::Normal>);
  estimation.compute(*normals);
  return normals;
}

} // namespace pcl_mrf_planes::benchmarks
