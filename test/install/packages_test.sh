#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs in a clean Debian where the packages are installed: the apps, and with
# "development" the example project built against the -dev package.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

pcl_mrf_plane_scene room.pcd --truth room.gt.png --seed 3
pcl_mrf_plane_segmentation room.pcd out.pcd --models planes.json --overlay overlay.png
pcl_mrf_plane_evaluation room.gt.png out.pcd
test -s planes.json
test -s overlay.png
for app in segmentation scene evaluation viewer; do
  test -s "/usr/share/bash-completion/completions/pcl_mrf_plane_$app"
  gzip -t "/usr/share/man/man1/pcl_mrf_plane_$app.1.gz"
  "pcl_mrf_plane_$app" --help >help
  grep -q -- --help help
done
ldconfig -p >libraries # whole: a grep that has seen enough would fail it
grep -q 'libpcl_mrf_planes\.so\.' libraries ||
  { echo "the trigger did not run ldconfig" >&2; exit 1; }

[ "${1:-}" = development ] || exit 0
cmake -S /packages/example -B build >/dev/null
cmake --build build
build/example room.pcd | grep 'points on'
pkg-config --modversion pcl_mrf_planes pcl_mrf_planes_io
