#!/usr/bin/env bash
# The table of error against run time: cost.sh FOLDER PROBE FINEST POINT...
# A row a point ELEMENT-TEMPLATE-N[-SOLVER] from FOLDER/POINT-{reference,supine}.{vtkhdf,json}. error_mm: largest
# distance of tumour or nipple to FINEST's; estimate_mm: what the solve itself said; "-": no solution or not estimated.
set -euo pipefail
folder=$1 probe=$2 finest=$3
shift 3
. "$(dirname "$0")/values.sh"
# Largest landmark distance of a point's shape to the finest one's: error POINT SHAPE
error() {
  "$probe" "$folder/$1-$2.vtkhdf" --base "$folder/$finest-$2.vtkhdf" --landmarks tumour,nipple --quiet |
    awk -F'\t' '/^#/ { next } $1 == "file" { for (i = 1; i <= NF; i++) at[$i] = i; next }
      { a = $at["tumour_relative_mm"]; b = $at["nipple_relative_mm"]; printf "%.4f", (a > b ? a : b) }'
}
printf 'point\telement\ttemplate\tsolver\telements\tunknowns\tnewton_iterations\tcpu_s\twall_s\tpeak_mb'
printf '\tstress_free_error_mm\tsupine_error_mm\tstress_free_estimate_mm\tsupine_estimate_mm\n'
for point in "$@"; do
  IFS=- read -r element template _ solver <<< "$point"
  backward=$folder/$point-reference.json forward=$folder/$point-supine.json
  sum() { awk -v a="$(number "$backward" "$1")" -v b="$(number "$forward" "$1")" 'BEGIN { printf "%.2f", a + b }'; }
  printf '%s\t%s\t%s\t%s' "$point" "$element" "$template" "${solver:-auto}"
  if [ -f "$folder/$point.failed" ]; then
    printf '\t-%.0s' {1..10}
  else
    printf '\t%s' "$(key "$forward" elements)" "$(key "$forward" unknowns)" \
      "$(key "$backward" newton_iterations)+$(key "$forward" newton_iterations)" "$(sum cpu_seconds)" "$(sum total)" \
      "$(rounded 0 "$(key "$backward" peak_mb)")" "$(error "$point" reference)" "$(error "$point" supine)" \
      "$(rounded 4 "$(number "$backward" error_estimate_mm)")" "$(rounded 4 "$(number "$forward" error_estimate_mm)")"
  fi
  printf '\n'
done
