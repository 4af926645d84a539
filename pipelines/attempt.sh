#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A solve that may have no solution: attempt.sh NAME PROGRAM INPUT [ARGUMENT]...
# writes NAME.vtkhdf and its report. Where it does not converge (exit 3), or INPUT itself was not found, the reason stays
# in NAME.failed and NAME.vtkhdf is absent: a finding, not an error. Any other failure stops.
set -euo pipefail
name=$1 program=$2 input=$3
shift 3
rm -f "$name.vtkhdf" "$name.json" "$name.failed"
if [ -f "${input%.vtkhdf}.failed" ]; then
  cp "${input%.vtkhdf}.failed" "$name.failed"
  exit 0
fi
code=0
"$program" "$input" "$name.vtkhdf" "$@" --report "$name.json" || code=$?
[ "$code" -ne 0 ] || exit 0
[ "$code" -eq 3 ] || exit "$code"
# The report's sentence, or its typed reason where it has none.
{ grep '^  "explanation": ".' "$name.json" || grep '^  "reason": "' "$name.json"; } | sed -E 's/^[^:]*: "(.*)",?$/\1/' > "$name.failed"
