#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# How far the predicted places move when the chest wall moves by its own standard deviation, mm:
# wall-sensitivity.sh RUN VARIANT...
set -euo pipefail
run=$1
shift
here=$(dirname "$0")
. "$here/values.sh"
# Distance between a landmark's places in two reports.
moved() {
  paste -d, <("$here/landmark.sh" "$1" "$3" position) <("$here/landmark.sh" "$2" "$3" position) |
    awk -F, '{ printf "%.2f", sqrt(($1 - $4) ^ 2 + ($2 - $5) ^ 2 + ($3 - $6) ^ 2) }'
}
printf 'wall\tsigma_mean_mm\tvolume_ml\tsupine_tumour_mm\tsupine_nipple_mm\tcc_tumour_mm\tmlo_tumour_mm\n'
printf 'as found\t%.2f\t%.1f\t0\t0\t0\t0\n' "$(number "$run/labels.json" sigma_mean_mm)" "$(number "$run/mesh.json" volume_ml)"
for variant in "$@"; do
  folder=$run/studies/wall/$variant
  printf '%s\t%.2f\t%.1f\t%s\t%s\t%s\t%s\n' "$variant" "$(number "$folder/labels.json" sigma_mean_mm)" \
    "$(number "$folder/mesh.json" volume_ml)" \
    "$(moved "$folder/supine.json" "$run/supine.json" tumour)" "$(moved "$folder/supine.json" "$run/supine.json" nipple)" \
    "$(moved "$folder/cc.json" "$run/cc.json" tumour)" "$(moved "$folder/mlo.json" "$run/mlo.json" tumour)"
done
