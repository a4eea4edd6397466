// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace pcl_mrf_planes::reference {

using Labels = std::vector<std::uint16_t>;

/** \brief Max-sum belief propagation on the checkerboard, section IV-D, loop by loop.
 *
 * A Problem has width(), height(), labels(), data(x, y, l), connected(x, y, u, v) and
 * price(x, y, u, v, a, b), a and b being the labels of (x, y) and (u, v); Cost is their
 * type. */
template <typename Problem>
class Propagation {
public:
  using Cost = typename Problem::Cost;

  explicit Propagation(const Problem& problem)
  : problem_(problem)
  , messages_(4 * sites() * static_cast<std::size_t>(problem.labels()), Cost{0})
  {}

  /** \brief Iteration t updates the messages that colour t % 2 sends. */
  void iterate(int iterations)
  {
    for (int i = 0; i < iterations; ++i, ++done_)
      for (int y = 0; y < problem_.height(); ++y)
        for (int x = 0; x < problem_.width(); ++x)
          if ((x + y) % 2 == done_ % 2)
            for (int direction = 0; direction < 4; ++direction)
              send(x, y, direction);
  }

  /** \brief Label of least belief; the smallest of equal ones. */
  Labels mapLabels() const
  {
    Labels result;
    for (int y = 0; y < problem_.height(); ++y)
      for (int x = 0; x < problem_.width(); ++x) {
        int best = 0;
        for (int l = 1; l < problem_.labels(); ++l)
          if (belief(x, y, l) < belief(x, y, best))
            best = l;
        result.push_back(static_cast<std::uint16_t>(best));
      }
    return result;
  }

  /** \brief What (x, y) was told by its neighbour in a direction: left, right, above,
   * below. */
  Cost message(int direction, int x, int y, int l) const
  {
    return messages_[at(direction, x, y, l)];
  }

private:
  static constexpr std::array<int, 4> DX = {-1, 1, 0, 0};
  static constexpr std::array<int, 4> DY = {0, 0, -1, 1};

  std::size_t sites() const
  {
    return static_cast<std::size_t>(problem_.width()) *
           static_cast<std::size_t>(problem_.height());
  }

  std::size_t at(int direction, int x, int y, int l) const
  {
    const std::size_t site =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(problem_.width()) +
        static_cast<std::size_t>(x);
    return (static_cast<std::size_t>(direction) * sites() + site) *
               static_cast<std::size_t>(problem_.labels()) +
           static_cast<std::size_t>(l);
  }

  Cost belief(int x, int y, int l) const
  {
    Cost sum = problem_.data(x, y, l);
    for (int direction = 0; direction < 4; ++direction)
      sum += message(direction, x, y, l);
    return sum;
  }

  void send(int x, int y, int direction)
  {
    const int u = x + DX[static_cast<std::size_t>(direction)];
    const int v = y + DY[static_cast<std::size_t>(direction)];
    if (!problem_.connected(x, y, u, v))
      return;
    const auto labels = static_cast<std::size_t>(problem_.labels());
    std::vector<Cost> h(labels);
    for (std::size_t a = 0; a < labels; ++a)
      h[a] = belief(x, y, static_cast<int>(a)) -
             message(direction, x, y, static_cast<int>(a));
    std::vector<Cost> m(labels, std::numeric_limits<Cost>::max());
    for (std::size_t b = 0; b < labels; ++b)
      for (std::size_t a = 0; a < labels; ++a)
        m[b] = std::min(m[b], h[a] + problem_.price(x, y, u, v, static_cast<int>(a),
                                                    static_cast<int>(b)));
    const Cost least = *std::min_element(m.begin(), m.end());
    for (std::size_t b = 0; b < labels; ++b)
      messages_[at(direction ^ 1, u, v, static_cast<int>(b))] = m[b] - least;
  }

  const Problem& problem_;
  std::vector<Cost> messages_;
  int done_ = 0;
};

/** \brief Sum of the data costs and of the prices, each edge once. */
template <typename Problem>
typename Problem::Cost energyOf(const Problem& problem, const Labels& labels)
{
  const auto at = [&](int x, int y) {
    return static_cast<int>(
        labels[static_cast<std::size_t>(y) * static_cast<std::size_t>(problem.width()) +
               static_cast<std::size_t>(x)]);
  };
  typename Problem::Cost sum = 0;
  for (int y = 0; y < problem.height(); ++y)
    for (int x = 0; x < problem.width(); ++x) {
      sum += problem.data(x, y, at(x, y));
      if (problem.connected(x, y, x + 1, y))
        sum += problem.price(x, y, x + 1, y, at(x, y), at(x + 1, y));
      if (problem.connected(x, y, x, y + 1))
        sum += problem.price(x, y, x, y + 1, at(x, y), at(x, y + 1));
    }
  return sum;
}

/** \brief The least energy of all labellings, tried one by one. For tiny grids. */
template <typename Problem>
typename Problem::Cost leastEnergy(const Problem& problem)
{
  Labels labels(static_cast<std::size_t>(problem.width() * problem.height()), 0);
  auto least = energyOf(problem, labels);
  for (std::size_t i = 0; i < labels.size();) {
    if (++labels[i] == problem.labels()) {
      labels[i++] = 0;
      continue;
    }
    i = 0;
    least = std::min(least, energyOf(problem, labels));
  }
  return least;
}

/** \brief The least energy of a chain (width or height 1) by dynamic programming. */
template <typename Problem>
typename Problem::Cost leastChainEnergy(const Problem& problem)
{
  using Cost = typename Problem::Cost;
  const bool flat = problem.height() == 1;
  const int length = flat ? problem.width() : problem.height();
  std::vector<Cost> cost(static_cast<std::size_t>(problem.labels()), 0);
  for (int i = 0; i < length; ++i) {
    const int x = flat ? i : 0;
    const int y = flat ? 0 : i;
    const int px = flat ? i - 1 : 0;
    const int py = flat ? 0 : i - 1;
    std::vector<Cost> next;
    for (int b = 0; b < problem.labels(); ++b) {
      Cost best = i == 0 ? Cost{0} : std::numeric_limits<Cost>::max();
      for (int a = 0; i > 0 && a < problem.labels(); ++a) {
        const Cost price = problem.connected(px, py, x, y)
                               ? problem.price(px, py, x, y, a, b)
                               : Cost{0};
        best = std::min(best, cost[static_cast<std::size_t>(a)] + price);
      }
      next.push_back(best + problem.data(x, y, b));
    }
    cost = next;
  }
  return *std::min_element(cost.begin(), cost.end());
}

} // namespace pcl_mrf_planes::reference
