#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# forward by CalculiX: ccx-forward.sh REFERENCE DEFORMED [options of forward and export-deck]
#   make -f Makefile.pipeline FORWARD=pipelines/compare/ccx-forward.sh ...
# CCX_OPTIONS: options of export-deck that the other stages do not take, as --without-skin.
# Writes a deck, runs ccx on it, reads its displacements back. BIN: folder of our programs. KEEP=FOLDER
# keeps deck, log and result there. Exit codes are those of forward.
set -euo pipefail
export LC_ALL=C
pipelines=$(dirname "$0")/..
own=$pipelines/../build/release/bin
[ ! -f "$pipelines/installed.mk" ] || own=$pipelines/../../../libexec/breast
bin=$(realpath "${BIN:-$own}")
command -v ccx > /dev/null || { echo "ccx-forward: CalculiX is missing (Debian: calculix-ccx)" >&2; exit 1; }
[ $# -ge 2 ] || { echo "ccx-forward: usage: ccx-forward.sh REFERENCE DEFORMED [options]" >&2; exit 2; }
reference=$1 deformed=$2
shift 2
threads=$(nproc) back=()
read -r -a options <<< "${CCX_OPTIONS:-}"
while [ $# -gt 0 ]; do
  case "$1" in
    --report | --base) back+=("$1" "$2"); shift 2 ;;
    --threads) threads=$2; shift 2 ;;
    *) options+=("$1"); shift ;;
  esac
done
if [ -n "${KEEP:-}" ]; then
  work=$KEEP
  mkdir -p "$work"
else
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
fi
"$bin/export-deck" "$reference" "$work/deck.inp" "${options[@]}"
(cd "$work" && rm -f deck.frd deck.dat && OMP_NUM_THREADS=$threads ccx deck > ccx.log 2>&1) ||
  { grep -m 1 'ERROR' "$work/ccx.log" || tail -n 5 "$work/ccx.log"; } >&2
[ -s "$work/deck.frd" ] || { echo "ccx-forward: CalculiX wrote no result" >&2; exit 3; }
"$bin/export-deck" "$reference" "$deformed" --read-back "$work/deck.frd" "${options[@]}" "${back[@]}"
