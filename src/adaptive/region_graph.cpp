// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/region_graph.h"
#include "frame_memory.h"
#include "threads.h"

namespace pcl_mrf_planes::adaptive {

double dissimilarity(const FittedPlane& a, const FittedPlane& b,
                     const FittedPlane& joint, const NoiseLaw& noise,
                     const AdaptiveParameters& p)
{
  const double growth = joint.mse * joint.n - a.mse * a.n - b.mse * b.n;
  const double allowed = allowedVariance(joint, noise, p);
  if (joint.mse > p.region_tolerance * p.region_tolerance * allowed)
    return -1;
  return std::max(0.0, growth) / std::min(a.n, b.n) / allowed;
}

TileRegions collect(Regions& regions, FrameVector<int> cell_region, double least,
                    unsigned int threads)
{
  FrameVector<int> kept; // roots
  FrameVector<int> id(static_cast<std::size_t>(regions.size()) + 1, -1);
  int* const number = id.data() + 1; // of each set, and in front of them of none
  for (int i = 0; i < regions.size(); ++i)
    if (regions.isRoot(i) && regions.sums(i).n >= least) {
      number[i] = static_cast<int>(kept.size());
      kept.push_back(i);
    }
  TileRegions out;
  out.reserve(kept.size());
  for (const int root : kept)
    out.add(regions.plane(root), regions.sums(root));
  parallelRows(regions.size(), threads, [&](int i) {
    if (const int root = regions.rootOf(i); root != i)
      number[i] = number[root];
  });
  parallelRows(static_cast<int>(cell_region.size()), threads, [&](int cell) {
    int& region = cell_region[static_cast<std::size_t>(cell)];
    region = number[region]; // none stays none
  });
  out.cell_region = std::move(cell_region);
  return out;
}

} // namespace pcl_mrf_planes::adaptive
