#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# robustness-table.sh PROGRAM NAME=MR:SIDE ... : runs bench_segment_robustness on every scan, rows of all cases into
# robustness-NAME.tsv here, and prints per case how many scans were refused, failed, flagged, and failed unflagged.
set -eu
export LC_ALL=C
program=$1
shift
for scan in "$@"; do
  name=${scan%%=*} rest=${scan#*=}
  out=robustness-$name.tsv
  [ -s "$out" ] || { "$program" "${rest%:*}" "${rest##*:}" > "$out.part" && mv "$out.part" "$out"; }
done
printf 'case\tscans\trefused\tfailed\tflagged\tfailed_unflagged\tflagged_sound\n'
cat robustness-*.tsv | awk -F '\t' '
  $1 == "case" { next }
  !($1 in scans) { order[++n] = $1 }
  { scans[$1]++; failed[$1] += $11; flagged[$1] += $12; refused[$1] += $14 ~ /^refused/
    silent[$1] += $11 && !$12; sound[$1] += !$11 && $12 && $14 !~ /^refused/ }
  END { for (i = 1; i <= n; i++) { c = order[i]
    printf "%s\t%d\t%d\t%d\t%d\t%d\t%d\n", c, scans[c], refused[c], failed[c], flagged[c], silent[c], sound[c] } }'
