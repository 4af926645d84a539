#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Seconds of the mammogram stages of a finished run, on an otherwise idle machine: mammo-times.sh BIN RUN.
set -euo pipefail
export LC_ALL=C
bin=$1 run=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
value() { "$bin/tabulate" key "$work/$1.json" "$2" --quiet; }
row() { printf '%s\t%s\t%s\n' "$1" "$2" "$3"; }
printf 'what\tseconds\tof\n'
"$bin/project-mammogram" "$run/cc.vtkhdf" "$work/cc.vti" --labels "$run/labels.vtkhdf" --pixel 0.1 --energy W/Rh:28 \
  --report "$work/image.json" --quiet 2> /dev/null
row "CC image, 0.1 mm pixels, spectrum" "$(value image seconds/project)" "$(value image width_pixels) x $(value image height_pixels) pixels"
"$bin/cc2mlo" "$run/cc-sensitivity.vtkhdf" "$run/mlo-sensitivity.vtkhdf" "$work/c.vtp" --landmark tumour --band \
  --table "$work/c.tsv" --report "$work/curve.json" --quiet 2> /dev/null
row "one curve with its band, after loading" "$(printf '%.4g' "$(value curve milliseconds_per_curve)e-3")" 1
"$bin/match-lookup" "$run/cc-sensitivity.vtkhdf" "$run/mlo-sensitivity.vtkhdf" "$work/l.h5" --pitch 1 \
  --report "$work/grid.json" --quiet 2> /dev/null
row "all curves and bands, 1 mm grid" "$(value grid seconds/match)" "$(value grid matched) curves"
