#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# How far numerical choices move the paper's figures: findings.sh RUN VARIANT... (the last one is the finest)
# A row a choice: displacements of nipple and tumour from the imaged place, stress-free and supine, mm; the supine ones
# against the finest, per cent; the solve's own error estimate of the supine landmarks, mm; slope of the nipple by fat.
set -euo pipefail
run=$1
shift
here=$(dirname "$0")
. "$here/values.sh"
moved() { # REPORT LANDMARK
  paste -d, <("$here/landmark.sh" "$1" "$2" imaged) <("$here/landmark.sh" "$1" "$2" position) |
    awk -F, '{ printf "%.6f", sqrt(($1 - $4) ^ 2 + ($2 - $5) ^ 2 + ($3 - $6) ^ 2) }'
}
finest=$run/studies/findings/${!#}
nipple=- tumour=-
[ ! -s "$finest/supine.vtkhdf" ] || { nipple=$(moved "$finest/supine.json" nipple) tumour=$(moved "$finest/supine.json" tumour); }
row() { # NAME STRESS-FREE SUPINE SLOPES
  local a b
  a=$(moved "$3" nipple) b=$(moved "$3" tumour)
  percent() { awk -v a="$1" -v b="$2" 'BEGIN { if (b > 0) printf "%+.2f", 100 * (a / b - 1); else printf "-" }'; }
  slope() { awk -F'\t' -v l="$1" '{ sub(/^artificial_/, "", $1) } $1 == l && $2 == "fat" { printf "%.3f", $7 }' "$2"; }
  printf '%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\n' "$1" "$(key "$3" elements)" "$(rounded 3 "$(moved "$2" nipple)")" \
    "$(rounded 3 "$(moved "$2" tumour)")" "$(rounded 3 "$a")" "$(rounded 3 "$b")" "$(percent "$a" "$nipple")" \
    "$(percent "$b" "$tumour")" "$(rounded 3 "$(number "$3" error_estimate_mm)")" "$(slope nipple "$4")" "$(slope tumour "$4")"
}
printf 'model\telements\tstress_free_nipple_mm\tstress_free_tumour_mm\tsupine_nipple_mm\tsupine_tumour_mm\tnipple_from_finest_percent'
printf '\ttumour_from_finest_percent\testimate_mm\tfat_slope_nipple\tfat_slope_tumour\n'
printf 'paper\t4096\t4.5\t1.6\t8.78\t3.03\t-\t-\t-\t-0.607\t-0.705\n'
row default "$run/reference.json" "$run/supine.json" "$run/slopes.tsv"
for variant in "$@"; do
  name=$run/studies/findings/$variant
  if [ ! -s "$name/supine.vtkhdf" ]; then
    printf '%s\t-\t-\t-\t-\t-\t-\t-\t-\t-\t-\n' "$variant"
  else
    row "$variant" "$name/reference.json" "$name/supine.json" "$name/slopes.tsv"
  fi
done
