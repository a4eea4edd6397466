#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Manual page and completion of an app name every option of its --help. Arguments: the app,
# the folder of its completions, its manual page (made where help2man is).
set -euo pipefail
app=$1 completions=$2 page=$3
name=$(basename "$app")
options=$("$app" --help | grep -oE '^  (-h \[ )?--[a-z0-9-]+' | grep -oE -- '--.*' | sort -u)
[ "$(wc -l <<<"$options")" -ge 8 ]

# What bash offers after "--"; a word of the options is no file.
# shellcheck source=/dev/null
source "$completions/$name"
COMP_WORDS=("$name" --) COMP_CWORD=1
"_$name"
offered=$(printf '%s\n' "${COMPREPLY[@]}" | sort -u)
[ "$options" = "$offered" ] ||
  { diff <(echo "$options") <(echo "$offered") >&2; echo "$name: completion" >&2; exit 1; }
grep -q "^#compdef $name$" "$completions/_$name"

[ -e "$page" ] || exit 0
text=$(gzip -dc "$page" | sed 's/\\-/-/g; s/\\fB//g; s/\\fR//g')
grep -q "^\.TH" <<<"$text"
while read -r option; do
  grep -qE -- "(^|[ ,])$option([ ,]|$)" <<<"$text" ||
    { echo "$name.1 does not name $option" >&2; exit 1; }
done <<<"$options"
