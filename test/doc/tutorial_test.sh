#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Compiles the C++ blocks of doc/tutorial.md, one after the other in one function, as they
# are read. Arguments: source folder, compiler, a folder to work in, compiler flags.
set -euo pipefail
source=$1 compiler=$2 work=$3
shift 3
mkdir -p "$work"
{
  for header in mrf_plane_segmentation plane_uncertainty region_parts region_polygons \
    plane_creases plane_projection label_confidence grid_field belief_propagation \
    belief_gap; do
    echo "#include <pcl_mrf_planes/$header.h>"
  done
  # What the text takes for granted.
  echo 'void tutorial(pcl::PointCloud<pcl::PointXYZ>::Ptr cloud, int width, int height,'
  echo '  int labels, int a, int b, int x, int y, int l, std::uint16_t price,'
  echo '  std::uint16_t cost)'
  echo '{'
  awk '/^```cpp$/ {inside = 1; next} /^```$/ {inside = 0} inside' "$source/doc/tutorial.md"
  echo '}'
} >"$work/tutorial.cpp"
[ "$(grep -c ';' "$work/tutorial.cpp")" -ge 30 ] ||
  { echo "doc/tutorial.md: its code was not found" >&2; exit 1; }
"$compiler" -std=c++17 -fsyntax-only "$@" "$work/tutorial.cpp"
