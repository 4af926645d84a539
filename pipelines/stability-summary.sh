#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# One page of the two tables of extreme cases: stability-summary.sh MECHANICS.tsv CONTACT.tsv
# A row a direction (compression: one) and outcome: how many cases, the worst of what they say, the seconds of all; the
# names of those that did not converge, or ended otherwise than their case states.
set -euo pipefail
export LC_ALL=C
printf 'solve\toutcome\tcases\tworst_residual\tleast_det_F\tmost_newton\tseconds\twhich\n'
# summary NAME OUTCOME RESIDUAL DET_F NEWTON SECONDS SOLVE VERDICT: the columns of these names; SOLVE may be text after "=".
summary() {
  awk -F'\t' -v want="$*" '
    BEGIN { n = split(want, name, " ") }
    NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; next }
    {
      solve = name[7] ~ /^=/ ? substr(name[7], 2) : $at[name[7]]
      good = name[8] == "" || $at[name[8]] == "success"
      key = solve "\t" $at[name[2]] (good ? "" : ", not as stated")
      if (!(key in cases)) order[++keys] = key
      ++cases[key]
      if ($at[name[3]] > worst[key] + 0) worst[key] = $at[name[3]]
      if ($at[name[4]] + 0 > 0 && (!(key in least) || $at[name[4]] + 0 < least[key])) least[key] = $at[name[4]] + 0
      if ($at[name[5]] > most[key] + 0) most[key] = $at[name[5]]
      seconds[key] += $at[name[6]]
      if (!good || $at[name[2]] != "converged") which[key] = which[key] (which[key] == "" ? "" : "; ") $at[name[1]]
    }
    END {
      for (k = 1; k <= keys; ++k) {
        key = order[k]
        # A scene refused before its first state has neither residual nor det F.
        printf "%s\t%d\t%s\t%s\t%d\t%.1f\t%s\n", key, cases[key], key in least ? sprintf("%.1e", worst[key]) : "-",
          key in least ? sprintf("%.3f", least[key]) : "-", most[key], seconds[key], which[key] == "" ? "-" : which[key]
      }
    }'
}
summary case outcome residual min_det_F newton seconds direction < "$1"
summary case outcome residual min_det_F newton seconds =compression verdict < "$2"
