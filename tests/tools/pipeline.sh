#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The make contract on a small phantom: the chain runs, a second run does nothing, touching one input
# rebuilds exactly what depends on it, and a stage can be swapped.
set -euo pipefail
cd "$(dirname "$0")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
settings=(RUNS="$work/runs" ELEMENTS=6 REDUCTION=30 AT_LEAST=20 PHANTOM_OPTIONS="--coarse 2" PRESET=small)
run() { make -f Makefile.pipeline "${settings[@]}" "$@"; }
passed=0
pass() { passed=$((passed + 1)); echo "ok: $*"; }
fail() { echo "FAILED: $*"; echo "$passed passed, 1 failed"; exit 1; }

run -j2 chain > "$work/log" 2>&1 || { tail -n 20 "$work/log"; fail "the chain runs to the curve"; }
case_dir=$work/runs/small
for file in labels geometry mesh reference supine cc mlo; do
  [ -s "$case_dir/$file.vtkhdf" ] && [ -s "$case_dir/$file.json" ] || fail "$file.vtkhdf and its report exist"
done
[ -s "$case_dir/curve.vtp" ] && [ -s "$case_dir/curve.tsv" ] || fail "the curve exists"
grep -q 'seen in CC alone' "$case_dir/page.html" || fail "and the page that says where the tumour lies"
pass "the chain runs to the curve under -j2"

run -q chain || fail "a second run does nothing"
pass "a second run does nothing"

for file in supine.vtkhdf curve.vtp cc.vti; do
  grep -q 'tabulate.* page ' <<< "$(run -n -W "$case_dir/$file" page)" || fail "the page, which repeats every stage's warnings, comes after $file"
done

touch "$case_dir/mesh.vtkhdf"
plan=$(run -n chain)
grep -q "bin/backward" <<< "$plan" || fail "a newer mesh runs backward again"
grep -qE "bin/(segment|fit-hermite|hexmesh) " <<< "$plan" && fail "a newer mesh leaves the stages before it alone"
pass "touching the mesh rebuilds what depends on it and nothing else"
run -t chain > "$work/log" 2>&1 || fail "the chain is marked as rebuilt"

plan=$(run -n FIT_OPTIONS="--elements 8x8" chain)
grep -q "bin/fit-hermite" <<< "$plan" && ! grep -q "bin/segment" <<< "$plan" || fail "changed settings of a stage run it again"
pass "changed settings of a stage run it again, and not the stages before"

built=$(stat -c %y build/built-*.mk)
run -n -W CMakeLists.txt ACCURACY=0.5 chain > "$work/log" 2>&1 || fail "a plan with changed sources"
[ "$built" = "$(stat -c %y build/built-*.mk)" ] && [ ! -e "$case_dir/accuracy.mk" ] || fail "make -n builds and solves nothing"
pass "make -n builds and solves nothing, even with changed sources or ACCURACY"

cat > "$work/my-forward" <<EOF
#!/bin/sh
echo swapped > "$work/mark"
exec "$PWD/build/release/bin/forward" "\$@"
EOF
chmod +x "$work/my-forward"
touch -d 2000-01-01 "$work/my-forward"  # older than everything: a swap must not depend on its time
run FORWARD="$work/my-forward" "$case_dir/supine.vtkhdf" > "$work/log" 2>&1 || fail "the swapped stage runs"
[ -s "$work/mark" ] || fail "FORWARD= swaps the stage"
pass "FORWARD= swaps the stage"

# A new experiment is a line of a table: a variant that converges, and one that comes from it and has no solution.
study=$work/softer.tsv
printf 'variant\tfrom\tstarts_at\tends_at\tmechanics\tmaterials\n' > "$study"
printf 'softer\t-\treference\tsupine\t+--scale fat=50\t-\n' >> "$study"
run STUDY="$study" study > "$work/log" 2>&1 || { tail -n 20 "$work/log"; fail "a study of one line"; }
rows=$case_dir/studies/softer.tsv
awk -F'\t' 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next } { row[$1, $2] = $at["status"]; moved[$1, $2] = $at["nipple_mm"] }
  END { exit !(row["softer", "reference"] == "converged" && row["softer", "supine"] == "converged" && moved["softer", "supine"] > 1) }' "$rows" ||
  { cat "$rows"; fail "a study says what became of each solve"; }
run STUDY="$study" -q "$rows" || fail "a second run of a study does nothing"
printf 'hopeless\tsofter\treference\tsupine\t-\tmira2018\n' >> "$study"
plan=$(run STUDY="$study" -n study)
! grep -q 'studies/softer/softer/' <<< "$(grep bin/ <<< "$plan" | grep -v study.sh)" || { echo "$plan"; fail "one more line solves that line alone"; }
run STUDY="$study" study > "$work/log" 2>&1 || { tail -n 20 "$work/log"; fail "a solve that ends early is no failure of a study"; }
awk -F'\t' '$1 == "hopeless" && $3 != "converged" && $4 != "" && $4 != "-" { reasons++ } END { exit reasons != 2 }' "$rows" || { cat "$rows"; fail "it is a row with its reason"; }
[ ! -e "$case_dir/studies/softer/hopeless/supine.vtkhdf" ] && run STUDY="$study" -q "$rows" || fail "and is not tried again"
plan=$(run STUDY="$study" FORWARD="$work/my-forward" -n study)
grep -q "my-forward.*studies/softer/softer/supine" <<< "$plan" || fail "a swapped stage runs a study's rows again"
pass "a new study is a line of a table, and a solve that ends early a row with its reason"

# The same image as somebody's scan: nothing is known of a tumour, and none is invented. A breast that slides is compressed as in screening.
run MR="$work/runs/phantom/small.nrrd" CASE=scan REDUCTION= AT_LEAST= -j2 summary > "$work/log" 2>&1 || { tail -n 20 "$work/log"; fail "a scan without a tumour runs to its page"; }
scan_dir=$work/runs/scan
for file in lookup.h5 page.html figures/summary.png figures/cc-mammogram.png; do
  [ -s "$scan_dir/$file" ] || fail "a scan without a tumour has $file"
done
[ ! -e "$scan_dir/curve.vtp" ] && ! grep -qi '"artificial_tumour"\|"tumour"' "$scan_dir/mesh.json" || fail "no tumour is invented for a scan"
grep -q 'No tumour in this case' "$scan_dir/summary.txt" && grep -q 'page.html' "$scan_dir/summary.txt" || fail "the summary says so"
run MR="$work/runs/phantom/small.nrrd" CASE=scan REDUCTION= AT_LEAST= -q summary || fail "a second run of it does nothing"
pass "a scan without a tumour ends with the page of all points"
run MR="$work/runs/phantom/small.nrrd" CASE=scan REDUCTION= AT_LEAST= TUMOUR=auto chain "$scan_dir/displacements.tsv" > "$work/log" 2>&1 ||
  { tail -n 20 "$work/log"; fail "TUMOUR=auto"; }
grep -q '	artificial_tumour	' "$scan_dir/curve.tsv" && grep -q 'artificial_tumour_mm' "$scan_dir/displacements.tsv" &&
  grep -q '"artificial_tumour"' "$scan_dir/supine.json" || fail "an artificial tumour is called so"
pass "TUMOUR=auto makes a tumour that is called artificial"

# The same woman on her back: her own set, the table of its landmarks and the figure, and a chain that runs with it.
second_dir=$work/runs/second
run SUPINE=phantom CASE=second TUMOUR=none "$second_dir/figures/postures.png" "$second_dir/reference.vtkhdf" > "$work/log" 2>&1 ||
  { tail -n 20 "$work/log"; fail "SUPINE= runs to the patient's own set"; }
grep -q '^identified, landmark left out	' "$second_dir/identified.txt" && grep -q 'seed2008_mm' "$second_dir/landmarks.tsv" &&
  [ "$(wc -l < "$second_dir/landmarks.tsv")" -gt 50 ] && grep -q 'identified.tsv' <(run SUPINE=phantom CASE=second -n -W "$second_dir/mesh.vtkhdf" chain) ||
  fail "SUPINE= judges the phantom's landmarks and its set runs the chain"
run SUPINE=phantom CASE=second TUMOUR=none -q "$second_dir/figures/postures.png" || fail "a second run of SUPINE= does nothing"
! run SUPINE=phantom MR="$work/runs/phantom/small.nrrd" CASE=third -n chain > "$work/log" 2>&1 && grep -q 'SUPINE: phantom' "$work/log" ||
  fail "SUPINE=phantom is refused beside a scan"
pass "SUPINE= identifies from the supine scan and the chain runs with the set"
echo "$passed passed, 0 failed"
