// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/grid_field.h>

#include <cstdint>

namespace pcl_mrf_planes {

/// One row of sites of one colour, as the message kernels see it. A row pointer leads
/// to label 0; label l is l * label_stride elements further on.
struct SiteRow {
  int sites;        ///< sites of this colour in the row
  int labels;       ///< L
  int label_stride; ///< elements from a label's row to the next label's
  EdgeModel model;
  std::uint16_t least_pairwise; ///< least cost of two different labels
  const std::uint16_t* data;
  const std::uint16_t* received[4]; ///< by direction
  const std::uint16_t* pairwise;    ///< L x L
  const std::uint16_t* scale;       ///< L x L
};

/// Where the messages of a row go: for each direction the receiving row (nullptr: there
/// is none), and the weights of the edges, both lined up with the senders.
struct SendRow {
  std::uint16_t* target[4]; ///< by direction of the receiver as seen from the sender
  const std::uint16_t* weight[4];
};

/// Sends the messages of one row of sites; returns the largest change of a message.
std::uint16_t sendRow(const SiteRow& row, const SendRow& send);

/// The label of least belief cost of every site of the row.
void mapRow(const SiteRow& row, std::uint16_t* labels);

} // namespace pcl_mrf_planes
