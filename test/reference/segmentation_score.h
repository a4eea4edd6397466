// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <vector>

/** Plain, slow implementations written from the definitions, to hold the scores against:
 * regions are sets of points, pairs of points are looked at one by one. */
namespace pcl_mrf_planes::reference {

using LabelVector = std::vector<std::uint16_t>;
using PointSet = std::set<std::size_t>;
using RegionSets = std::map<std::uint16_t, PointSet>;

inline PointSet intersection(const PointSet& a, const PointSet& b)
{
  PointSet both;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(),
                        std::inserter(both, both.end()));
  return both;
}

inline PointSet unionOf(const PointSet& a, const PointSet& b)
{
  PointSet all = a;
  all.insert(b.begin(), b.end());
  return all;
}

inline PointSet difference(const PointSet& a, const PointSet& b)
{
  PointSet rest;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(),
                      std::inserter(rest, rest.end()));
  return rest;
}

/** \brief The part of \a a that \a b covers, 0 to 1. */
inline double shareCovered(const PointSet& a, const PointSet& b)
{
  return static_cast<double>(intersection(a, b).size()) / static_cast<double>(a.size());
}

/** \brief Two label images as the scores see them. */
class ScoredImages {
public:
  static constexpr std::uint16_t NOT_SCORED = 65535;

  ScoredImages(const LabelVector& truth, const LabelVector& labels)
  {
    std::map<std::uint16_t, std::size_t> whole, hidden;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      ++whole[labels[i]];
      hidden[labels[i]] += truth[i] == NOT_SCORED ? 1 : 0;
    }
    for (std::size_t i = 0; i < truth.size(); ++i) {
      if (truth[i] == NOT_SCORED)
        continue;
      // More than half of the region lies where nothing is scored.
      const bool judged = hidden[labels[i]] * 2 <= whole[labels[i]];
      truth_.push_back(truth[i]);
      labels_.push_back(judged ? labels[i] : std::uint16_t{0});
    }
    for (std::size_t i = 0; i < truth_.size(); ++i)
      if (truth_[i] == 0)
        no_plane_.insert(i);
  }

  /** \brief Planes of an image with more than \a min_points points. */
  static RegionSets regions(const LabelVector& image, std::size_t min_points)
  {
    RegionSets all, kept;
    for (std::size_t i = 0; i < image.size(); ++i)
      all[image[i]].insert(i);
    for (const auto& [label, points] : all)
      if (label != 0 && points.size() > min_points)
        kept[label] = points;
    return kept;
  }

  const LabelVector& truth() const { return truth_; }
  const LabelVector& labels() const { return labels_; }
  const PointSet& noPlane() const { return no_plane_; }

private:
  LabelVector truth_, labels_;
  PointSet no_plane_;
};

struct HooverCounts {
  int truth = 0, correct = 0, over = 0, under = 0, missed = 0, noise = 0;
};

/** \brief A region that \a parts, of those left, make up between them: two parts or more
 * that lie in it to a share of \a tolerance each and cover it to that share; the parts.
 */
inline std::vector<std::uint16_t> partsOf(const PointSet& whole,
                                          const RegionSets& parts, double tolerance)
{
  std::vector<std::uint16_t> names;
  PointSet covered;
  for (const auto& [name, part] : parts)
    if (shareCovered(part, whole) >= tolerance) {
      names.push_back(name);
      covered = unionOf(covered, intersection(part, whole));
    }
  const bool enough =
      names.size() > 1 && static_cast<double>(covered.size()) >=
                              tolerance * static_cast<double>(whole.size());
  return enough ? names : std::vector<std::uint16_t>();
}

/** \brief Hoover et al. (PAMI 1996): regions are taken away as they find a class. */
inline HooverCounts hoover(const ScoredImages& images, double tolerance,
                           std::size_t min_points)
{
  RegionSets truth = ScoredImages::regions(images.truth(), min_points);
  RegionSets labels = ScoredImages::regions(images.labels(), min_points);
  HooverCounts counts;
  counts.truth = static_cast<int>(truth.size());
  const RegionSets all_truth = truth, all_labels = labels;
  for (const auto& [t, true_points] : all_truth)
    for (const auto& [l, points] : all_labels)
      if (shareCovered(true_points, points) >= tolerance &&
          shareCovered(points, true_points) >= tolerance) {
        ++counts.correct;
        truth.erase(t);
        labels.erase(l);
      }
  for (const auto& [t, true_points] : RegionSets(truth)) {
    const auto parts = partsOf(true_points, labels, tolerance);
    counts.over += parts.empty() ? 0 : 1;
    if (!parts.empty())
      truth.erase(t);
    for (const std::uint16_t part : parts)
      labels.erase(part);
  }
  for (const auto& [l, points] : RegionSets(labels)) {
    const auto parts = partsOf(points, truth, tolerance);
    counts.under += parts.empty() ? 0 : 1;
    if (!parts.empty())
      labels.erase(l);
    for (const std::uint16_t part : parts)
      truth.erase(part);
  }
  counts.missed = static_cast<int>(truth.size());
  counts.noise = static_cast<int>(labels.size());
  return counts;
}

/** \brief Intersection over union, points on no plane of the truth left out. */
inline double iou(const ScoredImages& images, const PointSet& truth,
                  const PointSet& points)
{
  const PointSet all = unionOf(truth, difference(points, images.noPlane()));
  return static_cast<double>(intersection(truth, points).size()) /
         static_cast<double>(all.size());
}

/** \brief Panoptic quality (Kirillov et al., CVPR 2019): recognition times segmentation
 * quality. */
inline double panopticQuality(const ScoredImages& images, std::size_t min_points)
{
  const RegionSets truth = ScoredImages::regions(images.truth(), min_points);
  RegionSets unmatched = ScoredImages::regions(images.labels(), 0);
  double sum = 0.0;
  double matches = 0.0;
  for (const auto& [t, true_points] : truth)
    for (const auto& [l, points] : ScoredImages::regions(images.labels(), 0))
      if (iou(images, true_points, points) > 0.5) {
        sum += iou(images, true_points, points);
        matches += 1.0;
        unmatched.erase(l);
      }
  double wrong = 0.0;
  for (const auto& [l, points] : unmatched)
    if (points.size() > min_points && shareCovered(points, images.noPlane()) < 0.5)
      wrong += 1.0;
  const double missed = static_cast<double>(truth.size()) - matches;
  if (matches + wrong + missed == 0.0)
    return 1.0;
  if (matches == 0.0)
    return 0.0;
  return sum / matches * (matches / (matches + wrong / 2.0 + missed / 2.0));
}

/** \brief Segmentation covering (Arbelaez et al., PAMI 2011). */
inline double covering(const ScoredImages& images, std::size_t min_points)
{
  double sum = 0.0;
  double size = 0.0;
  for (const auto& [t, true_points] :
       ScoredImages::regions(images.truth(), min_points)) {
    double best = 0.0;
    for (const auto& [l, points] : ScoredImages::regions(images.labels(), 0))
      best = std::max(best, iou(images, true_points, points));
    sum += best * static_cast<double>(true_points.size());
    size += static_cast<double>(true_points.size());
  }
  return size > 0.0 ? sum / size : 1.0;
}

/** \brief Rand index: every pair of points on true planes, one by one. */
inline double randIndex(const ScoredImages& images)
{
  double agree = 0.0;
  double pairs = 0.0;
  double points = 0.0;
  for (std::size_t i = 0; i < images.truth().size(); ++i) {
    points += images.truth()[i] != 0 ? 1.0 : 0.0;
    for (std::size_t j = 0; j < i; ++j) {
      if (images.truth()[i] == 0 || images.truth()[j] == 0)
        continue;
      const bool together = images.truth()[i] == images.truth()[j];
      pairs += 1.0;
      agree += together == (images.labels()[i] == images.labels()[j]) ? 1.0 : 0.0;
    }
  }
  if (points == 0.0)
    return std::numeric_limits<double>::quiet_NaN();
  return pairs > 0.0 ? agree / pairs : 1.0;
}

/** \brief Variation of information (Meila 2007) as the sum of what each image tells
 * beyond the other: - sum of r log(r / p) + r log(r / q). */
inline double variationOfInformation(const ScoredImages& images)
{
  std::map<std::uint16_t, double> p, q;
  std::map<std::pair<std::uint16_t, std::uint16_t>, double> r;
  double points = 0.0;
  for (std::size_t i = 0; i < images.truth().size(); ++i)
    if (images.truth()[i] != 0) {
      p[images.truth()[i]] += 1.0;
      q[images.labels()[i]] += 1.0;
      r[{images.truth()[i], images.labels()[i]}] += 1.0;
      points += 1.0;
    }
  if (points == 0.0)
    return std::numeric_limits<double>::quiet_NaN();
  double sum = 0.0;
  for (const auto& [pair, count] : r)
    sum -= count / points *
           (std::log(count / p[pair.first]) + std::log(count / q[pair.second]));
  return sum;
}

/** \brief Share of points labelled as a plane, of those on true planes or of the others;
 * NaN without any. */
inline double shareLabelled(const ScoredImages& images, bool on_planes)
{
  double labelled = 0.0;
  double points = 0.0;
  for (std::size_t i = 0; i < images.truth().size(); ++i)
    if ((images.truth()[i] != 0) == on_planes) {
      points += 1.0;
      labelled += images.labels()[i] != 0 ? 1.0 : 0.0;
    }
  return labelled / points; // 0 / 0 is NaN
}

} // namespace pcl_mrf_planes::reference
