#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Round trips of breasts that slide, at ever softer fat and fibroglandular tissue, as TSV: backward from
# the prone scan and forward to it again, and forward to supine.
#
#     tests/bench/round-trips.sh BIN_DIR MESH.vtkhdf... > docs/tables/round-trips.tsv
#
# Skin as in Table II of Pathmanathan et al. (2008), resistance to sliding and springs at the cut
# 0.01 kPa/mm. closure_mm is the largest distance of a node from its place in the scan.
set -euo pipefail
here=$(cd "$(dirname "$0")/../.." && pwd)
bin=$1
shift
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# value FILE KEY: of a report, "-" where it has none.
value() { "$bin/tabulate" key "$1" "$2" --quiet 2> /dev/null || printf -- '-'; }

closure() {
  local found
  found=$(value "$1" closure_mm)
  [ "$found" = - ] && printf -- '-' || printf '%.1e' "$found"
}

printf 'breast\tpercent\telements\tstatus\treason\tbackward_newton\tclosure_mm\tsupine_status\tsupine_newton\tsupine_stable\n'
for mesh in "$@"; do
  name=$(basename "$mesh" -mesh.vtkhdf)
  for percent in 100 10 5 3; do
    awk -F '\t' -v OFS='\t' -v by="$percent" '
      $1 == "fat" || $1 == "fibroglandular" { for (i = 4; i <= NF; ++i) if ($i != "-") $i *= by / 100 }
      { print }' "$here/pipelines/materials/seed2008.tsv" > "$work/set.tsv"
    options=(--materials "$work/set.tsv" --wall slide:0.01 --cut spring:0.01 --quiet)
    rm -f "$work/back.vtkhdf" "$work"/*.json
    "$bin/backward" "$mesh" "$work/back.vtkhdf" --estimate none "${options[@]}" \
        --report "$work/back.json" 2> /dev/null || true
    supine=$'-\t-\t-'
    if [ -e "$work/back.vtkhdf" ]; then
      "$bin/forward" "$work/back.vtkhdf" "$work/supine.vtkhdf" --estimate none "${options[@]}" \
          --report "$work/supine.json" 2> /dev/null || true
      supine=$(printf '%s\t%s\t%s' "$(value "$work/supine.json" status)" \
          "$(value "$work/supine.json" newton_iterations)" "$(value "$work/supine.json" stable)")
    fi
    printf '%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\n' "$name" "$percent" \
        "$(value "$work/back.json" elements)" "$(value "$work/back.json" status)" \
        "$(value "$work/back.json" reason)" "$(value "$work/back.json" newton_iterations)" \
        "$(closure "$work/back.json")" "$supine"
  done
done
