#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Table II: the polynomial constants used beside the paper's, Pa: table2.sh PAPER.tsv MATERIALS.tsv
set -euo pipefail
export LC_ALL=C
awk -F'\t' -v OFS='\t' '
  BEGIN { count = split("a10_Pa a01_Pa a20_Pa a02_Pa a11_Pa", names, " ") }
  /^#/ { next }
  $1 == "tissue" { file++; for (i = 1; i <= NF; i++) at[file, $i] = i; next }
  { for (c = 1; c <= count; c++) value[file, $1, names[c]] = $at[file, names[c]] }
  file == 1 { order[++tissues] = $1 }
  END {
    print "tissue", "constant", "used", "paper", "difference"
    for (t = 1; t <= tissues; t++)
      for (c = 1; c <= count; c++) {
        used = value[2, order[t], names[c]]; paper = value[1, order[t], names[c]]
        print order[t], names[c], used, paper, (used ~ /^[-+0-9.eE]+$/ && used != "-" ? used - paper : "-")
      }
  }' "$1" "$2"
