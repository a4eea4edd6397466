#!/usr/bin/env bash
# The README's code is the example that is built, and every command it names exists.
# Argument: source folder.
set -euo pipefail
cd "$1"

readme_code=$(awk '/^```cpp$/ {inside = 1; next} /^```$/ {inside = 0} inside' README.md)
example=$(grep -v '^// SPDX' doc/example/main.cpp)
[ "$readme_code" = "$example" ] ||
  { echo "README.md and doc/example/main.cpp differ" >&2; exit 1; }

readme_cmake=$(awk '/^```cmake$/ {inside = 1; next} /^```$/ {inside = 0} inside' README.md)
while read -r line; do
  grep -qF "$line" doc/example/CMakeLists.txt ||
    { echo "README.md: not in the example's CMakeLists.txt: $line" >&2; exit 1; }
done <<<"$readme_cmake"

# Links, of the text only: code has brackets of its own.
for page in README.md CONTRIBUTING.md doc/*.md; do
  awk '/^```/ {inside = !inside} !inside' "$page" | grep -oE '\]\(([^)#:]+)\)' |
    sed -E "s#^\]\((.*)\)\$#$page \1#" || true
done |
  while read -r file target; do
    [ -e "$(dirname "$file")/$target" ] ||
      { echo "$file: link to $target leads nowhere" >&2; exit 1; }
  done
