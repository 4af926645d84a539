#!/usr/bin/env bash
# What each variant changes against the base case: leaveout.sh RUN PROBE VARIANT...
# Supine: how far tumour and nipple lie from the base's; CC, MLO: the same for the tumour; curve: mean and
# largest distance of the MLO curve from the base's (evaluate --curves), mm. seconds: mechanics and compression,
# saved_seconds: less than the base (timings of one run on one machine).
set -euo pipefail
run=$1 probe=$2
shift 2
evaluate=$(dirname "$probe")/evaluate
. "$(dirname "$0")/values.sh"
# Distance of a landmark between a file and the base's.
moved() {
  rounded 3 "$("$probe" "$1" --base "$2" --landmarks "$3" --quiet | cell - "$(basename "$1")" "$3_relative_mm")"
}
seconds() {
  local total=0 stage
  for stage in reference supine cc mlo; do
    total=$(awk -v a="$total" -v b="$(number "$1/$stage.json" total)" 'BEGIN { printf "%.2f", a + b }')
  done
  echo "$total"
}
base_seconds=$(seconds "$run")
printf 'variant\tsupine_tumour_mm\tsupine_nipple_mm\tcc_tumour_mm\tmlo_tumour_mm\tcurve_mean_mm\tcurve_max_mm\tcc_force_N\tseconds\tsaved_seconds\n'
printf 'base\t0\t0\t0\t0\t0\t0\t%.1f\t%s\t0\n' "$(key "$run/cc.json" force_N)" "$base_seconds"
for variant in "$@"; do
  folder=$run/leaveout/$variant
  curve=$("$evaluate" "$folder/curve.vtp" "$run/curve.vtp" --curves --quiet |
    awk -F'\t' '$1 == "curve_mean_mm" { mean = $2 } $1 == "curve_max_mm" { most = $2 } END { print mean "\t" most }')
  own=$(seconds "$folder")
  printf '%s\t%s\t%s\t%s\t%s\t%s\t%.1f\t%s\t%s\n' "$variant" \
    "$(moved "$folder/supine.vtkhdf" "$run/supine.vtkhdf" tumour)" "$(moved "$folder/supine.vtkhdf" "$run/supine.vtkhdf" nipple)" \
    "$(moved "$folder/cc.vtkhdf" "$run/cc.vtkhdf" tumour)" "$(moved "$folder/mlo.vtkhdf" "$run/mlo.vtkhdf" tumour)" \
    "$curve" "$(key "$folder/cc.json" force_N)" "$own" "$(awk -v a="$base_seconds" -v b="$own" 'BEGIN { printf "%.2f", a - b }')"
done
