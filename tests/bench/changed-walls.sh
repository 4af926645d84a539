#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# changed-walls.sh CHANGED_SCAN EVALUATE RUNS : for every case RUNS/CASE--CHANGE with labels, RUNS/CASE--CHANGE/labels-same.tsv: its
# labels compared with those of CASE--unchanged, or with their mirror image.
set -eu
program=$1 evaluate=$2 runs=$3
for base in "$runs"/*--unchanged/labels.vtkhdf; do
  of=${base%--unchanged/labels.vtkhdf}
  mirrored=$of--unchanged/labels-mirrored.vtkhdf
  for labels in "$of"--*/labels.vtkhdf; do
    folder=${labels%/labels.vtkhdf} other=$base
    case $folder in
      *--mirrored)
        [ "$mirrored" -nt "$base" ] || "$program" "$base" "$mirrored" mirrored
        other=$mirrored ;;
    esac
    [ "$folder/labels-same.tsv" -nt "$labels" ] && [ "$folder/labels-same.tsv" -nt "$other" ] && continue
    "$evaluate" "$labels" "$other" --accept-other scan --threads 1 --quiet > "$folder/labels-same.tsv.part"
    mv "$folder/labels-same.tsv.part" "$folder/labels-same.tsv"
  done
done
