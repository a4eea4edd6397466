// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file
 * PCL_MRF_PLANES_SANITIZED: 1 if a sanitizer that replaces the memory's operators watches
 * the program, else 0. */

#if defined(__has_feature) // clang++
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) ||             \
    __has_feature(memory_sanitizer)
#define PCL_MRF_PLANES_SANITIZED 1
#endif
#elif defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define PCL_MRF_PLANES_SANITIZED 1
#endif

#ifndef PCL_MRF_PLANES_SANITIZED
#define PCL_MRF_PLANES_SANITIZED 0
#endif
