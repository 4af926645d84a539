#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Checks docs/adding.md: every file it names exists, and the table behind <!-- holds: WORD --> names exactly
# the files of the source tree that hold this word.
set -eu
cd "$(dirname "$0")/../.."
page=docs/adding.md
bad=0
# The files of the table rows behind line $1, up to the next section.
named() {
  tail -n "+$1" "$page" | sed '/^## /q' | grep '^| `' | cut -d'|' -f2 | grep -o '`[^`]*`' | tr -d '`' | sort
}
for file in $(named 1; sed -n 's/^| \(`.*\) |.*/\1/p' "$page" | cut -d'|' -f1 | grep -o '`[^`]*`' | tr -d '`'); do
  [ -f "$file" ] && continue
  echo "$page: no file $file"
  bad=1
done
grep -n '^<!-- holds: ' "$page" | while IFS=: read -r line _ word; do
  word=$(echo "$word" | tr -d ' >-')
  holding=$(grep -rlwI -- "$word" libbreast tools tests docs pipelines python cmake 2>/dev/null |
    grep -vxF -e "$page" -e tests/tools/adding.sh | sort)
  [ "$(named "$line")" = "$holding" ] && continue
  echo "$page, '$word': the page names" $(named "$line") "but it is held by" $holding
  exit 1
done || bad=1
exit $bad
