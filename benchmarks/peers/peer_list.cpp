// SPDX-License-Identifier: BSD-3-Clause
#include "peer_list.h"

namespace pcl_mrf_planes::benchmarks {

std::vector<Peer> allPeers()
{
  std::vector<Peer> peers = {makeOurs(), makePclMultiPlane(), makePclRansac(),
                             makePeac(), makeCape(),          makePlanarPatches()};
#ifdef PCL_MRF_PLANES_WITH_OPENCV
  peers.push_back(makeOpencvPlane());
#endif
#ifdef PCL_MRF_PLANES_WITH_CGAL
  peers.push_back(makeCgalRansac());
#endif
  return peers;
}

std::vector<std::string> peersLeftOut()
{
  std::vector<std::string> names;
#ifndef PCL_MRF_PLANES_WITH_OPENCV
  names.emplace_back("opencv_rgbd_plane (needs libopencv-dev, libopencv-contrib-dev)");
#endif
#ifndef PCL_MRF_PLANES_WITH_CGAL
  names.emplace_back("cgal_efficient_ransac (needs libcgal-dev)");
#endif
  return names;
}

} // namespace pcl_mrf_planes::benchmarks
