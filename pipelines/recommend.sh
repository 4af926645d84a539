#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The least model that stays within an error, for surgery (supine places of tumour and nipple) and matching (largest
# distance on the MLO curve of the tumour):
#   recommend.sh choose TABLE QUESTION MM PART...   the parts to leave out: smallest change first, while the changes of
#                                                   leaveout's TABLE add up to no more than MM
#   recommend.sh table RUN PROBE MM PART...         those parts, the sum, and what RUN/studies/leaveout/least-QUESTION really gives
# Changes need not add up: the last column says whether the model without all of them keeps the error.
set -euo pipefail
here=$(dirname "$0")
. "$here/values.sh"
# LINE of a part: change mm, part
changes() { # TABLE QUESTION PART...
  local table=$1 question=$2 part
  shift 2
  for part in "$@"; do
    if [ "$question" = surgery ]; then
      [ "$part" = no-gravity-in-compression ] && continue
      awk -v a="$(cell "$table" "$part" supine_tumour_mm)" -v b="$(cell "$table" "$part" supine_nipple_mm)" -v part="$part" \
        'BEGIN { print (a > b ? a : b), part }'
    else
      echo "$(cell "$table" "$part" curve_max_mm) $part"
    fi
  done | sort -g
}
choose() { # TABLE QUESTION MM PART...
  local table=$1 question=$2 allowed=$3
  shift 3
  changes "$table" "$question" "$@" | awk -v allowed="$allowed" '{ sum += $1; if (sum <= allowed) { printf "%s%s", between, $2; between = " " } }'
}
if [ "$1" = choose ]; then
  shift
  choose "$@"
  exit
fi
run=$2 probe=$3 allowed=$4
shift 4
table=$run/leaveout/table.tsv
cost=$(mktemp)
trap 'rm -f "$cost"' EXIT
printf 'question\tallowed_mm\tleft_out\tsum_of_changes_mm\tmeasured_mm\tcpu_s\tbase_cpu_s\tsaved_percent\tkeeps_the_error\n'
for question in surgery matching; do
  parts=$(choose "$table" $question "$allowed" "$@")
  sum=$(changes "$table" $question "$@" | awk -v parts=" $parts " 'index(parts, " " $2 " ") { s += $1 } END { printf "%.3f", s }')
  "$here/leaveout.sh" "$run" "$probe" least-$question > "$cost"
  if [ $question = surgery ]; then
    measured=$(awk -v a="$(cell "$cost" least-surgery supine_tumour_mm)" -v b="$(cell "$cost" least-surgery supine_nipple_mm)" 'BEGIN { print (a > b ? a : b) }')
  else
    measured=$(cell "$cost" least-matching curve_max_mm)
  fi
  awk -v OFS='\t' -v q=$question -v allowed="$allowed" -v parts="${parts:-nothing}" -v sum="$sum" -v m="$measured" \
    -v own="$(cell "$cost" least-$question ${question}_cpu_s)" -v base="$(cell "$cost" base ${question}_cpu_s)" \
    'BEGIN { print q, allowed, parts, sum, m, own, base, sprintf("%.0f", base > 0 ? 100 * (1 - own / base) : 0), m + 0 <= allowed + 0 ? "yes" : "no" }'
done
