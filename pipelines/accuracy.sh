#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Up a ladder of meshes, cheapest first, until the estimated error is met: accuracy.sh RUN MM TABULATE "POINT ..." MAKE...
# Writes RUN/accuracy.tsv, what was tried, and RUN/accuracy.mk, the ELEMENTS and ELEMENT chosen (the last rung where none is good
# enough).
set -euo pipefail
run=$1 wanted=$2 tabulate=$3 ladder=$4
shift 4
table=$run/accuracy.tsv coarser= chosen= row=
printf 'point\telements\tstress_free_estimate_mm\tsupine_estimate_mm\tcpu_s\tmeets\n' > "$table.part"
for point in $ladder; do
  "$@" "$run/studies/cost/$point/supine.json" >&2
  tried=$($tabulate accuracy "$run/studies/cost" "$point" "$wanted" $coarser)
  [ -n "$tried" ] || continue  # no solution
  row=$tried chosen=$point
  [[ $point != q2p1-* ]] || coarser=$point
  printf '%s\n' "$row" | tee -a "$table.part" >&2
  [[ $row != *yes ]] || break
done
[ -n "$chosen" ] || { echo "accuracy: no mesh of the ladder could be solved: see $run/studies/cost" >&2; exit 3; }
mv "$table.part" "$table"
[[ $row = *yes ]] || echo "accuracy: $wanted mm is not met by any mesh tried; the finest is taken" >&2
IFS=- read -r element _ edge _ <<< "$chosen"
printf 'ELEMENTS := %s\nELEMENT := %s\n' "$edge" "$element" > "$run/accuracy.mk.part"
mv "$run/accuracy.mk.part" "$run/accuracy.mk"
