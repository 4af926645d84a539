#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Table VII, ours: slopes d ln u / d ln s of all tissues at once from one tangent-linear solve, against the rows of
# Tables III to VI solved again: table7.sh BASE SCALED SLOPES TUMOUR_SLOPES
# BASE: supine report of the 100 per cent state; SCALED: folder of TISSUE-PERCENT/supine.json. resolved: three-point
# derivative in ln s through 90, 100, 110 per cent (tumour: 100, 150, 200, one-sided). step_error: what its steps cost,
# from the same formula through 50, 100, 200 (tumour: 100, 200, 500) and the orders of both. vector_difference: of the two
# derivatives of the landmark's place, per cent of its length. agrees: difference at most twice step_error plus 1e-4.
set -euo pipefail
export LC_ALL=C
base=$1 scaled=$2 slopes=$3 tumour_slopes=$4
here=$(dirname "$0")
place() { "$here/landmark.sh" "$1" "$2" "$3" | tr , ' '; }  # REPORT LANDMARK imaged|position
printf 'tissue\tlandmark\ttangent\tresolved\tdifference\tstep_error\tvector_difference_percent\tverdict\n'
for tissue in fat fibroglandular skin tumour; do
  zero=$base from=$slopes steps="90 110 50 200"
  [ $tissue != tumour ] || { zero=$scaled/tumour-100/supine.json from=$tumour_slopes steps="150 200 200 500"; }
  for landmark in tumour nipple; do
    {
      echo "$steps"
      place "$zero" $landmark imaged
      place "$zero" $landmark position
      for percent in $steps; do
        report=$scaled/$tissue-$percent/supine.json
        [ -s "${report%.json}.vtkhdf" ] && place "$report" $landmark position || echo -
      done
      awk -F'\t' -v t=$tissue -v l=$landmark '{ sub(/^artificial_/, "", $1) } $1 == l && $2 == t { print $4, $5, $6, $7 }' "$from"
    } | awk -v OFS='\t' -v tissue=$tissue -v landmark=$landmark '
      NR == 1 { for (i = 1; i <= 4; i++) s[i] = log($i / 100) }
      NR == 2 { for (d = 1; d <= 3; d++) imaged[d] = $d }
      NR == 3 { for (d = 1; d <= 3; d++) x[0, d] = $d }
      NR >= 4 && NR <= 7 { if ($1 == "-") missing = 1; for (d = 1; d <= 3; d++) x[NR - 3, d] = $d }
      NR == 8 { for (d = 1; d <= 3; d++) tangent[d] = $d; slope = $4 }
      function length_of(i,   d, q) { for (d = 1; d <= 3; d++) q += (x[i, d] - imaged[d]) ^ 2; return sqrt(q) }
      # Derivative at s = 0 of the parabola through (0, f0), (a, fa), (b, fb).
      function parabola(a, b, f0, fa, fb) { return (fa - f0) / a * b / (b - a) - (fb - f0) / b * a / (b - a) }
      function slope_of(i, j) { return parabola(s[i], s[j], log(length_of(0)), log(length_of(i)), log(length_of(j))) }
      END {
        if (NR < 8) { print tissue, landmark, "-", "-", "-", "-", "-", "not evaluated"; exit }
        if (missing) { print tissue, landmark, sprintf("%.5f", slope), "-", "-", "-", "-", "not evaluated"; exit }
        near = slope_of(1, 2); wide = slope_of(3, 4)
        ratio = s[3] * s[4] / (s[1] * s[2])      # the error of the formula goes with the product of its steps
        step = (wide - near) / (ratio - 1); if (step < 0) step = -step
        for (d = 1; d <= 3; d++) {
          v = parabola(s[1], s[2], x[0, d], x[1, d], x[2, d]); q += (v - tangent[d]) ^ 2; size += v * v }
        off = slope - near; far = off < 0 ? -off : off
        printf "%s\t%s\t%.5f\t%.5f\t%.5f\t%.5f\t%.2f\t%s\n", tissue, landmark, slope, near, off, step,
          (size > 0 ? 100 * sqrt(q / size) : 0), far <= 2 * step + 1e-4 ? "agrees" : "differs"
      }'
  done
done
