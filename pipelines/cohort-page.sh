#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Pages of a cohort to look through and to send: cohort-page.sh cohort|contours RUNS, HTML on stdout.
#   cohort    failures first, with reason and log; distributions beside living women's values; then a row and a picture a case
#   contours  the contours of every segmentation, those that ask for a look first
# Pictures are inline and small (netpbm: Debian's package of that name); without it the pages have none, and say so.
set -euo pipefail
page=$1 runs=$2
here=$(dirname "$0")
. "$here/values.sh"
. "$here/html.sh"
all=$runs/cohort.tsv
thumbnail() { # PNG WIDTH TEXT
  [ -s "$1" ] && command -v pnmtojpeg > /dev/null || return 0
  printf '<img loading="lazy" alt="%s" src="data:image/jpeg;base64,%s">' "$(escaped "$3")" \
    "$(pngtopnm "$1" 2> /dev/null | pamscale -xsize "$2" 2> /dev/null | pnmtojpeg -quality 70 2> /dev/null | base64 -w 0)"
}
# Three axial and two sagittal slices out of the sixteen that segment draws, four a row of 500 x 360 pixels with the breast in the
# middle; pixel by pixel, because a contour is one pixel wide.
slices() { # PNG
  local whole at
  [ -s "$1" ] && command -v pnmtojpeg > /dev/null || return 0
  whole=$(mktemp -d)
  pngtopnm "$1" > "$whole/all" 2> /dev/null
  for at in 0,1 0,3 1,1 2,1 2,2; do  # row, column
    pamcut -left $((500 * ${at#*,} + 80)) -top $((360 * ${at%,*} + 40)) -width 340 -height 280 "$whole/all" > "$whole/$at" 2> /dev/null ||
      rm -f "$whole/$at"  # a picture of another program's
  done
  [ ! -s "$whole/2,2" ] || pnmcat -lr "$whole"/?,? 2> /dev/null | pnmtojpeg -quality 70 -sample=1x1 2> /dev/null | base64 -w 0
  rm -rf "$whole"
}
rows() { awk -F'\t' 'NR > 1' "$all"; }
count() { rows | awk -F'\t' "$1"' { n++ } END { print n + 0 }'; }
# Cases as CASE, STATUS, LOOK, REASON: failed first, then those that ask for a look, then the rest.
ordered() {
  rows | awk -F'\t' -v OFS='\t' '{ print ($2 != "done" ? 0 : $12 != "-" ? 1 : 2), $1, $2, $12, $14 }' | sort -s -n -k1,1 | cut -f2-
}
# A column's numbers as a row: how many, mean, standard deviation, range, women's mean and deviation (a grey band), a dot a case.
distribution() { # FILE COLUMN
  awk -F'\t' -v column="$2" '!/^#/ && !at { for (i = 1; i <= NF; i++) if ($i == column) at = i; next } at && $at == $at + 0 { print $at }' "$1" |
    sort -g | awk -v name="$2" -v women="$(awk -F'\t' -v q="$2" '$1 == q { print $2, $3 }' "$here/invivo/women.tsv")" '
    { v[++n] = $1; sum += $1 }
    END { if (!n) exit; mean = sum / n; for (i = 1; i <= n; i++) square += (v[i] - mean) ^ 2; sd = n > 1 && square > 1e-18 ? sqrt(square / (n - 1)) : 0
      low = v[1]; high = v[n]
      if (split(women, w, " ")) { if (w[1] - 2 * w[2] < low) low = w[1] - 2 * w[2]; if (w[1] + 2 * w[2] > high) high = w[1] + 2 * w[2] }
      scale = high > low ? 100 / (high - low) : 0
      printf "<tr><td>%s<td class=n>%d<td class=n>%.4g<td class=n>%.3g<td class=n>%.4g<td class=n>%.4g<td>%s<td><div class=strip>", name, n, mean, sd, v[1], v[n], (w[1] == "" ? "-" : w[1] " (" w[2] ")")
      if (w[1] != "") printf "<b style=\"left:%.1f%%;width:%.1f%%\"></b>", (w[1] - w[2] - low) * scale, 2 * w[2] * scale
      for (i = 1; i <= n; i++) printf "<i style=\"left:%.1f%%\"></i>", (v[i] - low) * scale
      print "</div></tr>" }'
}
head_of() { # TITLE
  cat <<HTML
<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src data:; style-src 'unsafe-inline'">
<title>$1</title>
<style>
body { font: 15px/1.4 sans-serif; margin: 1.5em; color: #222 } table { border-collapse: collapse; margin: .8em 0; font-size: 13px }
th, td { border: 1px solid #ccc; padding: 2px 7px; text-align: left; vertical-align: top } th { background: #f2f2f2 }
td.n { text-align: right; font-variant-numeric: tabular-nums } td.bad, figure.bad figcaption { background: #fbd5d0 }
.look { background: #fff4d6 } img { max-width: 100%; display: block } td img { width: 240px }
.strip { position: relative; width: 260px; height: 16px } .strip b { position: absolute; height: 16px; background: #ddd }
.strip i { position: absolute; top: 3px; width: 3px; height: 10px; margin-left: -1px; background: #246 }
figure { margin: 0 0 10px; break-inside: avoid }
figcaption { font-size: 13px; padding: 1px 4px }
</style></head><body>
<h1>$1</h1>
HTML
  command -v pnmtojpeg > /dev/null || echo '<p class=look>No pictures: netpbm is not installed where this page was made (apt-get install netpbm).</p>'
}
name=$(escaped "$(basename "$runs")")
counted="$(count 1) cases: $(count '$2 == "done"') done, $(count '$2 != "done"') failed, $(count '$2 == "done" && $12 != "-"') ask for a look."

if [ "$page" = contours ]; then
  head_of "Segmentations of $name"
  echo "<p>$counted Contours of the chest wall (green, orange where it is uncertain), the breast (yellow) and its fibroglandular tissue (red) in three axial and two sagittal slices of every scan, 0.7 mm a pixel; those that failed or ask for a look first. A click opens all sixteen slices. A chest wall in the ribs or in the breast, a breast cut off at its side, or fibroglandular tissue in the coil's glare wants a correction (CHEST_WALL=).</p>"
  ordered | while IFS=$'\t' read -r case status look reason; do
    class=
    [ "$look" = - ] || class=look
    [ "$status" = done ] || class=bad
    picture=$(slices "$runs/$case/contours.png")
    [ -z "$picture" ] || picture="<a href=\"$(escaped "$case")/contours.png\"><img alt=\"contours of $(escaped "$case")\" src=\"data:image/jpeg;base64,$picture\"></a>"
    [ "$look" = - ] && look=
    printf '<figure class="%s"><figcaption class="%s"><b>%s</b> %s</figcaption>%s</figure>\n' "$class" "$class" "$(escaped "$case")" \
      "$(escaped "$([ "$status" = done ] && echo "$look" || echo "failed: $reason")")" "${picture:-<p>no contours</p>}"
  done
  echo '</body></html>'
  exit 0
fi

head_of "$name"
echo "<p>$counted <a href=\"contours.html\">Contours of all segmentations</a>; tables: cohort.tsv, motion.tsv, women.tsv, cost.tsv.</p>"
if [ "$(count '$2 != "done"')" -gt 0 ]; then
  echo '<h2>Failed</h2><table><tr><th>case<th>reason<th>log<th>contours</tr>'
  rows | awk -F'\t' -v OFS='\t' '$2 != "done" { print $1, $13, $14 }' | while IFS=$'\t' read -r case log reason; do
    printf '<tr><td>%s<td class=bad>%s<td><a href="%s">%s</a><td>%s</tr>\n' "$(escaped "$case")" "$(escaped "$reason")" "$(escaped "$log")" \
      "$(escaped "$log")" "$(thumbnail "$runs/$case/contours.png" 240 "contours of $case")"
  done
  echo '</table>'
fi
echo '<h2>Distributions</h2><p>A dot a case; grey: mean and one standard deviation of living women (63 volunteers, prone to supine) where it is known.</p>'
echo '<table><tr><th>quantity<th>cases<th>mean<th>sd<th>lowest<th>highest<th>women: mean (sd)<th></tr>'
for column in volume_ml min_scaled_jacobian supine_nipple_mm supine_tumour_mm cc_thickness_mm cc_force_N mlo_thickness_mm mlo_force_N; do
  distribution "$all" $column
done
if [ -s "$runs/motion.tsv" ]; then
  for column in $(sed -n '/^#/!{p;q}' "$runs/motion.tsv" | cut -f3-); do distribution "$runs/motion.tsv" "$column"; done
fi
echo '</table>'
if [ "$(count '$2 == "done"')" -gt 0 ]; then
  echo '<h2>Done</h2><table><tr><th>case<th>look at<th>volume ml<th>supine nipple mm<th>CC mm, N<th>MLO mm, N<th>picture</tr>'
  ordered | awk -F'\t' '$2 == "done" { print $1 "\t" $3 }' | while IFS=$'\t' read -r case look; do
    class=look
    [ "$look" != - ] || class=
    value() { escaped "$(cell "$all" "$case" "$1")"; }  # COLUMN
    printf '<tr><td>%s<td class="%s">%s<td class=n>%s<td class=n>%s<td class=n>%s, %s<td class=n>%s, %s<td>%s</tr>\n' "$(escaped "$case")" "$class" \
      "$(escaped "$look" | sed 's/; /<br>/g')" "$(value volume_ml)" "$(value supine_nipple_mm)" "$(value cc_thickness_mm)" "$(value cc_force_N)" \
      "$(value mlo_thickness_mm)" "$(value mlo_force_N)" "$(thumbnail "$runs/$case/figures/summary.png" 480 "the chain of $case")"
  done
  echo '</table>'
fi
echo '<h2>Cost</h2>'
table "$runs/cost.tsv"
echo '</body></html>'
