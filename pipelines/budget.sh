#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The error budget's table: budget.sh RUN ROW...  Mean and largest error, mm, of the truth's places in the stress-free
# and supine shapes, and of their MLO places from the curve (mean, 95 %, largest), with one stage replaced by the
# truth; cpu_s: what the chain's own stage took, user seconds (chain: all of it); missing: why a cell is "-".
set -euo pipefail
run=$1
shift
. "$(dirname "$0")/values.sh"
cpu() { # STAGE...: CPU seconds of these stages of the chain
  local total=0 stage
  for stage in "$@"; do
    total=$(awk -v a="$total" -v b="$(number "$run/$stage.json" cpu_seconds)" 'BEGIN { printf "%.2f", a + b }')
  done
  echo "$total"
}
stages() { # the chain's stages that a row replaces
  case "$1" in
    chain) echo labels geometry mesh reference supine truth-cc truth-mlo cc-mammogram mlo-mammogram ;;
    segmentation) echo labels ;;
    body) echo labels geometry mesh ;;
    tissue) echo labels ;;
    cut) ;;
    discretisation) echo reference supine truth-cc truth-mlo ;;
    backward) echo reference ;;
    compression) echo reference truth-cc truth-mlo ;;
  esac
}
value() { local cell; cell=$(cell "$@"); [ -n "$cell" ] && [ "$cell" != - ] && rounded 3 "$cell" || printf -- '-'; }
landmark_row() { # TABLE: mean and largest of both shapes
  [ -s "$1" ] || { printf -- '-\t-\t-\t-'; return 0; }
  printf '%s\t%s\t%s\t%s' "$(value "$1" mean stress_free_error_mm)" "$(value "$1" largest stress_free_error_mm)" \
    "$(value "$1" mean supine_error_mm)" "$(value "$1" largest supine_error_mm)"
}
# Mean, p95 and largest stand in the column `landmark` of the table of curves.
curve() { awk -F'\t' -v row="$2" '
  /^#/ { next }
  !header { header = 1; for (i = 1; i <= NF; i++) { if ($i == "landmark") name = i; if ($i == "true_to_curve_mm") at = i }; next }
  $name == row { printf "%.3f", $at; found = 1 }
  END { if (!found) printf "-" }' "$1"; }
missing() { # FOLDER ROW
  local shape said=
  [ "$2" != compression ] || said="stress-free, supine: not solved in this row"
  for shape in reference supine cc mlo; do
    [ ! -s "$run/studies/budget/$2/$shape.json" ] || [ -s "$run/studies/budget/$2/$shape.vtkhdf" ] ||
      said="${said:+$said; }$shape: $(key "$run/studies/budget/$2/$shape.json" reason)"
  done
  echo "${said:--}"
}
printf 'replaced\tstress_free_mean_mm\tstress_free_largest_mm\tsupine_mean_mm\tsupine_largest_mm\tcurve_mean_mm\tcurve_p95_mm\tcurve_largest_mm\tcpu_s\tmissing\n'
for row in chain "$@"; do
  at=$run/budget/$row
  printf '%s\t%s\t%s\t%s\t%s\t%s\t%s\n' "$row" "$(landmark_row "$at/landmarks.tsv")" "$(curve "$at/curves.tsv" mean)" \
    "$(curve "$at/curves.tsv" p95)" "$(curve "$at/curves.tsv" largest)" "$(cpu $(stages "$row"))" "$(missing "$at" "$row")"
done
