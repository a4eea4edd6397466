#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Every option that the text of README.md and doc/ names is one of the apps', and every preset
# that is named is there. Arguments: source folder, folder of the apps.
set -euo pipefail
cd "$1"
apps=$2
help=$(for app in "$apps"/pcl_mrf_plane_*; do
  [ ! -x "$app" ] || [ -d "$app" ] || "$app" --help
done)

# Code between single quotes; what other programs take is theirs.
named() { grep -hoE '`[^`]+`' "$@" | tr -d '`'; }
pages=(README.md doc/*.md)
checked=0
while read -r option; do
  grep -qE -- "(^|[ [])$option([ ]|$)" <<<"$help" ||
    { echo "$option is in README.md or doc/, and no app has it" >&2; exit 1; }
  checked=$((checked + 1))
done < <(named "${pages[@]}" | grep -vE '^(cmake|cpack|sbatch|benchmark_|scripts/|--(coverage|benchmark))' |
  grep -oE -- '(^| )--[a-z][a-z-]+' | tr -d ' ' | sort -u)
[ "$checked" -ge 40 ] || { echo "only $checked options were found in the pages" >&2; exit 1; }

while read -r preset; do
  grep -q "\"name\": \"$preset\"" CMakePresets.json ||
    { echo "there is no preset $preset" >&2; exit 1; }
done < <(named "${pages[@]}" CONTRIBUTING.md | grep -oE -- '--preset [a-z]+' |
  cut -d ' ' -f 2 | sort -u)
