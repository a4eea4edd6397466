// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace pcl_mrf_planes::benchmarks {

// Names are paths: the group, what is measured, then name:value for each variable.

/** \brief pipeline/PROFILE/SHAPE/threads:N, the class for PCL on a generated room. Its
 * profile PAPER_10_LABELS is PAPER with so many labels at every size. */
void registerPipelines();

/** \brief floor/PASS/SHAPE: passes that no method can do without. */
void registerFloors();

/** \brief paper/WHAT/labels:N/iterations:N/threads:N at 640x480. */
void registerPaper();

/** \brief instructions/WHAT/SET: the kernels and the profiles on each instruction set
 * of this machine. */
void registerInstructionSets();

/** \brief memory/PROFILE/SHAPE: allocations and bytes of a reused object. */
void registerMemory();

} // namespace pcl_mrf_planes::benchmarks
