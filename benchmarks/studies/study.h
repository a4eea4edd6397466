// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "evaluation/label_image.h"
#include "peer.h"
#include "result_table.h"

#include <functional>
#include <string>
#include <vector>

namespace pcl_mrf_planes::benchmarks {

/** \brief A cloud in memory with its ground truth. */
struct LabelledCloud {
  std::string set, name;
  Cloud::ConstPtr cloud;
  evaluation::LabelImage truth;
};

/** \brief One way to segment, under the name that it has in the table. */
struct Variant {
  std::string name;
  std::function<Labels(const Cloud::ConstPtr& cloud, double& milliseconds)> segment;
};

/** \brief Variants that are compared on the same clouds. */
struct Study {
  std::string name;
  std::vector<Variant> variants;
  std::vector<LabelledCloud> clouds;
};

/** \brief Read all the frames of a folder of sets that have ground truth.
 * \throws std::runtime_error when one cannot be read */
std::vector<LabelledCloud> readLabelledClouds(const std::string& folder,
                                              const std::vector<std::string>& sets);

/** \brief Every variant on every cloud, a variant after the other. The times are of
 * all threads together. */
std::vector<Result> runStudy(const Study& study, unsigned int threads);

} // namespace pcl_mrf_planes::benchmarks
