#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs the commands of README.md's sh blocks on a generated room. Arguments: source folder,
# folder of the apps, a folder to work in.
set -euo pipefail
source=$1 apps=$2 work=$3
rm -rf "$work"
mkdir -p "$work/blocks"
awk -v folder="$work/blocks" '
  /^```sh$/ {inside = 1; file = sprintf("%s/%02d", folder, ++count); next}
  /^```$/ {inside = 0}
  inside {print > file}' "$source/README.md"

cd "$work"
export PATH=$apps:$PATH
pcl_mrf_plane_scene in.pcd --seed 1
run=0
for block in blocks/*; do
  if grep -q '^scripts/' "$block"; then # they install packages and build: are they there?
    grep -oE '^scripts/[a-z-]+' "$block" | while read -r script; do
      test -x "$source/$script" || { echo "README.md: no $script" >&2; exit 1; }
    done
  elif grep -qE 'depth\.png|rgbd_dataset' "$block"; then # files of others: known options?
    pcl_mrf_plane_segmentation --help >help
    grep -oE -- '--[a-z-]+' "$block" | while read -r option; do
      grep -q -- "  $option\b" help || { echo "README.md: no $option" >&2; exit 1; }
    done
  else
    bash -euo pipefail "$block" >output 2>&1 ||
      { cat "$block" output; echo "README.md: these commands failed" >&2; exit 1; }
    run=$((run + 1))
  fi
done
[ "$run" -ge 3 ] || { echo "README.md: only $run blocks were run" >&2; exit 1; }
