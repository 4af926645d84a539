#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Checks docs/tables/equations.tsv: every row's source file holds the named symbol, and its test file the named test.
set -eu
cd "$(dirname "$0")/../.."
tab=$(printf '\t')
bad=0
holds() {  # ROOT "file: text" WHAT
  file=$1/${2%%: *} text=${2#*: }
  if [ ! -f "$file" ]; then
    echo "docs/tables/equations.tsv, $3: no file $file"
    bad=1
  elif ! grep -qF -- "$text" "$file"; then
    echo "docs/tables/equations.tsv, $3: $file does not hold '$text'"
    bad=1
  fi
}
while IFS="$tab" read -r equation what source proof; do
  [ "$equation" != equation ] || continue
  holds libbreast "$source" "$equation"
  holds tests "$proof" "$equation"
done < docs/tables/equations.tsv
exit $bad
