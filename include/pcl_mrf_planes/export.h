// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file
 * \brief What a library shows to programs; everything else in it is hidden. */

/** \brief Marks a class or function of the public headers; one that lacks it cannot be
 * linked. */
#if defined(__GNUC__)
#define PCL_MRF_PLANES_EXPORT __attribute__((visibility("default")))
#else
#define PCL_MRF_PLANES_EXPORT
#endif
