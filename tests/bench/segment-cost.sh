#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# segment-cost.sh BIN MR SIDE MILLIONS... : CPU seconds and peak memory of segment with one thread, of the scan sampled again in so many
# million voxels of the same shape. The CPU seconds hardly depend on what else the machine does.
set -eu
export LC_ALL=C
bin=$1 mr=$2 side=$3
shift 3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
value() { "$bin/tabulate" key "$work/labels.json" "$1" --quiet; }
printf 'voxels_million\tcpu_s\tpeak_mb\tbreast_ml\tended\n'
for millions in "$@"; do
  "$bin/changed_scan" "$mr" "$work/scan.nrrd" "voxels=$millions"
  ended=done
  "$bin/segment" "$work/scan.nrrd" "$work/labels.vtkhdf" --side "$side" --threads 1 --quiet --report "$work/labels.json" || ended=refused
  printf '%s\t%.1f\t%.0f\t%.0f\t%s\n' "$millions" "$(value cpu_seconds)" "$(value peak_mb)" "$(value breast_ml)" $ended
done
