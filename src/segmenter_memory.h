// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adaptive/workspace.h"
#include "frame_memory.h"
#include "region_gathering.h"

#include <pcl_mrf_planes/plane_field.h>

#include <optional>

namespace pcl_mrf_planes {

/** \brief What Method::PAPER keeps from one cloud to the next. */
struct PaperMemory {
  std::optional<PlaneField> field; ///< of a cloud that may be gone
  RegionMemory regions;
};

/** \brief What a PlaneSegmenter keeps from one cloud to the next. */
struct SegmenterMemory {
  FrameMemory frame; ///< goes last
  adaptive::Workspace adaptive;
  PaperMemory paper;
};

} // namespace pcl_mrf_planes
