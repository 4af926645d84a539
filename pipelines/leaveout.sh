#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What each variant changes against the base case: leaveout.sh RUN PROBE VARIANT...
# Supine: how far tumour and nipple lie from the base's; CC, MLO: the same for the tumour; curve: mean and
# largest distance of the MLO curve from the base's (evaluate --curves), mm. CPU seconds of the stages each question
# needs, surgery (backward, forward) and matching (backward, both compressions), and what they are less than the base's
# (timings of one run on one machine).
set -euo pipefail
run=$1 probe=$2
shift 2
evaluate=$(dirname "$probe")/evaluate
. "$(dirname "$0")/values.sh"
# Distance of a landmark between a file and the base's.
moved() {
  rounded 3 "$("$probe" "$1" --base "$2" --landmarks "$3" --quiet | cell - "$(basename "$1")" "$3_relative_mm")"
}
seconds() { # FOLDER STAGE...
  local folder=$1 stage
  shift
  for stage in "$@"; do number "$folder/$stage.json" cpu_seconds; done | awk '{ total += $1 } END { printf "%.1f", total }'
}
less() { awk -v a="$1" -v b="$2" 'BEGIN { printf "%.1f", a - b }'; }
surgery=$(seconds "$run" reference supine) matching=$(seconds "$run" reference cc mlo)
printf 'variant\tsupine_tumour_mm\tsupine_nipple_mm\tcc_tumour_mm\tmlo_tumour_mm\tcurve_mean_mm\tcurve_max_mm\tcc_force_N\tsurgery_cpu_s\tsurgery_saved_s\tmatching_cpu_s\tmatching_saved_s\n'
printf 'base\t0\t0\t0\t0\t0\t0\t%.1f\t%s\t0\t%s\t0\n' "$(key "$run/cc.json" force_N)" "$surgery" "$matching"
for variant in "$@"; do
  folder=$run/studies/leaveout/$variant
  curve=$("$evaluate" "$folder/curve.vtp" "$run/curve.vtp" --curves --quiet |
    awk -F'\t' '$1 == "curve_mean_mm" { mean = $2 } $1 == "curve_max_mm" { most = $2 } END { print mean "\t" most }')
  own_surgery=$(seconds "$folder" reference supine) own_matching=$(seconds "$folder" reference cc mlo)
  printf '%s\t%s\t%s\t%s\t%s\t%s\t%.1f\t%s\t%s\t%s\t%s\n' "$variant" \
    "$(moved "$folder/supine.vtkhdf" "$run/supine.vtkhdf" tumour)" "$(moved "$folder/supine.vtkhdf" "$run/supine.vtkhdf" nipple)" \
    "$(moved "$folder/cc.vtkhdf" "$run/cc.vtkhdf" tumour)" "$(moved "$folder/mlo.vtkhdf" "$run/mlo.vtkhdf" tumour)" \
    "$curve" "$(key "$folder/cc.json" force_N)" "$own_surgery" "$(less "$surgery" "$own_surgery")" \
    "$own_matching" "$(less "$matching" "$own_matching")"
done
