#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# "; did you mean X?" for the candidate that a slip of the fingers turns into WORD, nothing when none is near:
# suggest.sh WORD CANDIDATE...
set -euo pipefail
export LC_ALL=C
word=$1
shift
printf '%s\n' "$@" | awk -v word="$word" '
  function least(a, b) { return a < b ? a : b }
  function distance(a, b,    i, j, n, m, d) {  # edits, an exchange of neighbours counting one
    n = length(a); m = length(b)
    for (i = 0; i <= n; i++) d[i, 0] = i
    for (j = 0; j <= m; j++) d[0, j] = j
    for (i = 1; i <= n; i++)
      for (j = 1; j <= m; j++) {
        same = substr(a, i, 1) == substr(b, j, 1)
        d[i, j] = least(least(d[i - 1, j] + 1, d[i, j - 1] + 1), d[i - 1, j - 1] + (same ? 0 : 1))
        if (i > 1 && j > 1 && substr(a, i, 1) == substr(b, j - 1, 1) && substr(a, i - 1, 1) == substr(b, j, 1))
          d[i, j] = least(d[i, j], d[i - 2, j - 2] + 1)
      }
    return d[n, m]
  }
  { near = distance(toupper(word), toupper($0))
    if (best == "" || near < nearest) { best = $0; nearest = near } }
  END { if (best != "" && nearest <= 1 + length(word) / 4) printf "; did you mean %s?", best }'
