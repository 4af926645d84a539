#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# changed-scans.sh PROGRAM COHORT OUT : for every case of the folder COHORT and every change of PROGRAM (changed_scan), the changed
# scan OUT/scans/CASE--CHANGE.nrrd and its case file OUT/CASE--CHANGE.case. A mirror image has the other side and a mirrored truth.
set -eu
export LC_ALL=C
program=$1 cohort=$2 out=$3
mkdir -p "$out/scans"
out=$(cd "$out" && pwd)
value() { sed -n "s/^$1[[:blank:]]*=[[:blank:]]*//p" "$case"; }
for case in "$cohort"/*.case; do
  name=$(basename "$case" .case)
  mr=$(value MR) side=$(value SIDE) truth=$(value LABELS_TRUTH)
  "$program" | while IFS= read -r change; do
    row=$name--$(printf %s "$change" | sed 's/ %/-percent/; s/ /-/g')
    scan=$out/scans/$row.nrrd its_side=$side its_truth=$truth
    if [ "$change" = mirrored ]; then
      case $side in left) its_side=right ;; *) its_side=left ;; esac
      its_truth=${truth:+$out/scans/$row-truth.nrrd}
      [ -z "$truth" ] || [ -s "$its_truth" ] || "$program" "$truth" "$its_truth" mirrored
    fi
    [ -s "$scan" ] || "$program" "$mr" "$scan" "$change"
    { echo "MR = $scan"
      echo "SIDE = $its_side"
      [ -z "$its_truth" ] || echo "LABELS_TRUTH = $its_truth"
      sed '/^MR\|^SIDE\|^LABELS_TRUTH/d' "$case"; } > "$out/$row.case"
  done
done
