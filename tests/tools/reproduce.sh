#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What the makefile promises about its numbers, on a small phantom and a coarse mesh:
#   all     figures, tables, report and the comparison with pipelines/expected/small.tsv, in one make
#   killed  tables made in a run killed three times, and started again, are the same byte for byte
#   threads landmarks of a run on another number of threads, within a stated tolerance
#   cohort  a case that fails is named with its reason and does not stop the other
# reproduce.sh [all|killed|threads|cohort]...  (all four without arguments; `killed` and `threads` compare with `all`)
# KEEP=FOLDER keeps the runs there and continues with what it holds.
set -euo pipefail
export LC_ALL=C
cd "$(dirname "$0")/../.."
if [ -n "${KEEP:-}" ]; then
  mkdir -p "$KEEP"
  work=$(cd "$KEEP" && pwd)
else
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
fi
settings=(PRESET=small PHANTOM_OPTIONS="--coarse 2" ELEMENTS=6 REDUCTION=30 AT_LEAST=20 FINDINGS_FINEST=4)
run() { make -f Makefile.pipeline "${settings[@]}" "$@"; }
passed=0
pass() { passed=$((passed + 1)); echo "ok: $*"; }
fail() { echo "FAILED: $*"; echo "$passed passed, 1 failed"; exit 1; }
whole=$work/whole/small

check_all() {
  run RUNS="$work/whole" share='--threads 1' -j2 all > "$work/log" 2>&1 || { tail -n 30 "$work/log"; fail "make all"; }
  for file in report.html verify.tsv tables/table{2,3,4,5,6,7,8}.tsv tables/table{3,4,5,6}-as-printed.tsv \
    tables/conclusions.tsv tables/findings.tsv figures/summary.png; do
    [ -s "$whole/$file" ] || fail "make all leaves $file"
  done
  ! grep -q differs "$whole/tables/table7.tsv" || { cat "$whole/tables/table7.tsv"; fail "slopes in one solve agree with solving again"; }
  tests/tools/tables.py "$work/whole" || fail "every table loads in other programs"
  ! run RUNS="$work/whole" share='--threads 1' -n all | grep -E 'release/bin|\.sh ' || fail "a second make all does nothing"
  pass "all: every figure and table, tables load without options, expected values met, slopes agree, nothing left to do"
}

killed_files=(displacements.tsv curve.tsv tables/table3.tsv tables/table3-as-printed.tsv tables/findings.tsv)
# Starts make, waits until FILE appears and DELAY seconds more, sends SIGNAL to everything make started.
kill_at() { # SIGNAL FILE DELAY
  rm -f "$2"
  setsid make -f Makefile.pipeline "${settings[@]}" RUNS="$work/killed" share='--threads 1' -j2 \
    "${killed_files[@]/#/$work/killed/small/}" > "$work/log" 2>&1 &
  local group=$! waited=0
  while [ ! -e "$2" ]; do
    kill -0 $group 2>/dev/null || { tail -n 20 "$work/log"; fail "the run reaches $2"; }
    [ $((++waited)) -lt 12000 ] || fail "the run reaches $2 in ten minutes"
    sleep 0.05
  done
  sleep "$3"
  kill -"$1" -- -$group 2>/dev/null || fail "the run is alive at $2"
  wait $group 2>/dev/null && fail "the run ends by the signal" || true
}
check_killed() {
  local file at=$work/killed/small
  kill_at TERM "$at/geometry.vtkhdf" 0.31
  kill_at KILL "$at/studies/scaled/fat-110/reference.vtkhdf" 0.07
  kill_at KILL "$at/studies/findings/as-printed/slopes.json" 0.19
  run RUNS="$work/killed" share='--threads 1' -j2 "${killed_files[@]/#/$at/}" > "$work/log" 2>&1 ||
    { tail -n 20 "$work/log"; fail "the run finishes after three kills"; }
  for file in "${killed_files[@]}"; do
    cmp "$whole/$file" "$at/$file" || fail "$file is the same after three kills"
  done
  pass "killed: ${#killed_files[@]} tables are byte for byte those of an unbroken run"
}

# Largest distance of a landmark between two threads and one, mm.
check_threads() {
  local stage name most=0 a b
  run RUNS="$work/threads" share='--threads 2' chain > "$work/log" 2>&1 || { tail -n 20 "$work/log"; fail "the chain on two threads"; }
  for stage in reference supine cc mlo; do
    for name in nipple tumour; do
      a=$(build/release/bin/tabulate place "$whole/$stage.json" $name position --quiet) b=$(build/release/bin/tabulate place "$work/threads/small/$stage.json" $name position --quiet)
      most=$(awk -F, -v most="$most" '{ d = sqrt(($1 - $4) ^ 2 + ($2 - $5) ^ 2 + ($3 - $6) ^ 2); print (d > most ? d : most) }' <<< "$a,$b")
    done
  done
  awk -v most="$most" 'BEGIN { exit !(most <= 1e-9) }' || fail "landmarks on two threads within 1e-9 mm: $most"
  pass "threads: landmarks of all four shapes on two threads lie within $most mm (1e-9 allowed)"
}

check_cohort() {
  mkdir -p "$work/patients/second"
  printf 'PRESET = small\nELEMENTS = 4\n' > "$work/patients/first.case"
  printf 'MR = %s\nSIDE = left\n' "$work/no-such-scan.nrrd" > "$work/patients/second/case.txt"
  run COHORT="$work/patients" RUNS="$work/runs" > "$work/log" 2>&1 || { tail -n 20 "$work/log"; fail "a cohort with a failing case"; }
  local table=$work/runs/cohort-patients/cohort.tsv
  awk -F'\t' '$1 == "first" && $2 == "done" && $5 > 0 && $8 > 0 { good = 1 }
    $1 == "second" && $2 == "failed" && $NF ~ /no-such-scan/ { bad = 1 } END { exit !(good && bad) }' "$table" ||
    { cat "$table"; fail "one case done, one failed with its reason"; }
  local runs=$work/runs/cohort-patients
  tests/tools/tables.py "$runs" || fail "every table of a cohort loads in other programs"
  [ -s "$runs/first/contours.png" ] && grep -q 'data:image/jpeg' "$runs/contours.html" || fail "the contours of the segmentation"
  grep -q 'no-such-scan' "$runs/cohort.html" && grep -q '^nipple_moved_mm' "$runs/women.tsv" && ! grep -qF "$work" "$runs/cohort.html" ||
    fail "the page of the cohort"
  pass "cohort: one case done, the other failed and says why"
}

for check in ${@:-all killed threads cohort}; do "check_$check"; done
echo "$passed passed, 0 failed"
