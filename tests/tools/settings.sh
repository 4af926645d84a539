#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What the makefile refuses before anything runs: unknown settings and values, names that a shell or make would read as code,
# case files with a slip, another patient's scan in a run's folder: plans (make -n). Then what tabulate says and draws of runs whose
# names and texts are hostile. settings.sh [BIN]
set -euo pipefail
bin=$(realpath "${1:-$(dirname "$0")/../../build/release/bin}")
unset MAKEFLAGS MFLAGS MAKEOVERRIDES MAKELEVEL  # of a make that runs the tests
cd "$(dirname "$0")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
tabulate() { "$bin/tabulate" "$@" --quiet; }
passed=0
pass() { passed=$((passed + 1)); echo "ok: $*"; }
fail() { echo "FAILED: $*"; echo "$passed passed, 1 failed"; exit 1; }
plan() { make -f Makefile.pipeline -n RUNS="$work/runs" "$@" > "$work/out" 2> "$work/err"; }
# Refused with a message that holds all of these texts, in one line of make.
refused() { # WHAT TEXT... -- ARGUMENT...
  local what=$1 texts=() text
  shift
  while [ "$1" != -- ]; do texts+=("$1"); shift; done
  shift
  ! plan "$@" || fail "$what is refused"
  [ "$(grep -c '\*\*\*' "$work/err")" -eq 1 ] || { cat "$work/err"; fail "$what is refused in one line"; }
  for text in "${texts[@]}"; do grep -qF -- "$text" "$work/err" || { cat "$work/err"; fail "$what: says '$text'"; }; done
}

refused "an unknown setting" SIDES "did you mean SIDE?" -- SIDES=right
refused "an unknown part to leave out" no-skn "did you mean no-skin?" -- LEAVE_OUT=no-skn
refused "an unknown side" "did you mean left?" -- SIDE=lefft
refused "an unknown material set" "did you mean seed2008?" -- MATERIALS=seed2080
refused "a reduction that is no number" REDUCTION -- REDUCTION=half
refused "a reduction of no compression" "REDUCTION: 500 must be from 1 to 95" -- REDUCTION=500
refused "half a place" "TUMOUR 1,2" "x,y,z[:radius]" -- MR=/dev/null TUMOUR=1,2
refused "a scan whose name was lost" "MR: is empty" -- MR=
refused "a case file whose name was lost" "CASE_FILE: is empty" -- CASE_FILE=
refused "a scan with a line break in its name" "MR: a line break may not stand in it" -- MR=$'a\nb.nrrd' SIDE=left
plan fuzz MINUTES=1 && plan release-check FUZZ_MINUTES=1 FUZZ_INPUTS=1 FAULT_ALLOCATIONS=1 || { cat "$work/err"; fail "settings of fuzz are known"; }
pass "unknown settings and values are refused by name, with a suggestion"

# The help lists every setting, and every target that the table describes.
make -f Makefile.pipeline help > "$work/out"
for name in $(awk -F '\t' '/^#/ || $1 ~ /^(goal|setting)$/ || $NF == "-" { next } FILENAME ~ /settings/ { print $1 "=" } FILENAME !~ /settings/ { print $1 }' \
  pipelines/settings.tsv pipelines/goals.tsv); do
  case $name in *=) end= ;; *) end='( |$)' ;; esac
  grep -qE "^  $name$end" "$work/out" || fail "help lists $name"
done
grep -q '^  ELEMENTS=.*(default: 16)' "$work/out" && grep -q '^  SEGMENT=.*(default: segment)' "$work/out" || fail "help has plain defaults"
pass "the help lists targets and settings"

# Defaults, which depend on the case, are those of settings, once each.
defaults=$(grep -oh '^[A-Z][A-Z0-9_]* ?=' pipelines/settings.mk pipelines/build.mk tests/*.mk tests/*/*.mk | cut -d' ' -f1 | sort)
[ "$(wc -w <<< "$defaults")" -gt 40 ] && [ -z "$(uniq -d <<< "$defaults")" ] && [ -z "$(comm -23 <(echo "$defaults") <(cut -f 1 pipelines/settings.tsv | sort))" ] ||
  fail "settings.mk has no default twice and none of what is no setting"
has() { # VALUES SETTING... -- ARGUMENT...
  local values=$1 names=()
  shift
  while [ "$1" != -- ]; do names+=("$1"); shift; done
  shift
  plan --eval="print: ; \$(info $(printf '$(%s)|' "${names[@]}"))" "$@" print || { cat "$work/err"; fail "$*: settings"; }
  grep -qxFe "$values" "$work/out" || { grep "|$" "$work/out"; fail "$*: ${names[*]} are $values"; }
}
model=(RUN MATERIALS REDUCTION MUSCLE SURROUNDINGS AT_LEAST)
has "$work/runs/average|invivo||measured|16||" "${model[@]}" --
has "$work/runs/paper|seed2008|50|0|0|40|" "${model[@]}" -- PRESET=paper
has "$work/runs/paper-as-printed|seed2008|50|||30|" "${model[@]}" -- PAPER=1
has "$work/runs/average|seed2008|50|0|0|40|" "${model[@]}" -- MATERIALS=seed2008
has "$work/runs/x-left|invivo-borders||measured|16||" "${model[@]}" -- MR=/no/x.nii.gz
has "--force 80 --thickness 40|" STOPS -- FORCE=80 THICKNESS=40 PRESET=paper
has "paper|left|$work/runs/paper|" PRESET SIDE RUN -- tables
has "$work/runs/1.2.840-right|none|no|" RUN TUMOUR PAGE_SCAN -- MR=1.2.840/ SIDE=right
has "$work/runs/average/identified.tsv|invivo|" MATERIALS prior_set -- SUPINE=phantom
has "$work/runs/average/fat-only.tsv|pipelines/materials/invivo.tsv|--gravity 0,0,0|" MATERIALS whole_set PRONE -- LEAVE_OUT="no-gland no-backward"
has "--x --skin 0|yes|" HEXMESH_OPTIONS slides_as_expected -- HEXMESH_OPTIONS=--x LEAVE_OUT=no-skin --eval='slides_as_expected = $(if $(slides),yes)'
pass "defaults follow from the case"

# What a setting accepts is what the program accepts to which it is given.
while read -r setting tool option; do
  range=$(awk -F '\t' -v setting="$setting" '$1 == setting { split($4, word, " "); print word[2], "to", word[3] }' pipelines/settings.tsv)
  grep -q -- "^| .$option [A-Z]*. | .*($range[;)]" "docs/tools/$tool.md" || fail "$setting: $range is the range of $tool $option"
done <<'ranges'
FORCE compress --force
THICKNESS compress --thickness
REDUCTION compress --reduction
PRESSURE compress --pressure
AT_LEAST compress --at-least
ELEMENTS hexmesh --elements
STATES forward --states
SERIES segment --series
ranges
# The phantom says which of its bodies slide, and make plans for them.
sliding=$(sed -n 's/^body_slides := $(filter \(.*\),.*/\1/p' pipelines/settings.mk | sed 's/ /, /g; s/, \([a-z]*\)$/ and \1/')
"$bin/phantom" --help-all | tr -s ' \n' ' ' | grep -q "Breasts of the presets $sliding are" || fail "the presets $sliding slide"
pass "the bounds of settings are those of the programs"

mkdir -p "$work/runs/paper"
touch "$work/runs/keep"
for case in '' . .. a/b; do
  ! make -f Makefile.pipeline RUNS="$work/runs" CASE="$case" clean > "$work/out" 2>&1 || fail "CASE='$case' clean is refused"
done
! make -f Makefile.pipeline RUNS="$work/runs" RUN="$work/runs/" clean > "$work/out" 2>&1 || fail "clean keeps to the runs' folders"
[ -e "$work/runs/keep" ] || fail "CASE= clean removes no runs"
! make -f Makefile.pipeline RUNS="$work/runs" RUN="$work/runs/paper" clean > "$work/out" 2>&1 || fail "clean of a folder that is no run is refused"
grep -q "holds no run" "$work/out" && [ -d "$work/runs/paper" ] || fail "clean removes runs only"
touch "$work/runs/paper/.scan"
make -f Makefile.pipeline RUNS="$work/runs" RUN="$work/runs/paper" clean > "$work/out" 2>&1 && [ ! -e "$work/runs/paper" ] || fail "clean removes a run"
mkdir "$work/runs/paper"
pass "CASE must be a plain name: clean cannot remove all runs, nor a folder that is none"

# Nothing of a name is executed, neither by make nor by a shell.
bait=$work/executed
refuse_name() { # SETTING NAME
  ! make -f Makefile.pipeline -n "$1=$2" chain > "$work/out" 2>&1 || fail "$1=$2 is refused"
  grep -q '\*\*\*' "$work/out" || { cat "$work/out"; fail "$1=$2 is refused by make's line"; }
}
worst=('b`touch$${IFS}'"$bait"'`.nrrd' '$(shell touch '"$bait"')' "a;touch $bait" "a b'c\"\$(x);é(=).nrrd")
for name in "${worst[@]}" "a b.nrrd" "a'b.nrrd" 'a"b.nrrd' 'a(b).nrrd' 'a=b.nrrd' 'a:b.nrrd' 'a%b.nrrd' '-x.nrrd' '${IFS}' 'a|b' 'a&b' \
  'a>b' 'a*b' 'a[b]' 'a#b' 'a\b'; do
  refuse_name MR "$name"
done
for setting in CHEST_WALL CASE MATERIALS TUMOUR RUNS COHORT CASE_FILE STUDY; do
  for name in "${worst[@]}"; do refuse_name "$setting" "$name"; done
done
all_settings=$(grep -o '^[A-Z0-9_]*' pipelines/settings.tsv | grep . | grep -vx RUN)
[ "$(wc -w <<< "$all_settings")" -gt 40 ] || fail "the makefile lists its settings"
for setting in $all_settings; do
  refuse_name "$setting" "a b'c\"\$(touch $bait)\`touch $bait\`;é(=).nrrd"
done
for setting in MECHANICS HEXMESH_OPTIONS COMPRESS_OPTIONS SEGMENT; do
  ! plan "$setting=--x \`touch $bait\`" chain || fail "$setting with a command in it is refused"
done
[ ! -e "$bait" ] || fail "nothing of a name is executed"
plan MR="$work/été_+@,.nrrd" chain || grep -q "No rule to make target.*été" "$work/err" || { cat "$work/err"; fail "letters of other languages are fine"; }
! grep -nE '\$+[(]eval ' Makefile.pipeline pipelines/*.mk tests/*.mk tests/*/*.mk || fail "no makefile evaluates a text, in which a name could be code"
pass "names that are code are refused for every path, and nothing is executed"

# `breast run` gives make a link with a plain name instead.
mkdir -p "$work/odd"
for name in "${worst[@]//\//_}" "a b.nrrd" "a'b.nrrd" 'a"b.nrrd' 'a=b.nrrd' 'a%b.nrrd' $'a\nb.nrrd'; do
  touch "$work/odd/$name"
  "$bin/breast" run "$work/odd/$name" --side left --runs "$work/runs" --dry-run > "$work/out" 2>&1 || { cat "$work/out"; fail "breast run accepts $name"; }
  grep -q 'segment .*/\.names/[0-9a-f]*/[^ ]* ' "$work/out" || { cat "$work/out"; fail "breast run links $name"; }
done
[ ! -e "$bait" ] || fail "nothing of a name is executed by breast run"
pass "breast run accepts the names that make refuses"

touch "$work/scan.nrrd"
printf '# a patient\nMR = %s\nSIDE = right   # seen from the patient\nREDUCTION=40\n\nHEXMESH_OPTIONS = --elements 8 --order 1\n' \
  "$work/scan.nrrd" > "$work/patient.case"
plan CASE_FILE="$work/patient.case" chain || { cat "$work/err"; fail "a case file is read"; }
grep -q -- "segment $work/scan.nrrd .*--side right" "$work/out" && grep -q -- '--reduction 40' "$work/out" &&
  grep -q -- '--elements 8 --order 1' "$work/out" || { cat "$work/out"; fail "the settings of a case file count"; }
plan CASE_FILE="$work/patient.case" REDUCTION=30 chain && grep -q -- '--reduction 30' "$work/out" || fail "the command line overrides a case file"
case_file() { printf "$1\n" > "$work/bad.case"; }
case_file "MRI = $work/scan.nrrd"
refused "a slip in a case file" "MRI is no setting" "did you mean MR?" "line 1" -- CASE_FILE="$work/bad.case" chain
case_file "MR = $work/scan.nrrd\nSIDE := left"
refused "make code in a case file" "KEY = VALUE" -- CASE_FILE="$work/bad.case" chain
for line in 'include other' 'MR = $(shell touch '"$bait"')' 'MR = `touch '"$bait"'`' 'SEGMENT = /bin/sh' "MR = a'b" \
  'MR = a;touch '"$bait" 'export X = 1' '$(shell touch '"$bait"')' 'SIDE = lefft' 'MR = a b.nrrd'; do
  printf '%s\n' "$line" > "$work/bad.case"
  ! plan CASE_FILE="$work/bad.case" chain || fail "case file with '$line' is refused"
done
[ ! -e "$bait" ] || fail "nothing in a case file is executed"
pass "case files are data: checked by key and value, never executed"

# A tree without programs, and a cmake that only delivers the one that is asked for.
fresh=$work/fresh
mkdir -p "$fresh"/{libbreast,tools,cmake,python,build/release/bin} "$work/fake"
export PRESET_BUILD=release  # whatever preset the make uses that runs the tests
cp -r Makefile.pipeline pipelines CMakeLists.txt CMakePresets.json "$fresh"
touch "$fresh/build/.packages"
printf '#!/bin/sh\necho "$*" >> "%s/asked"\ncase "$*" in *"--target cases"*) cp "%s/cases" build/release/bin ;; esac\n' "$work" "$bin" > "$work/fake/cmake"
chmod +x "$work/fake/cmake"
case_file "MRI = $work/scan.nrrd"
for setting in "CASE_FILE=$work/bad.case" SIDES=right "MR=\$(shell touch $bait)"; do
  rm -f "$fresh/build/release/bin/cases" "$work/asked"
  ! (cd "$fresh" && PATH=$work/fake:$PATH make -f Makefile.pipeline "$setting" chain > "$work/out" 2> "$work/err") || fail "$setting is refused before the first build"
  grep -q -- '--target cases' "$work/asked" && ! grep -q -- '--target chain_programs' "$work/asked" || { cat "$work/asked"; fail "$setting: cases alone is built"; }
  [ "$(grep -c '\*\*\*' "$work/err")" -eq 1 ] || { cat "$work/err"; fail "$setting is refused in one line"; }
done
[ ! -e "$bait" ] || fail "nothing is executed before cases has checked it"
pass "before the first build, cases alone is built, and what it refuses builds nothing else"

rm -f "$work/asked"
(cd "$fresh" && PATH=$work/fake:$PATH make -f Makefile.pipeline -j2 build > "$work/out" 2> "$work/err") || { cat "$work/err"; fail "make build"; }
[ "$(grep -c -- '--build' "$work/asked")" -eq 5 ] && grep -q -- '--target chain_programs -j' "$work/asked" && grep -q -- '--target identify' "$work/asked" ||
  { cat "$work/asked"; fail "the programs of the chain are built together, and each of the four others when it is needed"; }
touch "$fresh/build/release/bin/identify" "$fresh/CMakeLists.txt"
(cd "$fresh" && PATH=$work/fake:$PATH make -f Makefile.pipeline build/built-release.mk > "$work/out" 2> "$work/err") || { cat "$work/err"; fail "a changed source"; }
grep -q -- '--target chain_programs identify -j' "$work/asked" || { cat "$work/asked"; fail "what was built before is built again when a source has changed"; }
printf '#!/bin/sh\nexit 1\n' > "$work/fake/dpkg-query"
printf '#!/bin/sh\necho "$*" >> "%s/installed"\n' "$work" > "$work/fake/apt-get"
printf '#!/bin/sh\necho 0\n' > "$work/fake/id"
chmod +x "$work/fake"/*
for what in run check package; do
  PATH=$work/fake:$PATH pipelines/setup.sh $what 2> /dev/null
  mv "$work/installed" "$work/$what"
  grep -qw libvtk9-dev "$work/$what" || fail "setup.sh $what installs what all need"
done
! grep -qwE 'clang|libgtest-dev|libopencv-dev|dpkg-dev' "$work/run" && grep -qw libgtest-dev "$work/check" && grep -qw dpkg-dev "$work/package" ||
  fail "each command installs what it needs and no more"
pass "the first command installs and builds what the chain needs; the rest follows when it is asked for"

for pair in "pat.001.nrrd pat.002.nrrd" "1.2.840.113619.2.5 1.2.840.113619.7.9" "x.nii.gz y.nii.gz"; do
  read -r first second <<< "$pair"
  one=$(make -f Makefile.pipeline -n MR="$work/$first" --eval='print: ; $(info $(RUN))' print 2> /dev/null)
  two=$(make -f Makefile.pipeline -n MR="$work/$second" --eval='print: ; $(info $(RUN))' print 2> /dev/null)
  [ -n "$one" ] && [ "$one" != "$two" ] || fail "$first and $second have folders of their own: $one, $two"
done
pass "scans whose names differ have different run folders"

mkdir -p "$work/A/DICOM" "$work/B/DICOM"
echo slice-a > "$work/A/DICOM/1"; echo slice-b > "$work/B/DICOM/1"
run=$work/runs/DICOM-left
"$bin/cases" record "$run" left "$work/A/DICOM" --quiet
plan MR="$work/A/DICOM" chain || { cat "$work/err"; fail "the same scan goes on in its run"; }
touch -d 2001-01-01 "$work/A/DICOM/1"
plan MR="$work/A/DICOM" chain || fail "a touched scan is still the same"
refused "another patient's scan of the same name" "another scan" "CASE=" -- MR="$work/B/DICOM" chain
refused "the phantom in a patient's folder" "another scan" -- CASE=DICOM-left chain
refused "the other side in the same folder" "left breast" -- MR="$work/A/DICOM" CASE=DICOM-left SIDE=right chain
! grep -rqF "$work" "$run/.scan" || fail "the record holds no path"
pass "a run folder remembers its scan and refuses another"

cohort() { rm -rf "$work/cohort"; mkdir -p "$work/cohort/a"; }
cohort; printf 'MR = x.nrrd\n' > "$work/cohort/a.case"; printf 'MR = y.nrrd\n' > "$work/cohort/a/case.txt"
refused "a.case beside a/case.txt" "two case files are called a" -- COHORT="$work/cohort" cohort
cohort; printf 'SIDE = left\n' > "$work/cohort/b.case"
refused "a cohort's case without a scan" "neither MR nor PRESET" -- COHORT="$work/cohort" cohort
cohort; printf 'MRI = x.nrrd\n' > "$work/cohort/b.case"
refused "a cohort's case with a slip" "did you mean MR?" -- COHORT="$work/cohort" cohort
cohort; printf 'MR = x.nrrd\n' > "$work/cohort/a;touch x.case"
refused "a cohort's case with code in its name" "refused" -- COHORT="$work/cohort" cohort
cohort; printf 'MR = x.nrrd\n' > "$work/cohort/a/case.txt"; printf 'PRESET = small\n' > "$work/cohort/b.case"
plan COHORT="$work/cohort" cohort || { cat "$work/err"; fail "a cohort of good cases is planned"; }
plan COHORT="$work/cohort" sides && grep -q 'any-done .*/sides.tsv' "$work/out" || { cat "$work/err"; fail "sides fail when all fail"; }
touch "$work/x.nrrd"
plan MR="$work/x.nrrd" SIDE=left LABELS_TRUTH=/dev/null EVALUATE_OPTIONS="--half-code 34" side || { cat "$work/err"; fail "a side with truth"; }
grep -q 'stage [^ ]*/\.labels-truth\.settings .*--half-code 34' "$work/out" || fail "the options of a comparison are remembered"
printf 'case\tstatus\na\tfailed\nb\tfailed\n' > "$work/t.tsv"
! "$bin/cases" any-done "$work/t.tsv" --quiet 2> /dev/null || fail "a cohort whose cases all fail fails"
printf 'case\tstatus\na\tfailed\nb\tdone\n' > "$work/t.tsv"
"$bin/cases" any-done "$work/t.tsv" --quiet || fail "one case done is enough"
pass "cohorts: names once, a scan in every case, failure when all fail"

# A study is data: columns, stages and rows are known, and nothing in it is code.
study() { printf "$1\n" > "$work/own.tsv"; }
study 'variant\tstarts_at\tmechanics\nsofter\treference\t+--scale fat=50'
plan PRESET=small STUDY="$work/own.tsv" study && grep -q -- 'studies/own/softer/reference.vtkhdf .*--materials seed2008 --scale fat=50' "$work/out" ||
  { cat "$work/err" "$work/out"; fail "a study of one's own is planned"; }
grep -q 'leaves out' "$work/out" && fail "a cell with + leaves nothing out"
study 'variant\tstarts_at\tmechanics\nsofter\treference\t--scale fat=50'
plan PRESET=small STUDY="$work/own.tsv" study && grep -q 'own/softer leaves out of the case mechanics: --materials seed2008' "$work/out" ||
  { cat "$work/err" "$work/out"; fail "a study says what a cell without + leaves out"; }
study 'variant\tstarts_at\tmechanic\nsofter\treference\t+--scale fat=50'
refused "a slip in a study's column" "mechanic" "did you mean mechanics?" -- STUDY="$work/own.tsv" study
study 'variant\tstarts_at\nsofter\trefference'
refused "an unknown stage" "did you mean reference?" -- STUDY="$work/own.tsv" study
study 'variant\tfrom\tstarts_at\nsofter\tharder\treference'
refused "a variant of nothing" "harder" "no row above" -- STUDY="$work/own.tsv" study
study 'variant\tstarts_at\tfit\nsofter\treference'
refused "a line with a cell too few" "softer has 2 cells and not 3" -- STUDY="$work/own.tsv" study
study 'variant\tstarts_at\nsofter\treference\nsofter\treference'
refused "two rows of a name" "softer is no name of a row of its own" -- STUDY="$work/own.tsv" study
for code in '$(shell touch '"$bait"')' '`touch '"$bait"'`' "; touch $bait" '{MR}' '{shell}'; do
  printf 'variant\tstarts_at\tmechanics\nsofter\treference\t%s\n' "$code" > "$work/own.tsv"
  refused "a study with $code" "may not stand in a study" -- STUDY="$work/own.tsv" study
done
refused "a study that is not there" "STUDY" "leaveout" -- STUDY="$work/none.tsv" study
[ ! -e "$bait" ] || fail "nothing of a study is executed"
pass "a study's table is checked by column, stage and row, never executed"

# What Slurm would be given, without Slurm.
script() { make -f Makefile.pipeline RUNS="$work/cluster" COHORT="$work/cohort" CLUSTER=slurm -o build/built-release.mk "$@" cohort-script > "$work/out" 2> "$work/err" || { cat "$work/err"; fail "cohort-script $*"; }; }
script CLUSTER_PARTITION=long CLUSTER_TIME=2:00:00
bash -n "$work/out" && grep -q -- '--array=0-1 ' "$work/out" && grep -qx '#SBATCH --partition=long' "$work/out" && grep -qx '#SBATCH --time=2:00:00' "$work/out" &&
  grep -qx '#SBATCH --requeue' "$work/out" && grep -q 'ELEMENTS=16' "$work/out" || { cat "$work/out"; fail "the script of an array of two cases"; }
printf 'MR = x.nrrd\nELEMENTS = 32\n' > "$work/cohort/b.case"
script && grep -q 'ELEMENTS=32' "$work/out" && ! grep -q -- '--partition' "$work/out" || { cat "$work/out"; fail "the largest mesh of a case file counts"; }
printf 'case\telements\twall_seconds\tcpu_seconds\tpeak_mb\na\t4000\t9\t600\t400\nb\t4000\t9\t60\t800\nc\t4000\t9\t60\t40\n' > "$work/cluster/cohort-cohort/cost.tsv"
script && grep -qx '#SBATCH --time=35' "$work/out" && grep -qx '#SBATCH --mem=1456M' "$work/out" || { cat "$work/out"; fail "time and memory from the cohort's own cost"; }
refused "another cluster" CLUSTER -- COHORT="$work/cohort" CLUSTER=slrum cohort
refused "cores that are no number" CLUSTER_CORES -- COHORT="$work/cohort" CLUSTER=slurm CLUSTER_CORES=two cohort
pass "a cohort for Slurm: the script, and where its time and memory come from"

# Pages of a cohort: every byte is text, whoever wrote it.
runs=$work/pages
mkdir -p "$runs/a<img src=x>"
printf 'a<img src=x>\tx\tscan\nb\tx\tscan\nlost\tx\tscan\nnever\tx\tscan\n' > "$runs/.cases"
printf 'failed\t<script>alert(1)</script> "of" %s\n' "'x'" > "$runs/a<img src=x>.status"
printf 'done\t\n' > "$runs/b.status"
printf 'running\t\n' > "$runs/lost.status"
tabulate cohort "$runs" false > /dev/null || fail "the results of a cohort with hostile names"
cut -f1,2 "$runs/cohort.tsv" | paste -s -d, | grep -q '^case.status,a<img src=x>.failed,lost.failed,never.failed,b.done$' || { cat "$runs/cohort.tsv"; fail "failures come first"; }
grep -q '^lost.*without a message' "$runs/cohort.tsv" && grep -q '^never.*never started' "$runs/cohort.tsv" || fail "a case that left no message is failed"
for page in cohort contours; do
  ! grep -qi '<script\|<img src=x' "$runs/$page.html" && grep -q '&lt;script&gt;' "$runs/$page.html" || fail "no name is markup in $page.html"
  ! grep -qF "$work" "$runs/$page.html" || fail "$page.html names no folder"
done
printf '#!/bin/sh\necho "make: *** No rule to make target '"'/secret/place/x.nrrd'"', needed by '"'$runs/n/labels.vtkhdf'"'.  Stop."; exit 2\n' > "$work/missing.sh"
chmod +x "$work/missing.sh"
"$bin/cases" run "$runs" never --quiet -- "$work/missing.sh" summary
mv "$runs/never.status" "$runs/n.status"
[ "$(cat "$runs/n.status")" = "$(printf "failed\t'x.nrrd', which a setting names, does not exist")" ] || { cat "$runs/n.status"; fail "a reason names no folder"; }
pass "pages of a cohort escape every name, failures first, and name no folder"

# A comma for the decimal point: no number changes.
run=$work/runs/comma
mkdir -p "$run"
printf '{\n  "status": "converged",\n  "thickness_mm": 41.27,\n  "reduction_percent": 15.05,\n  "force_N": 103.6,\n  "detector_force_N": 9.5,\n  "pressure_kPa": 4.25,\n  "warnings": [\n    "plates not balanced: \\"a\\" <b>",\n    "twice"\n  ]\n}\n' > "$run/cc.json"
sed 's/plates not balanced/thrice/' "$run/cc.json" > "$run/mlo.json"
printf '{\n  "tumour": "artificial, on the edge"\n}\n' > "$run/mesh.json"
printf 'file\tartificial_tumour_mm\nsupine.vtkhdf\t3.5\n' > "$run/displacements.tsv"
printf 'file\tnipple_mm\nsupine.vtkhdf\t3.5\n' > "$run/cut.tsv"
tabulate summary "$run" > "$work/plain.txt"
if locale -a | grep -qi '^de_DE.utf-\?8'; then :; else
  mkdir -p "$work/locales"
  export LOCPATH=$work/locales
  localedef -i de_DE -f UTF-8 "$work/locales/de_DE.UTF-8" 2> /dev/null || true
fi
if [ "$(LC_ALL=de_DE.UTF-8 printf '%.1f' 1 2> /dev/null)" = 1,0 ]; then
  LC_ALL=de_DE.UTF-8 tabulate summary "$run" > "$work/comma.txt"
  cmp "$work/plain.txt" "$work/comma.txt" || fail "the summary is the same under a comma locale"
  LC_ALL=de_DE.UTF-8 make -f Makefile.pipeline -n --eval='print: ; +@printf "%.1f\n" 1.5' print > "$work/out" 2> /dev/null
  grep -qx '1\.5' "$work/out" || fail "recipes have decimal points under a comma locale"
  pass "a comma locale changes nothing"
else
  echo "skipped: no German locale on this machine (Debian: locales)"
fi

sed -n 3p "$work/plain.txt" | grep -q '^Warnings: 3; read these first' || { cat "$work/plain.txt"; fail "warnings come first"; }
[ "$(grep -c 'twice' "$work/plain.txt")" -eq 1 ] && grep -q 'cc, mlo: twice' "$work/plain.txt" || fail "each warning stands once, with its stages"
grep -A 1 'plates not balanced' "$work/plain.txt" | grep -q -- '-> .*COMPRESS_OPTIONS' || fail "and with what to do"
grep -q 'TUMOUR IS ARTIFICIAL' "$work/plain.txt" && grep -q 'artificial_tumour_mm' "$work/plain.txt" || fail "an artificial tumour is called so"
pass "the summary begins with every warning, once, and what to do"

hostile=$work/runs/'a<script>alert(1)<'
mkdir -p "$hostile/leaveout"
cp "$run"/* "$hostile"
printf '%s /home/someone/secret/scan.nrrd --side left </script><script>x\n' build/release/bin/segment > "$hostile/.labels.settings"
printf 'a\tb\n<img src=x>\t1\n' > "$hostile/leaveout/table.tsv"
tabulate report "$hostile" "$work/runs" > "$work/report.html" || fail "a report of a case with a hostile name"
! grep -qi '<script\|<img src=x' "$work/report.html" || fail "no name is markup in the report"
! grep -q 'secret\|/home' "$work/report.html" || fail "the report names no folder"
grep -q 'Content-Security-Policy' "$work/report.html" || fail "and allows no script"
[ "$(grep -n 'Warnings: 3' "$work/report.html" | cut -d: -f1)" -lt "$(grep -n 'Landmarks' "$work/report.html" | sed -n 1p | cut -d: -f1)" ] ||
  fail "the report begins with the warnings"
pass "the report escapes every name, names no folder, and begins with the warnings"

plan MR="$work/scan.nrrd" chain || fail "a scan is planned"
grep -q -- '--tumour none' "$work/out" && grep -q 'match-lookup' "$work/out" && ! grep -q 'cc2mlo' "$work/out" ||
  { cat "$work/out"; fail "a scan has no invented tumour: its chain ends with the page of all points"; }
plan MR="$work/scan.nrrd" TUMOUR=-5,3.5,-2:4 chain && grep -q -- '--tumour -5,3.5,-2:4' "$work/out" || fail "a given tumour is passed on"
plan MR="$work/scan.nrrd" TUMOUR=auto chain && grep -q -- '--tumour auto' "$work/out" && grep -q 'cc2mlo' "$work/out" || fail "TUMOUR=auto makes one"
refused "tables of a case without a tumour" TUMOUR -- MR="$work/scan.nrrd" tables
pass "no tumour is invented for a scan"

for goal in budget band-check calibrate; do
  refused "$goal of a breast that slides" "$goal: holds the breast at its wall" "PRESET=paper" -- PRESET=average "$goal"
done
for goal in truth matching band-truth budget; do
  refused "$goal of a scan" "$goal: a scan has no truth" -- MR="$work/scan.nrrd" "$goal"
done
refused "the printed model beside a truth that slides" "PAPER=1" -- PAPER=1 PRESET=slim truth
plan PRESET=average truth && grep 'left-fine-cc.vtkhdf' "$work/out" | grep -q -- '--image-edge 20' &&
  ! grep 'left-fine-cc.vtkhdf' "$work/out" | grep -q -- '--materials\|--wall\|--cut' ||
  { cat "$work/out"; fail "the truth of a body has the model that its file states"; }
pass "a truth is that of the phantom's own body, or is refused"

echo "$passed passed, 0 failed"
