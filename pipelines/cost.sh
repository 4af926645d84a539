#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The table of error against run time: cost.sh FOLDER PROBE FINEST POINT...
# A row a point ELEMENT-TEMPLATE-N[-SOLVER] from FOLDER/POINT/{reference,supine}.{vtkhdf,json}. error_mm: largest
# distance of tumour or nipple to FINEST's; estimate_mm: what the solves themselves said (supine: both, the second starts
# from the first's); "-": no solution or not estimated.
set -euo pipefail
folder=$1 probe=$2 finest=$3
shift 3
. "$(dirname "$0")/values.sh"
printf 'point\telement\ttemplate\tsolver\telements\tunknowns\tnewton_iterations\tcpu_s\twall_s\tpeak_mb'
printf '\tstress_free_error_mm\tsupine_error_mm\tstress_free_estimate_mm\tsupine_estimate_mm\n'
for point in "$@"; do
  IFS=- read -r element template _ solver <<< "$point"
  backward=$folder/$point/reference.json forward=$folder/$point/supine.json
  sum() { awk -v a="$(number "$backward" "$1")" -v b="$(number "$forward" "$1")" 'BEGIN { printf "%.2f", a + b }'; }
  printf '%s\t%s\t%s\t%s' "$point" "$element" "$template" "${solver:-auto}"
  if [ ! -s "$folder/$point/supine.vtkhdf" ]; then
    printf '\t-%.0s' {1..10}
  else
    printf '\t%s' "$(key "$forward" elements)" "$(key "$forward" unknowns)" \
      "$(key "$backward" newton_iterations)+$(key "$forward" newton_iterations)" "$(sum cpu_seconds)" "$(sum total)" \
      "$(rounded 0 "$(key "$backward" peak_mb)")" \
      "$(apart "$probe" "$folder/$point/reference.vtkhdf" "$folder/$finest/reference.vtkhdf")" \
      "$(apart "$probe" "$folder/$point/supine.vtkhdf" "$folder/$finest/supine.vtkhdf")" \
      "$(rounded 4 "$(number "$backward" error_estimate_mm)")" "$(rounded 4 "$(carried_estimate "$backward" "$forward")")"
  fi
  printf '\n'
done
