#!/usr/bin/env bash
# The paper's conclusions, in numbers, from Tables III to VI: conclusions.sh TABLES
# Slopes d ln u / d ln s are those of the rows 90 and 110 per cent. The paper's text rounds its -0.61 to
# "10 % stiffness, about 10 % displacement"; its own rows say 6 to 7 %.
set -euo pipefail
tables=$1
. "$(dirname "$0")/values.sh"
of() { cell "$tables/table$1.tsv" "$2" "$3"; }  # TABLE PERCENT COLUMN
slope() {
  awk -v low="$(of "$1" 90 "$2")" -v high="$(of "$1" 110 "$2")" \
    'BEGIN { if (low > 0 && high > 0) printf "%.4f", log(high / low) / log(110 / 90); else print "-" }'
}
# change TABLE PERCENT COLUMN: relative to the 100 per cent row, per cent
change() {
  awk -v a="$(of "$1" "$2" "$3")" -v b="$(of "$1" 100 "$3")" \
    'BEGIN { if (a == "-" || !(b > 0)) print "-"; else printf "%.3f", 100 * (a / b - 1) }'
}
# judge NAME OURS PAPER LOWEST HIGHEST
judge() {
  awk -v OFS='\t' -v name="$1" -v ours="$2" -v paper="$3" -v low="$4" -v high="$5" 'BEGIN {
    verdict = (ours == "-") ? "not evaluated" : (ours + 0 >= low + 0 && ours + 0 <= high + 0) ? "holds" : "fails"
    print name, ours, paper, low, high, verdict }'
}
printf 'conclusion\tours\tpaper\tlowest\thighest\tverdict\n'
judge "slope of nipple displacement, fat" "$(slope 3 nipple_mm)" "$(slope 3 paper_nipple_mm)" -0.71 -0.51
judge "slope of tumour displacement, fat" "$(slope 3 tumour_mm)" "$(slope 3 paper_tumour_mm)" -0.81 -0.61
judge "slope of nipple displacement, fibroglandular" "$(slope 4 nipple_mm)" "$(slope 4 paper_nipple_mm)" -0.15 0.15
judge "slope of tumour displacement, fibroglandular" "$(slope 4 tumour_mm)" "$(slope 4 paper_tumour_mm)" -0.15 0.15
judge "slope of nipple displacement, skin" "$(slope 5 nipple_mm)" "$(slope 5 paper_nipple_mm)" -0.05 0.05
judge "slope of tumour displacement, skin" "$(slope 5 tumour_mm)" "$(slope 5 paper_tumour_mm)" -0.05 0.05
judge "tumour 10 times as stiff: tumour displacement, % change" "$(change 6 1000 tumour_mm)" "$(change 6 1000 paper_tumour_mm)" -5 5
judge "tumour 20 times as stiff: nipple displacement, % change" "$(change 6 2000 nipple_mm)" "$(change 6 2000 paper_nipple_mm)" -1 1
for landmark in nipple tumour; do
  order() { awk -v f="$(slope 3 "$1${landmark}_mm")" -v g="$(slope 4 "$1${landmark}_mm")" -v s="$(slope 5 "$1${landmark}_mm")" \
    'function a(x) { return x < 0 ? -x : x } BEGIN { if (f == "-" || g == "-" || s == "-") print "-"; else print (a(f) > 3 * a(g) && a(g) > a(s)) ? 1 : 0 }'; }
  judge "$landmark: fat more than 3 times fibroglandular, that more than skin (1: yes)" "$(order "")" "$(order paper_)" 1 1
done
