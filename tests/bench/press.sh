#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# press.sh OUT.tsv N BULK_RATIO CCX_ELEMENT GAP_PERCENT contact|prescribed
# The 0.1 m cube of fat, clamped at x = 0, pressed to GAP_PERCENT of its height by ours (contact) and by CalculiX,
# one thread each, one after the other; one row: force on the upper plate, iterations, CPU seconds (user + system).
# contact: CalculiX presses with two rigid plates, node to surface, PENALTY Pa/mm; prescribed: it is told what the nodes of
# both faces do (no contact to be found), the easier task. Nodes on the clamped edge are left out, as in bench_pressed_block.
set -euo pipefail
export LC_ALL=C
out=$1 n=$2 ratio=$3 element=$4 gap=$5 mode=$6
bin=${BIN:-build/release/bin}
work=${out%.tsv}
mkdir -p "$work"
export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1
penalty=${PENALTY:-1e6}

# The model of export-deck's deck up to its step, with the nodes of both faces as sets.
model() {
  awk -F, '/^\*STEP/ { exit } { print } /^\*/ { nodes = /^\*NODE, NSET=ALL/; next } nodes && $2 > 1e-6 && $4 > 100 - 1e-6 { top = top $1 "\n" }
    nodes && $2 > 1e-6 && $4 < 1e-6 { bottom = bottom $1 "\n" } END { printf "*NSET, NSET=TOP\n%s*NSET, NSET=BOTTOM\n%s", top, bottom }' "$1"
}
# Each plate is one element that is moved as a whole; FACE of it presses NODES.
plate() { # NAME FIRST_NODE Z_LOW Z_HIGH ELEMENT FACE NODES
  local i=$2 z
  echo "*NODE, NSET=$1"
  for z in "$3" "$4"; do
    printf '%d,-50,-100,%s\n%d,250,-100,%s\n%d,250,200,%s\n%d,-50,200,%s\n' \
      "$i" "$z" $((i + 1)) "$z" $((i + 2)) "$z" $((i + 3)) "$z"
    i=$((i + 4))
  done
  printf '*ELEMENT, TYPE=C3D8, ELSET=PLATES\n%d,%d,%d,%d,%d,%d,%d,%d,%d\n' "$5" $(seq "$2" $(($2 + 7)))
  printf '*SURFACE, NAME=S%s, TYPE=NODE\n%s\n*SURFACE, NAME=M%s\n%d,%s\n' "$1" "$7" "$1" "$5" "$6"
  printf '*CONTACT PAIR, INTERACTION=PRESS, TYPE=NODE TO SURFACE\nS%s,M%s\n' "$1" "$1"
}
step() { # UPPER LOWER: sets that are moved
  printf '*STEP, NLGEOM, INC=10000\n*STATIC\n0.05,1.,1e-5,0.1\n*BOUNDARY\n'
  [ "$mode" = prescribed ] || printf '%s,1,2\n%s,1,2\n' "$1" "$2"
  printf '%s,3,3,-%s\n%s,3,3,%s\n' "$1" "$travel" "$2" "$travel"
  printf '*NODE PRINT, NSET=%s, TOTALS=ONLY, FREQUENCY=1\nRF\n*END STEP\n' "$1"
}

"$bin/block_mesh" "$n" "$work/block.vtkhdf"
"$bin/export-deck" "$work/block.vtkhdf" "$work/block.inp" --bulk-ratio "$ratio" --calculix-element "$element" \
  --materials seed2008 --gravity 0,0,0 --quiet
travel=$(awk -v g="$gap" 'BEGIN { print (100 - g) / 2 }')
{
  model "$work/block.inp"
  if [ "$mode" = contact ]; then
    # Numbers right after the block's: CalculiX reserves memory for the largest.
    node=$(((n + 1) ** 3 + 1)) block=$((n ** 3 + 1))
    plate UPPER $node 100 110 $block S1 TOP
    plate LOWER $((node + 8)) -10 0 $((block + 1)) S2 BOTTOM
    printf '*MATERIAL, NAME=PLATE\n*ELASTIC\n1e9,.3\n*SOLID SECTION, ELSET=PLATES, MATERIAL=PLATE\n'
    printf '*SURFACE INTERACTION, NAME=PRESS\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n%s,1.\n' "$penalty"
    step UPPER LOWER
  else
    step TOP BOTTOM
  fi
} > "$work/press.inp"

rm -f "$work"/press.{dat,sta}
TIMEFORMAT='%U %S'
{ time env -C "$work" ccx press > "$work/ccx.log" 2>&1 || true; } 2> "$work/time"
ccx_s=$(awk '{ printf "%.2f", $1 + $2 }' "$work/time")
iterations=$(grep -c '^ iteration ' "$work/ccx.log" || true)
reached=$(awk 'NF > 5 && $1 ~ /^[0-9]+$/ { last = $5 } END { print last + 0 }' "$work/press.sta")
ccx_N=$(awk '/total force/ { getline; getline; f = $3 } END { printf "%.1f", (f < 0 ? -f : f) * 1e-6 }' "$work/press.dat")
"$bin/bench_pressed_block" --bulk-ratio "$ratio" --to "$gap" "$n" > "$work/ours.tsv"
"$bin/tabulate" pressed "$work/ours.tsv" "$(basename "$work")" "$gap" "$reached" "$ccx_N" "$iterations" "$ccx_s" --quiet > "$out.part"
mv "$out.part" "$out"
