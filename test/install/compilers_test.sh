#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs into a fresh folder, and builds and runs a program against it by find_package and by
# pkg-config, with each of g++ and clang++ that is there, in C++17 and in C++20. Arguments:
# CMake, source folder, build folder.
set -euo pipefail
cmake=$1 source=$2 build=$3
consumer=$source/test/install/consumer
work=$build/test/install/compilers
rm -rf "$work"
mkdir -p "$work"
"$cmake" --install "$build" --prefix "$work/prefix" >/dev/null
libdir=$(dirname "$(find "$work/prefix" -name 'libpcl_mrf_planes.so')")
export PKG_CONFIG_PATH=$libdir/pkgconfig
flags=$(pkg-config --cflags --libs pcl_mrf_planes_io pcl_mrf_planes)

expect() { # program, standard
  local printed
  printed=$("$1")
  printf '%s: %s\n' "$1" "$printed"
  grep -qE "^2 planes, 20$2, [1-9][0-9]* cameras$" <<<"$printed"
}
for compiler in g++ clang++; do
  command -v "$compiler" >/dev/null || continue
  for standard in 17 20; do
    name=$compiler-$standard
    "$cmake" -S "$consumer" -B "$work/$name" -DCMAKE_BUILD_TYPE=Release \
      -DCMAKE_CXX_COMPILER="$(command -v "$compiler")" -DCMAKE_CXX_STANDARD=$standard \
      -DCMAKE_PREFIX_PATH="$work/prefix" >/dev/null 2>"$work/$name.log" ||
      { cat "$work/$name.log" >&2; exit 1; }
    "$cmake" --build "$work/$name" >/dev/null
    # g++ 12 and clang++ 14 number C++20 as 202002.
    expect "$work/$name/consumer" "$standard"
    # shellcheck disable=SC2086
    "$compiler" -std=c++$standard "$consumer/main.cpp" -o "$work/$name/by_pkg_config" $flags \
      -Wl,-rpath,"$libdir"
    expect "$work/$name/by_pkg_config" "$standard"
  done
done

# The libraries' names carry the version that programs are bound to, and show nothing but
# what public headers export.
series=$(pkg-config --modversion pcl_mrf_planes | cut -d . -f 1,2)
for name in pcl_mrf_planes pcl_mrf_planes_io; do
  library=$libdir/lib$name.so
  readelf -d "$library" | grep "SONAME.*\[lib$name\.so\.$series\]" >/dev/null ||
    { echo "$library: its SONAME is not lib$name.so.$series" >&2; exit 1; }
  if nm -DC --defined-only "$library" | awk '$2 == "T"' | cut -d ' ' -f 3- |
    grep -vE '^((non-virtual|virtual) thunk to )?(pcl_mrf_planes::|pcl::MRFPlaneSegmentation<)'; then
    echo "$library exports these, which are not of the public headers" >&2
    exit 1
  fi
done
