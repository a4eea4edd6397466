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
"$work/frames_by_pkg_config" "$cloud" | grep -q 'planes'

# The installed apps find their library without help.
"$work/prefix/bin/pcl_mrf_plane_segmentation" --version
"$work/prefix/bin/pcl_mrf_plane_evaluation" --version
# Nothing of this machine's processor is in the flags that users get.
if grep -rn -e '-march' -e '-mtune' -e '-mavx' "$work/prefix/lib"/*/cmake \
  "$work/prefix/lib"/*/pkgconfig; then
  echo "machine-specific flags are installed" >&2
  exit 1
fi
