#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# One self-contained HTML page of a finished case: report.sh RUN RUNS BIN
# Pictures are inline, so that the page can be sent; report.pdf is its print.
set -euo pipefail
run=$1 runs=$2 bin=$3
here=$(dirname "$0")
. "$here/values.sh"
. "$here/html.sh"
picture() { # FILE CAPTION
  [ -s "$1" ] || return 0
  printf '<figure><img alt="%s" src="data:image/png;base64,%s"><figcaption>%s</figcaption></figure>\n' "$2" "$(base64 -w 0 "$1")" "$2"
}
dated() { date -u -r "$1" '+%Y-%m-%d %H:%M UTC'; }
section() { printf '<h2>%s</h2>\n' "$1"; }
note() { printf '<p>%s</p>\n' "$1"; }
extra() { # TITLE NOTE FILE...: tables and plots of a slow target, when it was run
  local title=$1 text=$2 file any=0
  shift 2
  for file in "$@"; do [ -s "$file" ] && any=1; done
  [ $any -eq 1 ] || return 0
  section "$title"
  note "$text"
  for file in "$@"; do
    [ -s "$file" ] || continue
    printf '<h3>%s <small>(%s)</small></h3>\n' "$(escaped "$(basename "${file%.*}")")" "$(dated "$file")"
    case "$file" in *.png) picture "$file" "$(escaped "$(basename "$file")")" ;; *) table "$file" ;; esac
  done
}

# CPU seconds of every solve behind Tables III to VI, from their reports.
solved_again() {
  cat "$run"/scaled/*-{reference,supine}.json 2> /dev/null | awk '$1 == "\"cpu_seconds\":" { total += $2 } END { printf "%.0f", total }'
}

name=$(escaped "$(basename "$run")")
tumour=$(tumour_origin "$run/mesh.json")
case "$tumour" in
  none) tumour_words= ;;
  artificial) tumour_words=" and the artificial tumour" ;;
  given) tumour_words=" and the tumour" ;;
esac
cat <<HTML
<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src data:; style-src 'unsafe-inline'">
<title>libbreast: $name</title>
<style>
body { font: 15px/1.45 sans-serif; max-width: 1150px; margin: 2em auto; padding: 0 1em; color: #222 }
table { border-collapse: collapse; margin: .8em 0; font-size: 13px } th, td { border: 1px solid #ccc; padding: 2px 7px; text-align: left; vertical-align: top }
th { background: #f2f2f2 } td.n { text-align: right; font-variant-numeric: tabular-nums } td.bad { background: #fbd5d0 }
.warnings { background: #fff4d6; border: 1px solid #d9b44a; padding: 0 1em } .bad { background: #fbd5d0; padding: .5em }
figure { margin: 1em 0 } img { max-width: 100% } figcaption { font-size: 13px; color: #555 } pre { font-size: 12px; overflow-x: auto; background: #f7f7f7; padding: .7em }
@page { size: A4 landscape; margin: 12mm }
@media print { body { max-width: none; margin: 0; font-size: 11px } table { font-size: 9px } img { max-height: 165mm } figure:first-of-type img { max-height: 140mm } h2 { break-after: avoid } figure, tr { break-inside: avoid } pre { white-space: pre-wrap } }
</style></head><body>
<h1>Breast deformation: case $name</h1>
<p>From a prone MR scan to the stress-free, supine and compressed shapes, two simulated mammograms and the CC&rarr;MLO curve,
after Pathmanathan, Gavaghan, Whiteley, Chapman and Brady, IEEE Trans Biomed Eng 55(10), 2008. Made $(date -u '+%Y-%m-%d %H:%M UTC')
with $("$bin/probe" --version 2>/dev/null | sed -n 1p), BLAS $(key "$run/reference.json" blas | escape), $(nproc) cores ($(sed -n '/^model name[^:]*: /{s///p;q}' /proc/cpuinfo | escape)).</p>
HTML
"$here/warnings.sh" "$run" | escape | awk -F'\t' '
  { text = text "<li><b>" $1 "</b>: " $2 ($3 != "-" ? "<br>&rarr; " $3 : "") "</li>\n" }
  END { if (NR) printf "<div class=warnings><h2>Warnings: %d; read these first</h2>\n<ul>\n%s</ul></div>\n", NR, text
        else print "<p>No stage warned of anything.</p>" }'
[ "$tumour" != artificial ] || printf '<p class=bad><b>The tumour of this case is artificial: nobody found it in the scan.</b> Every figure and table below follows that point.</p>\n'
picture "$run/figures/slices.png" "The scan in three planes$([ "$tumour" = none ] || echo " through${tumour_words# and}") with the contours of its segmentation: judge these before all that follows."
picture "$run/figures/summary.png" "The chain: the scan, the silhouettes of the postures, CC and MLO compression, simulated mammograms$([ "$tumour" = none ] || echo ' and the matched curve')."

# Said beside every table of the rows that the preset was fitted to.
calibrated=
[ -z "${CALIBRATED:-}" ] || calibrated=$("$here/calibration.sh" note $CALIBRATED | escape)
section "Landmarks"
table "$run/displacements.tsv"
[ -z "$calibrated" ] || note "Supine: $calibrated."
if [ -s "$run/truth.tsv" ]; then
  note "Errors against the phantom's truth, mm, the mean and the largest over all its landmarks below:"
  table <(awk -F'\t' '/^#/ { next } !n++ || $1 ~ /^(nipple|tumour|mean|largest)$/' "$run/truth.tsv")
fi
section "Compression"
printf '<table><tr><th>view<th>status<th>thickness mm<th>reduction %%<th>paddle force N<th>detector force N<th>mean pressure kPa<th>area cm2<th>Newton iterations<th>error estimate mm</tr>\n'
for view in cc mlo; do
  printf '<tr><td>%s' "${view^^}"
  for name in status thickness_mm reduction_percent force_N detector_force_N pressure_kPa area_cm2 newton_iterations error_estimate_mm; do
    value=$(key "$run/$view.json" $name)
    case "$value" in *[!-+.0-9e]*) ;; *[0-9].*) value=$(printf '%.4g' "$value") ;; esac
    printf '<td>%s' "$(escaped "${value:--}")"
  done
  printf '</tr>\n'
done
printf '</table>\n'

section "Figure 4: from data points to the mesh"
picture "$run/figures/points.png" "4a. Skin (light) and chest-wall (dark) data points."
picture "$run/figures/geometry.png" "4b. The fitted cubic-Hermite sheets and the rim where the body ends."
picture "$run/figures/mesh.png" "4c. The hexahedral mesh from the front, and its back surface (dark)."
picture "$run/figures/tissues.png" "4d. Fibroglandular tissue (violet; the surface that encloses its volume)$tumour_words through the translucent skin."
picture "$run/figures/outlines.png" "The shapes as scanned, stress-free and supine over each other; arrows from the scan to supine, lengths in space."
section "Figure 5: mammographic compression"
picture "$run/figures/cc-compression.png" "5a, b. Before and after CC compression, with the plates; orange: the border of the image on the detector."
picture "$run/figures/mlo-compression.png" "5c, d. MLO compression, two views."
picture "$run/figures/pressure.png" "Contact pressure under paddle and detector; blue: where the flat of the plate begins."
picture "$run/figures/force-thickness.png" "Force of both plates against thickness."
section "Figure 6: simulated mammograms"
picture "$run/figures/cc-mammogram.png" "6a. CC$([ "$tumour" = none ] || echo "; the yellow ring is${tumour_words# and}"). White ring: nipple."
picture "$run/figures/mlo-mammogram.png" "6b. MLO$([ "$tumour" = none ] || echo "; the computed curve, the place the model gives${tumour_words# and} (ring) and the arc of equal nipple distance")."
picture "$run/figures/cc-points.png" "6c. A selection of CC points."
picture "$run/figures/mlo-curves.png" "6d. Their curves in MLO."
[ "$tumour" = none ] || section "Figure 7: the column of the tumour's pixel"
picture "$run/figures/cc-matching.png" "7a, b. The column in the CC breast, and the same tissue stress-free."
picture "$run/figures/mlo-matching.png" "7c. The same tissue stress-free and in the MLO breast."

if [ -s "$run/tables/table2.tsv" ]; then
section "Table II: constants of law (9)"
table "$run/tables/table2.tsv"
for entry in "3:III: fat" "4:IV: fibroglandular tissue" "5:V: skin" "6:VI: one element of tumour"; do
  section "Table ${entry#*:}"
  note "Prone to supine displacements, mm, when the stiffness of this tissue is scaled; <i>rel</i>: distance from the 100 % row. The paper's figure and the difference stand beside ours; <i>estimate</i>: of the discretisation error at the landmarks.${calibrated:+ Row of 100 %: $calibrated.}"
  [ ! -s "$run/tables/table${entry%%:*}-as-printed.tsv" ] || printf '<h3>As printed in the paper: cuboid, plain invariants, skin as a layer of elements</h3>\n'
  table "$run/tables/table${entry%%:*}-as-printed.tsv"
  [ ! -s "$run/tables/table${entry%%:*}-as-printed.tsv" ] || printf '<h3>As solved here</h3>\n'
  table "$run/tables/table${entry%%:*}.tsv"
done
section "The paper's conclusions, in numbers"
note "Slopes are d ln u / d ln s between the rows of 90 and 110 %. The paper's text rounds its slope of -0.61 to &ldquo;10 % changes ... approximately 10 %&rdquo;; its own rows say 6 to 7 %."
table "$run/tables/conclusions.tsv"
fi
if [ -s "$run/tables/table7.tsv" ]; then
  section "Table VII, ours: every slope from one solve"
  note "Tangent-linear derivatives of the converged state (<i>tangent</i>) against the rows of Tables III to VI solved again (<i>resolved</i>: three-point derivative in ln s). <i>Step error</i> is what the finite steps of the solved rows cost; the two agree when they differ by no more than twice that. Cost: $(rounded 2 "$(number "$run/base-sensitivity.json" cpu_seconds)") CPU seconds for all, against $(solved_again) for the solves of the tables."
  table "$run/tables/table7.tsv"
fi
if [ -s "$run/tables/table8.tsv" ]; then
  section "Table VIII, ours: do the conclusions survive another stiffness?"
  note "The same conclusions on the same mesh, slopes from one solve each. <i>columns</i>: Table II's second-order constants taken as a11, a20, a02 instead of the printed a20, a02, a11. <i>mira2018</i>: identified in vivo, ten times softer, so that gravity matters ten times more; where the imaged shape has no stress-free body under it, no conclusion can be drawn and the reason stands there. <i>mira2018-x10</i>: the same set ten times as stiff."
  table "$run/tables/table8.tsv"
fi
if [ -s "$run/tables/findings.tsv" ]; then
  section "How much of the figures is numerical"
  note "The default with one choice at a time made as in the paper, and all of them (as printed), against the finest solution (27-node elements): plain instead of isochoric invariants, cuboid instead of dome, skin as a layer of elements instead of a membrane.${calibrated:+ Default and as printed: $calibrated.}"
  table "$run/tables/findings.tsv"
fi
extra "Leaving parts out" "Change at the landmarks and on the MLO curve against the full model, and the CPU seconds saved; then the least model that stays within the error asked for, and what it gives." "$run/leaveout/table.tsv" "$run/leaveout/recommendation.tsv"
extra "Error against run time" "Landmark error (mm) against CPU seconds." "$run"/cost/*.tsv "$run"/cost/*.png
extra "Error budget" "What is left of the errors (mm) when one stage of the chain is replaced by the phantom's truth, and that stage's CPU seconds." "$run"/budget/*.tsv "$run"/budget/*.png
extra "Stability" "Extreme cases: each converges, or stops with the reason given." "$runs"/stability/summary.tsv "$runs"/stability/mechanics.tsv "$runs"/stability/contact.tsv
extra "Independent solver" "The same scene in CalculiX." "$runs"/compare/all.tsv "$runs"/compare/pressed.tsv
if [ -s "$run/verify.tsv" ]; then
  section "Expected values"
  table "$run/verify.tsv"
fi

section "Cost"
printf '<table><tr><th>stage<th>seconds<th>peak MB</tr>\n'
for stage in labels geometry mesh reference supine cc mlo cc-mammogram mlo-mammogram curve lookup; do
  [ -s "$run/$stage.json" ] || continue
  printf '<tr><td>%s<td class=n>%s<td class=n>%s</tr>\n' "$stage" "$(rounded 2 "$(number "$run/$stage.json" total)")" \
    "$(rounded 0 "$(key "$run/$stage.json" peak_mb)")"
done
printf '</table>\n'
section "Commands"
note "Program and settings of every stage:"
printf '<pre>'
for record in "$run"/.*.settings; do
  case "$record" in *'*'*) continue ;; esac
  stage=$(basename "$record")
  stage=${stage#.}
  # Files by their names, as in the history: a page that is sent says nothing of this machine's folders.
  printf '%s: %s\n' "$(escaped "${stage%.settings}")" "$(sed 's#[^ ,=:]*/##g' "$record" | escape)"
done
printf '</pre>\n'
section "What is not reproduced, and why"
printf '<ul>\n'
escape < "$here/limits.txt" | sed 's/.*/<li>&/'
printf '</ul>\n</body></html>\n'
