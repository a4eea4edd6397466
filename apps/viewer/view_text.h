// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "session.h"

#include <string>

namespace pcl_mrf_planes::viewer {

/** \brief Lines for the top left of the window: frame, method, counts, times. */
std::string factsText(const Session& session);

/** \brief Method and counts of the result on the right. */
std::string comparisonText(const Session& session);

/** \brief The selected plane and the picked point; empty: none is selected. */
std::string selectionText(const Session& session);

/** \brief One line that says what is seen, for logs. */
std::string stateLine(const Session& session);

} // namespace pcl_mrf_planes::viewer
