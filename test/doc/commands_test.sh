#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs the commands of README.md's sh blocks on generated rooms, and looks for what they
# promise. Arguments: source folder, folder of the apps, make_data_sets, a folder to work in.
set -euo pipefail
source=$1 apps=$2 make_data_sets=$3 work=$4
fail() { printf 'README.md: %s\n' "$*" >&2; exit 1; }

rm -rf "$work"
mkdir -p "$work/blocks"
awk -v folder="$work/blocks" '
  /^```sh$/ {inside = 1; file = sprintf("%s/%02d", folder, ++count); next}
  /^```$/ {inside = 0}
  inside {print > file}' "$source/README.md"

cd "$work"
export PATH=$apps:$PATH
export PCL_MRF_PLANES_APP=$apps/pcl_mrf_plane_segmentation # else scripts/figures builds one
ln -s "$source/scripts" scripts
pcl_mrf_plane_scene in.pcd --seed 1
"$make_data_sets" .
run=0 seen=
for block in blocks/*; do
  if grep -qE '^scripts/(demo|test)\b' "$block"; then # they install packages and build
    grep -oE '^scripts/[a-z-]+' "$block" | while read -r script; do
      test -x "$source/$script" || fail "no $script"
    done
  else
    bash -euo pipefail "$block" >"$block.output" 2>&1 ||
      { cat "$block" "$block.output"; fail 'these commands failed'; }
    run=$((run + 1))
    if grep -q -- '--confidence$' "$block"; then # later ones write another out.pcd
      grep -aqE '^FIELDS.* label confidence$' out.pcd ||
        fail 'out.pcd without label and confidence'
      seen=confidence
    fi
  fi
done
[ "$run" -eq 5 ] || fail "$run blocks were run, not 5"

[ -n "$seen" ] || fail 'no command asks for the confidence'

# What the commands promise.
for file in picture.png planes.json room.pcd labels.png out.pcd planes.ply \
  planes/rgbd_dataset_freiburg1_desk/*/1.000000.{json,labels.png,overlay.png} \
  planes/nyu_depth_v2_labeled/0001.{json,labels.png,overlay.png} planes/summary.csv \
  pictures/*/1.000000.figure.png stages/stages.csv stages/tiles.csv; do
  test -s "$file" || { ls -R planes pictures stages; fail "its commands leave no $file"; }
done
for part in covariance patches holes hull creases; do
  grep -q "\"$part\"" planes.json || fail "planes.json without $part"
done
head -n 1 planes.ply | grep -q '^ply' || fail 'planes.ply is no mesh'
grep -q 'all frames' blocks/*.output || fail 'the evaluation prints no scores'
