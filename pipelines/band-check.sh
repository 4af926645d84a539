#!/usr/bin/env bash
# The linear band against solving again: band-check.sh ROWS... (what band_check prints). One row: samples solved
# and failed, true places, how many of them the 50 and 95 % bands hold, root mean square distance across the curve
# sampled and as the band says, and the distances' 50 and 95 % quantiles over the band's half-widths.
set -euo pipefail
rows() { grep -hv '^#' "$@"; }
failed=$(grep -h '^# sample' "$@" | wc -l)
# |distance| / deviation, in order
ratios=$(rows "$@" | awk -F'\t' '{ d = $3 / $4; print d < 0 ? -d : d }' | sort -g)
quantile() { awk -v part="$1" '{ z[NR] = $1 } END { print z[int(part * NR + 0.5)] }' <<< "$ratios"; }
rows "$@" | awk -F'\t' -v failed="$failed" -v q50="$(quantile 0.5)" -v q95="$(quantile 0.95)" '
  { d = $3 < 0 ? -$3 : $3; in50 += d <= 0.6744897502 * $4; in95 += d <= 1.9599639845 * $4
    square += $3 * $3; linear += $4 * $4
    if (!($1 in seen)) { seen[$1] = 1; ++solved } }
  END {
    printf "samples\tfailed\tplaces\tin_50_percent\tin_95_percent\trms_mm\tband_rms_mm\thalf_50_ratio\thalf_95_ratio\n"
    printf "%d\t%d\t%d\t%.1f\t%.1f\t%.2f\t%.2f\t%.2f\t%.2f\n", solved, failed, NR, 100 * in50 / NR, 100 * in95 / NR,
      sqrt(square / NR), sqrt(linear / NR), q50 / 0.6744897502, q95 / 1.9599639845
  }'
