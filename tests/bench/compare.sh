#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# compare.sh MESH.vtkhdf OUT.tsv BULK_RATIO CCX_ELEMENT MATERIALS [gravity options]
# Solves one scene with forward and with CalculiX (ccx), one after the other, one thread each; prints one
# row: node-by-node distance, force balance, CPU seconds (user + system) of both programs and their ratio.
set -euo pipefail
export LC_ALL=C
mesh=$1 out=$2 ratio=$3 element=$4 materials=$5
shift 5
bin=${BIN:-build/release/bin}
work=${out%.tsv}
mkdir -p "$work"
export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1
case "$element" in C3D20*) ours=q2p1 ;; *) ours=q1p0 ;; esac
options=("$@" --bulk-ratio "$ratio" --materials "$materials" --element "$ours" --quiet)
cpu() { # seconds user + system of a command; its exit code in $status
  local TIMEFORMAT='%U %S'
  status=0
  { time "$@" > "$work/log" 2>&1 || status=$?; } 2> "$work/time" || true
  awk '{ printf "%.3f", $1 + $2 }' "$work/time" > "$work/cpu"
}
value() { "$bin/tabulate" key "$work/$1.json" "$2" --quiet; }

cpu "$bin/forward" "$mesh" "$work/ours.vtkhdf" "${options[@]}" --threads 1 --report "$work/ours.json"
[ $status = 0 ] || { cat "$work/log" >&2; exit $status; }
ours_s=$(cat "$work/cpu")
"$bin/export-deck" "$mesh" "$work/deck.inp" "${options[@]}" --calculix-element "$element" --without-skin
rm -f "$work"/deck.{frd,dat}
cpu env -C "$work" ccx deck
ccx_s=$(cat "$work/cpu")
cp "$work/log" "$work/ccx.log"
increments=$(grep -c '^ convergence' "$work/ccx.log" || true)
iterations=$(grep -c '^ iteration ' "$work/ccx.log" || true)
code=0
"$bin/export-deck" "$mesh" "$work/ccx.vtkhdf" --read-back "$work/deck.frd" --base "$work/ours.vtkhdf" \
  "${options[@]}" --without-skin --report "$work/ccx.json" > "$work/difference.tsv" 2> "$work/log" || code=$?
# forward also estimates its discretisation error: that part of its time (by the wall clock).
share=$(awk -v e="$(value ours 'seconds/error estimate')" -v t="$(value ours seconds/total)" \
  'BEGIN { printf "%.2f", (t > 0 ? e / t : 0) }')
outcome=converged mean=- max=- largest=- relative=- balance=-
if [ $code = 0 ]; then
  read -r mean max largest relative < <(tail -n 1 "$work/difference.tsv")
  balance=$(value ccx force_balance)
else
  outcome="CalculiX: $(sed 's/^export-deck: //' "$work/log" | tail -n 1)"
fi
{
  printf 'scene\tK_over_mu\tccx_element\tour_element\telements\tmean_mm\tmax_mm\tlargest_displacement_mm\tmax_relative'
  printf '\tour_residual\tccx_force_balance\tour_newton\tccx_increments\tccx_iterations\tour_cpu_s\tour_estimate_share'
  printf '\tccx_cpu_s\tccx_over_ours\tccx_over_our_solve\toutcome\n'
  printf '%s\t' "$(basename "$work")" "$ratio" "$element" "$ours" "$(value ours elements)" \
    "$mean" "$max" "$largest" "$relative" "$(value ours residual)" "$balance" \
    "$(value ours newton_iterations)" "$increments" "$iterations" "$ours_s" "$share" "$ccx_s"
  awk -v a="$ccx_s" -v b="$ours_s" -v s="$share" 'BEGIN { printf "%.1f\t%.1f", a / b, a / b / (1 - s) }'
  printf '\t%s\n' "$outcome"
} > "$out.part"
mv "$out.part" "$out"
