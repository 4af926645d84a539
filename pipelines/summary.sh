#!/usr/bin/env bash
# Prints what a finished case says: landmark displacements, errors against the truth when there is one,
# compressions, the MLO curve, and where the pictures are.
set -euo pipefail
run=$1
truth_report=${2:-}  # of the phantom, for the truth's own error
# A top-level key of a JSON report (two spaces of indent), or "-".
key() {
  local value
  value=$(sed -n "s/^  \"$2\": \"\{0,1\}\([^\",]*\)\"\{0,1\},\{0,1\}$/\1/p" "$run/$1.json" | head -n 1)
  echo "${value:--}"
}
# Tab-separated text as aligned columns.
columns() {
  awk -F'\t' '!/^#/ { n++; for (i = 1; i <= NF; i++) { cell[n, i] = $i; if (length($i) > w[i]) w[i] = length($i) }
                    fields[n] = NF }
    END { for (r = 1; r <= n; r++) { line = "";
            for (i = 1; i <= fields[r]; i++) line = line sprintf("  %-" w[i] "s", cell[r, i]);
            sub(/ +$/, "", line); print line } }' "$1"
}
fixed() { [ "$1" = "-" ] && echo "-" || printf "%.${2}f" "$1"; }

echo "== $run"
echo
echo "Landmark displacements (mm)"
columns "$run/displacements.tsv"
echo
echo "Held instead of free lateral cut, supine (relative: distance to the free one, mm)"
columns "$run/cut.tsv"
if [ -s "$run/truth.tsv" ]; then
  bound=$(sed -n 's/^  "error_estimate_mm": \([0-9.e-]*\),\{0,1\}$/\1/p' "$truth_report" 2>/dev/null || true)
  echo
  echo "Error against the phantom's truth (mm). The truth's own error is $(fixed "${bound:--}" 3) mm; smaller errors are not"
  echo "claimed. The truth holds the lateral cut; points are the phantom's, found in the chain's mesh."
  columns "$run/truth.tsv"
  echo
  echo "The same with the cut held in the chain too (mean and largest)"
  sed -n '1p;/^mean/p;/^largest/p' "$run/truth-cut-fixed.tsv" > "$run/.truth-cut-fixed.part"
  columns "$run/.truth-cut-fixed.part"
  rm -f "$run/.truth-cut-fixed.part"
fi
echo
echo "Compression"
for view in cc mlo; do
  printf '  %-3s thickness %s mm, reduction %s %%, force %s N, mean pressure %s kPa, status %s\n' "${view^^}" \
    "$(fixed "$(key $view thickness_mm)" 1)" "$(fixed "$(key $view reduction_percent)" 1)" \
    "$(fixed "$(key $view force_N)" 1)" "$(fixed "$(key $view pressure_kPa)" 1)" "$(key $view status)"
done
echo
echo "CC point to MLO curve: $run/curve.tsv, in ParaView $run/curve.vtp"
echo "Pictures: $run/figures/"
for picture in "$run"/figures/*.png; do echo "  $picture"; done
