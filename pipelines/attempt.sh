#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A stage of a variant, which may have no solution: attempt.sh STAGE.json "INPUT ..." PROGRAM ARGUMENT...
# Where it does not converge (exit 3) the program's report STAGE.json says why and is the result; where an INPUT was not found
# for such a reason, INPUT's report becomes this one's. Either way nothing else of the stage is left. Any other failure stops.
set -euo pipefail
report=$1 inputs=$2
shift 2
rm -f "${report%.json}".{vtkhdf,vtp,tsv,json}
for input in $inputs; do
  [ ! -e "$input" ] || continue
  cp "${input%.vtkhdf}.json" "$report"
  exit 0
done
code=0
"$@" || code=$?
# A program of somebody else's need not write a report.
[ "$code" -ne 0 ] || [ -s "$report" ] || printf '{\n  "status": "ok"\n}\n' > "$report"
[ "$code" -eq 0 ] || [ "$code" -eq 3 -a -s "$report" ]
