#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# One of Tables III to VI: scaled-table.sh PAPER.tsv PREFIX BASE.vtkhdf PROBE
# Rows are the paper's stiffnesses; ours come from PREFIX-PERCENT/supine.vtkhdf (BASE for 100). Columns: ours,
# the paper's, and the difference, for displacement and displacement relative to the base, mm; the solve's own
# estimate of its discretisation error there. "-": the material has no solution (PREFIX-PERCENT/supine.json says why). remark: the row
# of 100 per cent says when the case was fitted to the paper's (CALIBRATED, see calibration.sh).
set -euo pipefail
. "$(dirname "$0")/values.sh"
paper=$1 prefix=$2 base=$3 probe=$4
header="stiffness_percent"
for quantity in tumour_mm tumour_rel_mm nipple_mm nipple_rel_mm; do
  header+="\t$quantity\tpaper_$quantity\tdifference_$quantity"
done
printf "$header\testimate_mm\tremark\n"
tail -n +2 "$paper" | while IFS=$'\t' read -r percent paper_tumour paper_tumour_rel paper_nipple paper_nipple_rel; do
  file=$base
  [ "$percent" -eq 100 ] || file=$prefix-$percent/supine.vtkhdf
  ours=$(printf -- '-\t-\t-\t-') estimate=-
  if [ -s "$file" ] && [ -s "$base" ]; then
    ours=$("$probe" "$file" --base "$base" --landmarks tumour,nipple --quiet |
      awk -F'\t' '!/^#/ && $1 == "file" { for (i = 1; i <= NF; i++) { sub(/^artificial_/, "", $i); at[$i] = i } next }
                  !/^#/ { print $at["tumour_mm"] "\t" $at["tumour_relative_mm"] "\t" $at["nipple_mm"] "\t" $at["nipple_relative_mm"] }')
    estimate=$(rounded 3 "$(number "${file%.vtkhdf}.json" error_estimate_mm)")
  elif [ ! -s "${file%.vtkhdf}.json" ]; then
    echo "$file: missing" >&2
    exit 1
  fi
  remark=-
  [ "$percent" -ne 100 ] || [ -z "${CALIBRATED:-}" ] || remark="calibrated to this row"
  awk -F'\t' -v OFS='\t' -v remark="$remark" -v percent="$percent" -v ours="$ours" -v estimate="$estimate" \
    -v theirs="$paper_tumour	$paper_tumour_rel	$paper_nipple	$paper_nipple_rel" 'BEGIN {
      split(ours, o, "\t"); split(theirs, p, "\t"); line = percent
      for (i = 1; i <= 4; i++)
        line = line OFS (o[i] == "-" ? "-" : sprintf("%.3f", o[i])) OFS p[i] OFS (o[i] == "-" ? "-" : sprintf("%.3f", o[i] - p[i]))
      print line, estimate, remark }'
done
