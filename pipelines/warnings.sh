#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What the stages of a run warned of, each warning once, and what to do about it: warnings.sh RUN
# A line each, tab-separated: the stages that say it, the warning, the advice (pipelines/advice.tsv: the first pattern that
# matches; "-" where there is none). In the order of the chain, those with the same advice together; the advice stands in
# the last of them only.
set -euo pipefail
export LC_ALL=C
run=$1
advice=$(dirname "$0")/advice.tsv
for stage in labels geometry mesh reference supine cc mlo cc-mammogram mlo-mammogram curve lookup; do
  [ -s "$run/$stage.json" ] || continue
  # The strings of the top-level list "warnings", two spaces in; JSON's escapes undone.
  awk -v stage="$stage" '
    /^  "warnings": \[/ { inside = 1; next }
    inside && /^  \]/ { exit }
    inside {
      sub(/^ *"/, ""); sub(/",?$/, "")
      gsub(/\\"/, "\""); gsub(/\\[tnr]/, " "); gsub(/\\\\/, "\\")
      print stage "\t" $0
    }' "$run/$stage.json"
done | awk -F'\t' '
  FNR == 1 { ++file }
  file == 1 { if ($0 !~ /^#/ && NF >= 2) { pattern[++patterns] = $1; remedy[patterns] = $2 } next }
  !($2 in stages) { order[++count] = $2; stages[$2] = $1; next }
  { stages[$2] = stages[$2] ", " $1 }
  END {
    for (k = 1; k <= count; ++k) {
      group[k] = patterns + k  # no advice: a group of its own
      for (p = 1; p <= patterns; ++p) if (order[k] ~ pattern[p]) { group[k] = p; break }
      last[group[k]] = k
    }
    for (k = 1; k <= count; ++k) {
      if (shown[group[k]]++) continue
      for (j = k; j <= count; ++j) if (group[j] == group[k])
        print stages[order[j]] "\t" order[j] "\t" (j == last[group[k]] && group[k] <= patterns ? remedy[group[k]] : "-")
    }
  }' "$advice" -
