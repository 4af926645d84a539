#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The paper's conclusions judged for several models, side by side: judge.sh CONCLUSIONS.tsv NAME=VALUES...
# VALUES are what conclusions.sh prints. Two columns a model: its value, and whether it lies in the bounds.
set -euo pipefail
export LC_ALL=C
conclusions=$1
shift
names=() files=()
for model in "$@"; do names+=("${model%%=*}") files+=("${model#*=}"); done
awk -F'\t' -v OFS='\t' -v names="${names[*]}" '
  BEGIN { count = split(names, name, " ") }
  FNR == 1 { file++ }
  file <= count { value[file, $1] = $2; next }
  FNR == 1 { line = "conclusion" OFS "lowest" OFS "highest"
    for (m = 1; m <= count; m++) line = line OFS name[m] OFS name[m] "_verdict"
    print line; next }
  { line = $2 OFS $3 OFS $4
    for (m = 1; m <= count; m++) {
      v = value[m, $1]
      line = line OFS (v == "" ? "-" : v) OFS ((v == "" || v == "-") ? "not evaluated" : (v + 0 >= $3 + 0 && v + 0 <= $4 + 0) ? "holds" : "fails") }
    print line }' "${files[@]}" "$conclusions"
