#!/usr/bin/env bash
# Installs the library into a fresh folder, builds the example project against that copy
# only, and runs it. Arguments: CMake, source folder, build folder, a cloud to segment.
set -euo pipefail
cmake=$1 source=$2 build=$3 cloud=$4

work=$build/test/install/work
rm -rf "$work"
mkdir -p "$work"
"$cmake" --install "$build" --prefix "$work/prefix" >/dev/null

"$cmake" -S "$source/doc/example" -B "$work/example" -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_PREFIX_PATH="$work/prefix" >/dev/null
"$cmake" --build "$work/example"
printed=$("$work/example/example" "$cloud")
printf '%s\n' "$printed"
grep -q 'points on' <<<"$printed" || { echo "the example found no plane" >&2; exit 1; }

# The readers as well, where they are built: a folder with the cloud.
if [ -e "$work/example/frames" ]; then
  printed=$("$work/example/frames" "$cloud" "$(dirname "$cloud")/scene.pcd")
  printf '%s\n' "$printed"
  grep -q '^scene: [0-9]* planes' <<<"$printed"
fi

# Versions: this one and older ones of its series are found, newer ones are not.
version=$(awk '/^Version:/ {print $2}' "$(find "$work/prefix" -name 'pcl_mrf_planes.pc')")
series=${version%.*}
finds() { # a version; configures a project that asks for it
  mkdir -p "$work/version"
  printf '%s\n' 'cmake_minimum_required(VERSION 3.16)' 'project(version LANGUAGES C CXX)' \
    "find_package(pcl_mrf_planes $1 REQUIRED)" >"$work/version/CMakeLists.txt"
  "$cmake" -S "$work/version" -B "$work/version/build" \
    -DCMAKE_PREFIX_PATH="$work/prefix" >"$work/version/log" 2>&1
}
finds "$version" && finds "$series" ||
  { cat "$work/version/log"; echo "version $version is not found" >&2; exit 1; }
for newer in "$version.1" "$series.999" "$((${version%%.*} + 1)).0"; do
  if finds "$newer"; then
    echo "version $newer is found in $version" >&2
    exit 1
  fi
done

# The parts can be installed apart, and are together the whole.
for component in library development tools; do
  "$cmake" --install "$build" --prefix "$work/parts/$component" --component "$component" \
    >/dev/null
done
list() { (cd "$1" && find . ! -type d | sort); }
cmp <(list "$work/prefix") \
  <(for part in "$work"/parts/*; do list "$part"; done | sort) ||
  { echo "the components are not the whole installation" >&2; exit 1; }

# What no public header exports is not to be seen in the library.
library=$(find "$work/prefix" -name 'libpcl_mrf_planes.so')
if nm -DC --defined-only "$library" | grep -E 'pcl_mrf_planes::(adaptive|findRuns|labelCells)'; then
  echo "internal symbols are exported" >&2
  exit 1
fi

# pkg-config gives flags that compile and link the same file.
libdir=$(dirname "$(find "$work/prefix" -name 'pcl_mrf_planes.pc')")
export PKG_CONFIG_PATH=$libdir
flags=$(pkg-config --cflags --libs pcl_mrf_planes)
io=$(pkg-config --cflags --libs pcl_io)
# shellcheck disable=SC2086
c++ -std=c++17 "$source/doc/example/main.cpp" -o "$work/by_pkg_config" $flags $io \
  -Wl,-rpath,"${libdir%/pkgconfig}"
printed=$("$work/by_pkg_config" "$cloud")
grep -q 'points on' <<<"$printed"

# So do those of the readers.
flags=$(pkg-config --cflags --libs pcl_mrf_planes_io pcl_mrf_planes)
# shellcheck disable=SC2086
c++ -std=c++17 "$source/doc/example/frames.cpp" -o "$work/frames_by_pkg_config" $flags \
  -Wl,-rpath,"${libdir%/pkgconfig}"
"$work/frames_by_pkg_config" "$cloud" | grep 'planes'

# The installed apps find their library without help.
"$work/prefix/bin/pcl_mrf_plane_segmentation" --version
"$work/prefix/bin/pcl_mrf_plane_evaluation" --version
# Nothing of this machine's processor is in the flags that users get.
if grep -rn --include='*.cmake' --include='*.pc' -e '-march' -e '-mtune' -e '-mavx' \
  "$work/prefix"; then
  echo "machine-specific flags are installed" >&2
  exit 1
fi
