#!/usr/bin/env bash
# Segments the frames of some inputs with GNU parallel (Debian: parallel), one process for
# each part of the list. Goes on where an interrupted run stopped.
#
#   doc/cluster/parallel.sh PARTS OUTPUT_FOLDER INPUT...
#
# OPTIONS: more options of the app; PARALLEL_OPTIONS: of parallel, such as
# "--sshloginfile machines" where all machines see the same files.
set -euo pipefail
parts=$1 output=$2
shift 2

# Exit status: in how many parts frames failed (see the tables); the others are done.
status=0
# shellcheck disable=SC2086
seq "$parts" | parallel --halt never --line-buffer ${PARALLEL_OPTIONS:-} \
  "${APP:-pcl_mrf_plane_segmentation}" "${@@Q}" --output-folder "${output@Q}" \
  --shard "{}/$parts" --resume --quiet ${OPTIONS:-} || status=$?

# One table from those of the parts.
first=$output/summary-1-of-$parts.csv
{ head -n 1 "$first"; tail -q -n +2 "$output"/summary-*-of-"$parts".csv | sort; } \
  >"$output/summary.csv.partial"
mv "$output/summary.csv.partial" "$output/summary.csv"
exit "$status"
