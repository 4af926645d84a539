#!/usr/bin/env bash
# How compressed shapes converge with the mesh: convergence.sh FOLDER PROBE N...
# A row a mesh FOLDER/N-{CC,MLO}.{vtkhdf,json}: distance of tumour and nipple to those of the last N, mm, and the forces of
# paddle and detector. "-": no such state was reached (FOLDER/N-VIEW.failed).
set -euo pipefail
folder=$1 probe=$2
shift 2
. "$(dirname "$0")/values.sh"
finest=${!#}
apart_at() { # VIEW N LANDMARK
  "$probe" "$folder/$2-$1.vtkhdf" --base "$folder/$finest-$1.vtkhdf" --landmarks "$3" --quiet | cell - "$2-$1.vtkhdf" "$3_relative_mm"
}
printf 'N (elements)\tCC tumour\tnipple\tforces, N\tMLO tumour\tnipple\tforces, N\n'
for n in "$@"; do
  printf '%s (%s)' "$n" "$(key "$folder/$n-mesh.json" elements)"
  for view in CC MLO; do
    report=$folder/$n-$view.json
    if [ ! -s "$folder/$n-$view.vtkhdf" ]; then
      printf '\t-\t-\t-'
    else
      forces="$(rounded 1 "$(key "$report" force_N)") / $(rounded 1 "$(key "$report" detector_force_N)")"
      [ "$(key "$report" status)" = converged ] || forces+=", stopped at $(rounded 1 "$(key "$report" reduction_percent)") %"
      printf '\t%s\t%s\t%s' "$(rounded 2 "$(apart_at "$view" "$n" tumour)")" "$(rounded 2 "$(apart_at "$view" "$n" nipple)")" "$forces"
    fi
  done
  printf '\n'
done
