#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Table VIII: the conclusions under several material sets, and how far each moves: table8.sh CONCLUSIONS.tsv RUN PROBE SET...
# The first rows say whether the set has a stress-free body, and the supine displacements; then pipelines/judge.sh.
set -euo pipefail
conclusions=$1 run=$2 probe=$3
shift 3
here=$(dirname "$0")
. "$here/values.sh"
models=("paper=$run/tables/.conclusions-paper.values" "ours=$run/tables/.ours.values")
for set in "$@"; do models+=("$set=$run/studies/table8/$set/.values"); done
table=$("$here/judge.sh" "$conclusions" "${models[@]}")
head -n 1 <<< "$table"
moved() { "$probe" "$1" --landmarks tumour,nipple --quiet | cell - "$(basename "$1")" "$2_mm"; }  # FILE LANDMARK
printf 'stress-free body of the imaged shape\t-\t-\t-\t\tyes\t'
for set in "$@"; do
  [ -s "$run/studies/table8/$set/supine.vtkhdf" ] && printf '\tyes\t' || printf '\tno\t%s ' "$(why "$run/studies/table8/$set/supine.json" | tr '\t' ' ')"
done
printf '\n'
for landmark in nipple tumour; do
  printf 'supine displacement of the %s, mm\t-\t-\t%s\t\t%s\t%s' $landmark \
    "$(cell "$here/paper/table3.tsv" 100 ${landmark}_mm)" "$(moved "$run/supine.vtkhdf" $landmark)" \
    "$([ -z "${CALIBRATED:-}" ] || echo 'calibrated to this row')"
  for set in "$@"; do
    [ ! -s "$run/studies/table8/$set/supine.vtkhdf" ] && printf '\t-\t' || printf '\t%s\t' "$(moved "$run/studies/table8/$set/supine.vtkhdf" $landmark)"
  done
  printf '\n'
done
tail -n +2 <<< "$table"
