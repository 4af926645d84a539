#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The preset `paper` was fitted so that the chain's own answer is the paper's; who reads that answer must be told.
#   calibration.sh note TRUTH_JSON SIDE         a sentence for the phantoms whose preset was fitted, nothing for the others
#   calibration.sh table RUN TRUTH_JSON SIDE    motions from the prone shape, mm: the paper, as printed, as solved, the truth
set -euo pipefail
here=$(dirname "$0")
. "$here/values.sh"
# A number below SIDE/landmarks/NAME of the phantom's report; stress_free or distance_mm.
of_phantom() { # JSON SIDE LANDMARK KEY
  awk -v side="\"$2\":" -v name="\"$3\":" -v key="\"$4\":" '
    /^  "/ { inside = $1 == side; found = 0 }
    inside && $1 == name { found = 1 }
    inside && found && $1 == key { gsub(/[^-+0-9.eE]/, "", $2); print $2; exit }' "$1"
}
preset_of() { sed -n 's/^ *"preset": "\(.*\)",\{0,1\}$/\1/p' "$1" | sed -n 1p; }
if [ "$1" = note ]; then
  [ -s "$2" ] && [ "$(preset_of "$2")" = paper ] || exit 0
  printf 'calibrated to this row: size and tumour of the preset "paper" were fitted so that this chain moves nipple and tumour as the paper'"'"'s does (8.8 and 3.0 mm supine); the phantom'"'"'s own truth moves %s and %s mm\n' \
    "$(rounded 2 "$(of_phantom "$2" "$3" nipple distance_mm)")" "$(rounded 2 "$(of_phantom "$2" "$3" tumour distance_mm)")"
  exit 0
fi
run=$2 truth=$3 side=$4
moved() { # REPORT LANDMARK: how far it is from its imaged place
  paste -d, <("$here/landmark.sh" "$1" "$2" imaged) <("$here/landmark.sh" "$1" "$2" position) |
    awk -F, '{ printf "%.2f", sqrt(($1 - $4) ^ 2 + ($2 - $5) ^ 2 + ($3 - $6) ^ 2) }'
}
row() { # NAME SUPINE_JSON REFERENCE_JSON REMARK
  printf '%s\t%s\t%s\t%s\t%s\t%s\n' "$1" "$(moved "$2" nipple)" "$(moved "$2" tumour)" "$(moved "$3" nipple)" "$(moved "$3" tumour)" "$4"
}
truth_at() { # LANDMARK: motion to the stress-free shape in the phantom's table of landmarks
  awk -F'\t' -v side="$side" -v name="$1" '
    /^#/ { next }
    !header { header = 1; for (i = 1; i <= NF; i++) at[$i] = i; next }
    $at["landmark"] == name && $at["side"] == side {
      for (d = 1; d <= 3; d++) { axis = substr("xyz", d, 1); q += ($at["stress_free_" axis "_mm"] - $at["prone_" axis "_mm"]) ^ 2 }
      printf "%.2f", sqrt(q); exit }' "${truth%.json}-truth/landmarks.tsv"
}
printf '\tnipple, supine\ttumour, supine\tnipple, stress-free\ttumour, stress-free\t\n'
printf 'the paper\t8.8\t3.0\t4.5\t1.6\t\n'
row 'as printed in the paper' "$run/studies/findings/as-printed/supine.json" "$run/studies/findings/as-printed/reference.json" 'calibrated to this row'
row 'default chain' "$run/supine.json" "$run/reference.json" 'calibrated to this row, by the same fit'
printf "the phantom's truth\t%s\t%s\t%s\t%s\t\n" "$(rounded 2 "$(of_phantom "$truth" "$side" nipple distance_mm)")" \
  "$(rounded 2 "$(of_phantom "$truth" "$side" tumour distance_mm)")" "$(truth_at nipple)" "$(truth_at tumour)"
