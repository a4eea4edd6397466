#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# doc/architecture.md names every source of src/, and none that is not there. Argument: source
# folder.
set -euo pipefail
cd "$1"
table=$(sed -n '/^## Where a thing is/,/^## After/p' doc/architecture.md)
names=$(find src -name '*.cpp' -o -name '*.h' | sed -E 's#.*/##; s/\.(cpp|h)$//' | sort -u)
named=$(grep -E '^\|' <<<"$table" | sed 's/.*|\(.*\)|$/\1/' | grep -oE '`[a-z_/-]+`' |
  tr -d '`' | sed 's#adaptive/##' | grep -v '^src/$' | sort -u)
[ "$names" = "$named" ] || {
  diff <(printf '%s\n' "$names") <(printf '%s\n' "$named") >&2 || true
  echo 'doc/architecture.md: "Where a thing is" is not what src/ has (< missing, > no such)' >&2
  exit 1
}
# The stages in its pictures and text are functions of the code.
for name in $(grep -oE '`[a-z][A-Za-z]+(\(\))?`' doc/architecture.md | tr -d '`()' | sort -u) \
  $(grep -oE '^ [a-z][A-Za-z]+(,| {2})' doc/architecture.md | tr -d ' ,'); do
  grep -rqw -- "$name" src include io apps ||
    { echo "doc/architecture.md: there is no $name" >&2; exit 1; }
done
