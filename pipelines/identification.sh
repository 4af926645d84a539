#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Judges the rows of identification_study: identification.sh ROWS.tsv...  One row a study and truth: means over its draws,
# directions known to 5 % (known_5_percent) and how many of them meet the truth within 10 % and within two deviations, all directions
# within two deviations, per cent of draws that the misfit test at 5 % takes for another model.
set -euo pipefail
export LC_ALL=C
awk -F'\t' -v OFS='\t' '
  FNR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
  function of(name) { return $at[name] }
  {
    key = of("study") OFS of("truth")
    if (!(key in draws)) order[++count] = key
    draws[key]++
    elements[key] = of("elements")
    pairs[key] += of("pairs"); if (of("pairs") > most[key]) most[key] = of("pairs")
    cpu[key] += of("cpu_s"); settled[key] += of("converged")
    known[key] += of("identifiable"); ten[key] += of("within_10_percent"); two[key] += of("within_2_sd")
    directions[key] += of("directions"); all_two[key] += of("all_within_2_sd")
    motion[key] += of("motion_mm"); left[key] += of("left_out_mm"); off[key] += of("true_mm")
    if (of("true_mm") > worst[key]) worst[key] = of("true_mm")
    alarms[key] += of("probability") < 0.05
  }
  function share(part, whole) { return whole > 0 ? sprintf("%.0f", 100 * part / whole) : "-" }
  END {
    print "study", "truth", "draws", "elements", "settled", "pairs", "pairs_most", "cpu_s", "known_5_percent", "within_10_percent_%",
      "within_2_sd_%", "all_within_2_sd_%", "moved_mm", "left_out_mm", "true_mm", "true_worst_mm", "alarms_%"
    for (i = 1; i <= count; i++) {
      k = order[i]; n = draws[k]
      surface = k ~ /^surface/
      print k, n, elements[k], settled[k], sprintf("%.1f", pairs[k] / n), most[k], sprintf("%.1f", cpu[k] / n),
        directions[k] ? known[k] : "-", share(ten[k], known[k]), share(two[k], known[k]), share(all_two[k], directions[k]),
        sprintf("%.0f", motion[k] / n), surface ? "-" : sprintf("%.2f", left[k] / n), sprintf("%.2f", off[k] / n),
        sprintf("%.2f", worst[k]), surface ? "-" : share(alarms[k], n)
    }
    print "# rows " count
  }' "$@"
