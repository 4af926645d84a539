#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Prints what a finished case says: first what its stages warned of, each warning once, with what to do; then landmark
# displacements, errors against the truth when there is one, compressions, the MLO curve, and where the pictures are.
set -euo pipefail
run=$1
truth_report=${2:-}  # of the phantom, for the truth's own error
. "$(dirname "$0")/values.sh"
of() { rounded "$3" "$(key "$run/$1.json" "$2")"; }  # STAGE NAME DIGITS
# Tab-separated text as aligned columns.
columns() {
  awk -F'\t' '!/^#/ { n++; for (i = 1; i <= NF; i++) { cell[n, i] = $i; if (length($i) > w[i]) w[i] = length($i) }
                    fields[n] = NF }
    END { for (r = 1; r <= n; r++) { line = "";
            for (i = 1; i <= fields[r]; i++) line = line sprintf("  %-" w[i] "s", cell[r, i]);
            sub(/ +$/, "", line); print line } }' "$1"
}

echo "== $run"
echo
"$(dirname "$0")/warnings.sh" "$run" | awk -F'\t' '
  { text = text "  " $1 ": " $2 "\n"; if ($3 != "-") text = text "    -> " $3 "\n" }
  END { if (NR) printf "Warnings: %d; read these first\n%s", NR, text; else print "No stage warned of anything." }'
echo
case "$(tumour_origin "$run/mesh.json")" in
  none) echo "No tumour in this case (TUMOUR=x,y,z follows one)." ;;
  artificial) echo "THE TUMOUR IS ARTIFICIAL: nobody found it in the scan." ;;
  given) echo "Tumour: $(key "$run/mesh.json" tumour)." ;;
esac
echo
echo "Landmark displacements (mm)"
columns "$run/displacements.tsv"
[ -z "${CALIBRATED:-}" ] || "$(dirname "$0")/calibration.sh" note $CALIBRATED | fold -s -w 118 | sed '1s/^/  supine: /; 2,$s/^/  /'
echo
echo "With the lateral cut held instead, supine (relative: distance to the case as solved, mm)"
columns "$run/cut.tsv"
if [ -s "$run/truth.tsv" ]; then
  bound=$(key "$truth_report" error_estimate_mm) || true
  echo
  echo "Error against the phantom's truth (mm). The truth's own error is $(rounded 3 "$bound") mm; smaller errors are not"
  echo "claimed. Points are the phantom's, found in the chain's mesh."
  columns "$run/truth.tsv"
fi
if [ -s "$run/truth-cut-fixed.tsv" ]; then
  echo
  echo "The same with the cut held in the chain, as it is in the truth (mean and largest)"
  sed -n '1p;/^mean/p;/^largest/p' "$run/truth-cut-fixed.tsv" > "$run/.truth-cut-fixed.part"
  columns "$run/.truth-cut-fixed.part"
  rm -f "$run/.truth-cut-fixed.part"
fi
echo
echo "Compression"
for view in cc mlo; do
  printf '  %-3s thickness %s mm, reduction %s %%, paddle %s N, detector %s N, mean pressure %s kPa, status %s\n' "${view^^}" \
    "$(of $view thickness_mm 1)" "$(of $view reduction_percent 1)" "$(of $view force_N 1)" \
    "$(of $view detector_force_N 1)" "$(of $view pressure_kPa 1)" "$(key "$run/$view.json" status)"
done
cc_line=$(number "$run/cc.json" nipple_in_front_mm) mlo_line=$(number "$run/mlo.json" nipple_in_front_mm)
if [ -n "$cc_line" ] && [ -n "$mlo_line" ]; then
  awk -v cc="$cc_line" -v mlo="$mlo_line" 'BEGIN { printf "  nipple line: CC %.0f mm, MLO %.0f mm to the image edge; they differ by %.0f mm (clinics accept 10)\n",
    cc, mlo, (cc > mlo) ? cc - mlo : mlo - cc }'
fi
echo
if [ -s "$run/curve.tsv" ]; then
  echo "CC point to MLO curve: $run/curve.tsv, in ParaView $run/curve.vtp"
else
  echo "Every CC point and its MLO curve: $run/page.html (a browser opens it), numbers in $run/lookup.h5"
fi
echo "Pictures: $run/figures/"
first=
for picture in "$run"/figures/slices.png "$run"/figures/*.png; do
  [ -s "$picture" ] && [ "$picture" != "$first" ] || continue  # the scan's slices come first, once
  first=${first:-$picture}
  echo "  $picture"
done
