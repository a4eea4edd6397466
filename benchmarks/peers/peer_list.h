// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "peer.h"

#include <string>
#include <vector>

namespace pcl_mrf_planes::benchmarks {

/** \brief All methods that this program was built with, ours first. */
std::vector<Peer> allPeers();

/** \brief Methods whose libraries were not found at build time, and what they need. */
std::vector<std::string> peersLeftOut();

Peer makeOurs();
Peer makePclMultiPlane();
Peer makePclRansac();
Peer makePeac();
Peer makeCape();
Peer makePlanarPatches();
Peer makeOpencvPlane();
Peer makeCgalRansac();

} // namespace pcl_mrf_planes::benchmarks
