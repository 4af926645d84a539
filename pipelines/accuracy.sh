#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Up a ladder of meshes, cheapest first, until the estimated error is met: accuracy.sh RUN MM PROBE "POINT ..." MAKE...
# 8-node elements say their error themselves; of 27-node ones it is taken to be at most the distance to the rung of
# 27-node elements before (the first of them only starts the comparison).
# Writes RUN/accuracy.tsv, what was tried, and RUN/accuracy.mk, the ELEMENTS and ELEMENT chosen (the last rung where
# none is good enough).
set -euo pipefail
run=$1 wanted=$2 probe=$3 ladder=$4
shift 4
. "$(dirname "$0")/values.sh"
table=$run/accuracy.tsv
printf 'point\telements\tstress_free_estimate_mm\tsupine_estimate_mm\tcpu_s\tmeets\n' > "$table.part"
meets=no coarser=
for point in $ladder; do
  "$@" "$run/studies/cost/$point/supine.json" >&2
  backward=$run/studies/cost/$point/reference.json forward=$run/studies/cost/$point/supine.json
  [ -s "${forward%.json}.vtkhdf" ] || continue
  if [ "${point%%-*}" = q2p1 ]; then
    a= b=
    if [ -n "$coarser" ]; then
      a=$(apart "$probe" "${backward%.json}.vtkhdf" "$run/studies/cost/$coarser/reference.vtkhdf")
      b=$(apart "$probe" "${forward%.json}.vtkhdf" "$run/studies/cost/$coarser/supine.vtkhdf")
    fi
    coarser=$point
  else
    a=$(number "$backward" error_estimate_mm) b=$(carried_estimate "$backward" "$forward")
  fi
  cpu=$(awk -v a="$(key "$backward" cpu_seconds)" -v b="$(key "$forward" cpu_seconds)" 'BEGIN { printf "%.2f", a + b }')
  meets=$(awk -v a="$a" -v b="$b" -v w="$wanted" 'BEGIN { print (a != "" && b != "" && a <= w + 0 && b <= w + 0) ? "yes" : "no" }')
  printf '%s\t%s\t%s\t%s\t%s\t%s\n' "$point" "$(key "$forward" elements)" "$(rounded 4 "$a")" "$(rounded 4 "$b")" \
    "$cpu" "$meets" >> "$table.part"
  chosen=$point
  [ "$meets" = no ] || break
done
[ -n "${chosen:-}" ] || { echo "accuracy: no mesh of the ladder could be solved: see $run/studies/cost/*/*.json" >&2; exit 3; }
mv "$table.part" "$table"
cat "$table" >&2
[ "$meets" = yes ] || echo "accuracy: $wanted mm is not met by any mesh tried; the finest is taken" >&2
IFS=- read -r element _ edge _ <<< "$chosen"
printf 'ELEMENTS := %s\nELEMENT := %s\n' "$edge" "$element" > "$run/accuracy.mk.part"
mv "$run/accuracy.mk.part" "$run/accuracy.mk"
