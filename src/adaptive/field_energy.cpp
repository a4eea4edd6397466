// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/field_energy.h"

#include <algorithm>

namespace pcl_mrf_planes::adaptive {

namespace {

constexpr std::size_t SIDE = CandidateBlocks::SIDE;

/// Adds up block by block, in the units of the field.
class EnergySum {
public:
  EnergySum(const CandidateField& field, const OrganizedPoints& points,
            const std::vector<std::uint16_t>& labels)
  : f_(field)
  , points_(points)
  , labels_(labels)
  , width_(static_cast<std::size_t>(field.width))
  {}

  void addBlock(std::size_t active)
  {
    const std::size_t block = f_.active[active];
    const auto columns = static_cast<std::size_t>(f_.blocks.columns);
    const std::size_t column = block % columns;
    const std::size_t row = block / columns;
    const std::size_t right = std::min(SIDE, width_ - column * SIDE);
    const std::size_t bottom =
        std::min(SIDE, static_cast<std::size_t>(f_.height) - row * SIDE);
    const bool counts_left = column > 0 && isSettled(block - 1);
    const bool counts_above = row > 0 && isSettled(block - columns);
    const BlockWeights& weight = f_.weight[active];
    for (std::size_t r = 0; r < bottom; ++r)
      for (std::size_t k = 0; k < right; ++k) {
        const std::size_t i = (row * SIDE + r) * width_ + column * SIDE + k;
        if (points_.valid[i] == 0)
          continue;
        addData(active, r, k, labels_[i]);
        if (column * SIDE + k + 1 < width_)
          addEdge(i, i + 1, weight.right[r].v[k]);
        if (row * SIDE + r + 1 < static_cast<std::size_t>(f_.height))
          addEdge(i, i + width_, weight.down[r].v[k]);
        if (k == 0 && counts_left)
          addEdge(i, i - 1, weight.left.v[r]);
        if (r == 0 && counts_above)
          addEdge(i, i - width_, weight.above.v[k]);
      }
  }

  FieldEnergy sum;

private:
  bool isSettled(std::size_t block) const
  {
    return f_.number[block] == CandidateField::SETTLED;
  }

  void addData(std::size_t active, std::size_t r, std::size_t k, std::uint16_t label)
  {
    const std::size_t block = f_.active[active];
    const std::uint16_t* names = f_.blocks.labelsOf(block);
    const std::uint16_t* end = names + f_.blocks.count[block];
    const std::uint16_t* found = std::find(names, end, label);
    if (found == end)
      return; // no label of this field
    const auto slot = static_cast<std::size_t>(found - names);
    sum.data += f_.data[f_.dataRow(active, r) + slot].v[k];
  }

  void addEdge(std::size_t i, std::size_t j, std::int16_t weight)
  {
    if (labels_[i] != labels_[j])
      sum.smoothness += weight;
  }

  const CandidateField& f_;
  const OrganizedPoints& points_;
  const std::vector<std::uint16_t>& labels_;
  std::size_t width_;
};

} // namespace

FieldEnergy fieldEnergy(const CandidateField& field, const OrganizedPoints& points,
                        const std::vector<std::uint16_t>& labels,
                        const AdaptiveParameters& parameters)
{
  EnergySum energy(field, points, labels);
  for (std::size_t active = 0; active < field.active.size(); ++active)
    energy.addBlock(active);
  const double units = unitsPerSigma(parameters);
  energy.sum.data /= units;
  energy.sum.smoothness /= units;
  return energy.sum;
}

} // namespace pcl_mrf_planes::adaptive
