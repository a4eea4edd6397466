// SPDX-License-Identifier: BSD-3-Clause
// A smoothness term of one's own, with its test, in one file: CONTRIBUTING.md's example.
#include <pcl_mrf_planes/belief_propagation.h>
#include <pcl_mrf_planes/grid_field.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <vector>

namespace {

constexpr int SITES = 7;
constexpr int LABELS = 4;

/// The term: labels are steps of a ladder, each step apart costs more, up to a limit
/// (truncated linear model: Boykov, Veksler, Zabih, PAMI 23(11), 2001).
int ladderPrice(int a, int b)
{
  return std::min(300 * std::abs(a - b), 700);
}

/// Data costs without a pattern; the seed makes another problem.
int dataCost(int site, int label, int seed)
{
  return (site * 7919 + label * 104729 + seed * 1299709) % 1009;
}

pcl_mrf_planes::GridField ladderChain(int seed)
{
  pcl_mrf_planes::GridField field(SITES, 1, LABELS);
  for (int a = 0; a < LABELS; ++a)
    for (int b = 0; b < a; ++b)
      field.setPairwise(a, b, static_cast<std::uint16_t>(ladderPrice(a, b)));
  for (int x = 0; x < SITES; ++x) {
    for (int l = 0; l < LABELS; ++l)
      field.setData(x, 0, l, static_cast<std::uint16_t>(dataCost(x, l, seed)));
    if (x + 1 < SITES)
      field.setRightEdge(x, 0, 0); // the whole price
  }
  return field;
}

int energy(const std::vector<std::uint16_t>& labels, int seed)
{
  int sum = 0;
  for (int x = 0; x < SITES; ++x) {
    const auto i = static_cast<std::size_t>(x);
    sum += dataCost(x, labels[i], seed);
    if (x > 0)
      sum += ladderPrice(labels[i - 1], labels[i]);
  }
  return sum;
}

int leastEnergy(int seed)
{
  int least = std::numeric_limits<int>::max();
  std::vector<std::uint16_t> labels(SITES);
  for (int code = 0; code < 1 << (2 * SITES); ++code) { // two bits a label
    for (int x = 0; x < SITES; ++x)
      labels[static_cast<std::size_t>(x)] =
          static_cast<std::uint16_t>((code >> (2 * x)) & 3);
    least = std::min(least, energy(labels, seed));
  }
  return least;
}

TEST(OwnSmoothness, IsMinimisedOnAChain)
{
  for (int seed = 0; seed < 20; ++seed) {
    const pcl_mrf_planes::GridField field = ladderChain(seed);
    pcl_mrf_planes::BeliefPropagation propagation(field);
    propagation.iterate(2 * SITES, 0);
    EXPECT_EQ(energy(propagation.mapLabels(), seed), leastEnergy(seed))
        << "belief propagation is exact on a chain, whatever the term; seed " << seed;
  }
}

} // namespace
