#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# How compressed shapes converge with the mesh: convergence.sh FOLDER PROBE N...
# A row a mesh FOLDER/N/{cc,mlo}.{vtkhdf,json}: distance of tumour and nipple to those of the last N, mm, and the forces of
# paddle and detector; estimate: of the tumour's discretisation error, by the solve itself. "-": no such state was reached
# (its report says why).
set -euo pipefail
folder=$1 probe=$2
shift 2
. "$(dirname "$0")/values.sh"
finest=${!#}
apart_at() { # VIEW N LANDMARK
  "$probe" "$folder/$2/$1.vtkhdf" --base "$folder/$finest/$1.vtkhdf" --landmarks "$3" --quiet | cell - "$1.vtkhdf" "$3_relative_mm"
}
estimate_at() { # REPORT: of the tumour
  awk '/^  "landmarks":/ { inside = 1 } inside && /^    "(artificial_)?tumour":/ { found = 1 }
    found && $1 == "\"error_estimate_mm\":" { sub(/,$/, "", $2); printf "%.2f", $2; exit }' "$1"
}
printf 'N (elements)\tCC tumour\tits estimate\tnipple\tforces, N\tMLO tumour\tits estimate\tnipple\tforces, N\n'
for n in "$@"; do
  printf '%s (%s)' "$n" "$(key "$folder/$n/mesh.json" elements)"
  for view in cc mlo; do
    report=$folder/$n/$view.json
    if [ ! -s "$folder/$n/$view.vtkhdf" ]; then
      printf '\t-\t-\t-\t-'
    else
      forces="$(rounded 1 "$(key "$report" force_N)") / $(rounded 1 "$(key "$report" detector_force_N)")"
      [ "$(key "$report" status)" = converged ] || forces+=", stopped at $(rounded 1 "$(key "$report" reduction_percent)") %"
      printf '\t%s\t%s\t%s\t%s' "$(rounded 2 "$(apart_at "$view" "$n" tumour)")" "$(rounded 2 "$(estimate_at "$report")")" "$(rounded 2 "$(apart_at "$view" "$n" nipple)")" "$forces"
    fi
  done
  printf '\n'
done
