#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The linear band against true places: band-check.sh ROWS... (what band_check and band_truth print). One row a
# file: samples solved and failed, true places, how many of them the 50 and 95 % bands hold, with the 95 % interval
# of these two figures, root mean square distance across the curve in truth and as the band says, and the distances'
# 50 and 95 % quantiles over the band's half-widths. Places of one sample err together: the interval is from the
# scatter of the samples' own figures, and of a single sample the binomial one (Wilson), as if its places were
# independent.
set -euo pipefail
export LC_ALL=C
printf "rows\tsamples\tfailed\tplaces\tin_50_percent\tin_50_from\tin_50_to\tin_95_percent\tin_95_from\tin_95_to\trms_mm\tband_rms_mm\thalf_50_ratio\thalf_95_ratio\n"
for file in "$@"; do
  rows() { awk '!/^#/' "$file"; }
  # |distance| / deviation, in order
  ratios=$(rows | awk -F'\t' '{ d = $3 / $4; print d < 0 ? -d : d }' | sort -g)
  quantile() { awk -v part="$1" '{ z[NR] = $1 } END { print z[int(part * NR + 0.5)] }' <<< "$ratios"; }
  rows | awk -F'\t' -v name="$(basename "${file%.tsv}")" -v failed="$(awk '/^# sample/' "$file" | wc -l)" \
    -v q50="$(quantile 0.5)" -v q95="$(quantile 0.95)" '
    function bounds(total, part,    p, k, mean, scatter, half, z) {  # per cent; part: held places by sample
      z = 1.96
      p = total / NR
      if (solved == 1) {
        half = z * sqrt(p * (1 - p) / NR + z * z / (4 * NR * NR)) / (1 + z * z / NR)
        mean = (p + z * z / (2 * NR)) / (1 + z * z / NR)
      } else {
        for (k in places) scatter += (part[k] - p * places[k]) ^ 2
        half = z * sqrt(scatter * solved / (solved - 1)) / NR
        mean = p
      }
      low = mean > half ? 100 * (mean - half) : 0
      high = mean + half < 1 ? 100 * (mean + half) : 100
      return sprintf("%.1f\t%.1f\t%.1f", 100 * p, low, high)
    }
    { d = $3 < 0 ? -$3 : $3
      if (!($1 in places)) ++solved
      ++places[$1]
      narrow = d <= 0.6744897502 * $4; wide = d <= 1.9599639845 * $4
      in50 += narrow; in95 += wide; by50[$1] += narrow; by95[$1] += wide
      square += $3 * $3; linear += $4 * $4 }
    END {
      first = bounds(in50, by50)
      printf "%s\t%d\t%d\t%d\t%s\t%s\t%.2f\t%.2f\t%.2f\t%.2f\n", name, solved, failed, NR, first, bounds(in95, by95),
        sqrt(square / NR), sqrt(linear / NR), q50 / 0.6744897502, q95 / 1.9599639845
    }'
done
