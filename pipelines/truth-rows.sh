#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A chain's errors against its phantom's truth, a row a posture: truth-rows.sh RUN... with the truth-compressed.tsv of `make truth`,
# or truth.tsv where nothing was compressed. Means and largest over the landmarks, mm: how far the truth moved from the scan, the
# chain's error, the same in per cent of the motion, and the truth's own error.
set -euo pipefail
export LC_ALL=C
printf 'case\tshape\tmoved_mm\terror_mm\tlargest_mm\terror_percent\town_error_mm\tlargest_own_mm\n'
for run in "$@"; do
  table=$run/truth-compressed.tsv
  [ -f "$table" ] || table=$run/truth.tsv
  awk -F'\t' -v case="$(basename "$run")" '
    /^#/ { next }
    !header { header = 1; for (i = 1; i <= NF; i++) at[$i] = i; next }
    $1 == "mean" || $1 == "largest" { for (name in at) value[$1, name] = $at[name] }
    function shown(row, name) { return (name in at) && value[row, name] != "-" ? sprintf("%.2f", value[row, name]) : "-" }
    END {
      count = split("stress_free supine cc mlo", shape, " ")
      for (k = 1; k <= count; k++) {
        s = shape[k]
        if (!((s "_error_mm") in at)) continue
        moved = value["mean", s "_true_mm"]; error = value["mean", s "_error_mm"]
        printf "%s\t%s\t%.1f\t%.1f\t%.1f\t%.0f\t%s\t%s\n", case, s, moved, error, value["largest", s "_error_mm"], 100 * error / moved,
          shown("mean", s "_own_error_mm"), shown("largest", s "_own_error_mm")
      } }' "$table"
done
