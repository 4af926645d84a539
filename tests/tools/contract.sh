#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What make promises of a run, with stages that only say what they were called with: files that users edit are known by content, a
# stage that was stopped is run again, a run keeps nothing that its settings do not make, two runs with other settings never share a
# folder, and the terminal shows a line a stage. contract.sh [BIN]
set -euo pipefail
bin=$(realpath "${1:-$(dirname "$0")/../../build/release/bin}")
unset MAKEFLAGS MFLAGS MAKEOVERRIDES MAKELEVEL  # of a make that runs the tests
cd "$(dirname "$0")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
passed=0
pass() { passed=$((passed + 1)); echo "ok: $*"; }
fail() { echo "FAILED: $*"; cat "$work/err" 2> /dev/null; echo "$passed passed, 1 failed"; exit 1; }

# Every file that a stage writes holds its command line and the material set; `hold` makes hexmesh wait, `break-PROGRAM` makes one fail.
mkdir -p "$work/bin"
cat > "$work/stub" <<'STUB'
#!/usr/bin/env bash
name=$(basename "$0") words="$*" after=() positional=()
while [ $# -gt 0 ]; do
  case "$1" in
    --report) report=$2; shift ;;
    --points|--table|--png) after+=("$2"); shift ;;
    --truth) mkdir -p "$2"; for file in landmarks tumour-left tumour-right; do echo "$file" > "$2/$file.tsv"; done; shift ;;
    --materials) set=$2; shift ;;
    --*) shift ;;
    *) positional+=("$1") ;;
  esac
  shift
done
case "$name" in phantom) at=0 ;; hexmesh|cc2mlo|match-lookup|sensitivity) at=2 ;; *) at=1 ;; esac
echo "$name: working"
echo "$name: warning: it says more" >&2
[ ! -e WORK/break-$name ] || { echo "$name: no body of this shape" >&2; exit 3; }
[ "$name" != probe ] || exit 0
[ "$name" != export-slicer ] || positional[1]+=/scene.mrml
pressed='"tool": "compress", "status": "not_gripped", "reason": "the plates do not grip", "accepted": false'
case "$name $words" in compress*"--view MLO"*) [ ! -e WORK/loose ] || { report_only=yes; case "$words" in *--keep-unconverged*) ;; *) exit 3 ;; esac; } ;; esac
case "$words" in *fat=1\ *) printf '{"tool": "%s", "status": "not_converged", "reason": "folded"}\n' "$name" > "$report"; exit 3 ;; esac
for file in "${positional[at]}" "${after[@]}"; do { echo "$words"; cat "${set:-/dev/null}" 2> /dev/null || true; } > "$file"; done
[ -z "${report:-}" ] || printf '{"tool": "%s", "status": "ok", "elements": 8, "min_scaled_jacobian": 0.5}\n' "$name" > "$report"
[ -z "${report_only:-}" ] || { printf '{%s}\n' "$pressed" > "$report"; exit 3; }
while [ "$name" = hexmesh ] && [ -e WORK/hold ]; do sleep 0.1; done
STUB
sed -i "s|WORK|$work|g" "$work/stub"
chmod +x "$work/stub"
for tool in phantom segment fit-hermite hexmesh backward forward compress project-mammogram cc2mlo match-lookup sensitivity probe export-slicer identify; do
  ln -s ../stub "$work/bin/$tool"
done
# The page of files that are none is what it was called with.
printf '#!/usr/bin/env bash\ncase " $* " in *" page "*) echo "$*" ;; *) exec "%s/tabulate" "$@" ;; esac\n' "$bin" > "$work/bin/tabulate"
chmod +x "$work/bin/tabulate"
for tool in $(ls "$bin"); do [ -e "$work/bin/$tool" ] || ln -s "$bin/$tool" "$work/bin/$tool"; done
export INSTALLED=$work/bin
run=$work/runs/one
call() { make -f Makefile.pipeline RUNS="$work/runs" CASE=one PRESET=small "$@" > "$work/out" 2> "$work/err"; }
made() { call "$@" chain || fail "chain $*"; }

made
[ "$(wc -l < "$work/err")" -eq 15 ] && grep -q '^compress CC  .* [0-9]* s$' "$work/err" && grep -q '^hexmesh .*8 elements, .* 0.50, [0-9]* s$' "$work/err" ||
  fail "a line a stage, with view, what was found and seconds"
grep -q '^compress MLO: compress: warning: it says more' "$run/log.txt" && ! grep -q 'it says more' "$work/err" || fail "all else is in log.txt"
call -q chain || fail "a second run does nothing"
pass "a line a stage; what programs say is in log.txt"
call "$run/displacements.tsv" && [ "$(wc -l < "$work/err")" -eq 1 ] && grep -q '^probe displacements.tsv  .* s$' "$work/err" &&
  grep -q '^probe displacements.tsv: probe: warning: it says more' "$run/log.txt" && [ "$(cat "$run/displacements.tsv")" = "probe: working" ] ||
  fail "of a program that prints a table, the table is what it prints, and its messages are in log.txt"
pass "tables that programs print are apart from what they say"
call -n summary && grep -q "bin/render .*--all $run/figures" "$work/out" || fail "the summary waits for the pictures"
pass "the summary waits for the pictures"

# Files that users edit, by content.
printf 'tissue\tc\nfat\t1\n' > "$work/own.tsv"
made MATERIALS="$work/own.tsv"
touch "$work/own.tsv"
call -q MATERIALS="$work/own.tsv" chain || fail "a file that was only touched is the same"
printf 'tissue\tc\nfat\t2\n' > "$work/own.tsv"
touch -d 2001-01-01 "$work/own.tsv"
made MATERIALS="$work/own.tsv"
grep -q '^fat.2' "$run/reference.vtkhdf" && grep -q '^fat.2' "$run/cc.vtkhdf" && ! grep -q '^hexmesh' "$work/err" || fail "a material set of an older date is another"
printf 'x\ty\tz\n1\t2\t3\n' > "$work/place.tsv"
made TUMOUR="$work/place.tsv"
printf 'x\ty\tz\n1\t2\t4\n' > "$work/place.tsv"
touch -d 2001-01-01 "$work/place.tsv"
! call -q TUMOUR="$work/place.tsv" chain || fail "a tumour of an older date is another"
echo wall > "$work/wall.vtp"
made CHEST_WALL="$work/wall.vtp"
echo ribs > "$work/wall.vtp"
touch -d 2001-01-01 "$work/wall.vtp"
made CHEST_WALL="$work/wall.vtp"
grep -q '^segment' "$work/err" || fail "a chest wall of an older date is another"
for setting in FAT ALSO; do
  echo one > "$work/second.nrrd"
  made $setting="$work/second.nrrd"
  echo other > "$work/second.nrrd"
  touch -d 2001-01-01 "$work/second.nrrd"
  made $setting="$work/second.nrrd"
  grep -q '^segment' "$work/err" || fail "a second scan ($setting) of an older date is another"
done
printf 'PRESET = small\nREDUCTION = 40\n' > "$work/a.case"
made CASE_FILE="$work/a.case"
printf 'PRESET = small\nREDUCTION = 41\n' > "$work/a.case"
touch -d 2001-01-01 "$work/a.case"
made CASE_FILE="$work/a.case"
grep -q 'reduction 41' "$run/cc.vtkhdf" || fail "a case file of an older date is another"
pass "materials, tumour, second scans, chest wall and case file are known by content"

# Without a tumour nothing of a tumour is left.
made TUMOUR=auto
mkdir -p "$run/figures" "$run/slicer" "$run/states/supine-states"
touch "$run/figures/cc-matching.png" "$run/slicer/curve-mlo.mrk.json" "$run/slicer/scene.mrml" "$run/figures/cc-states.png"
made TUMOUR=none
for file in curve.vtp curve.tsv curve.json figures/cc-matching.png slicer/curve-mlo.mrk.json slicer/scene.mrml figures/cc-states.png states/supine-states; do
  [ ! -e "$run/$file" ] || fail "without a tumour there is no $file"
done
[ -e "$run/page.html" ] || fail "and the page of all points instead"
pass "what the settings do not make is not left behind"

# A row of a study is the chain's own rules in another folder, and a solve that ends early is its result.
printf 'variant\tfrom\tstarts_at\tends_at\tmechanics\nsofter\t-\treference\tsupine\t+--scale fat=50\n' > "$work/own.tsv"
printf 'hopeless\tsofter\treference\tsupine\t+--scale fat=1\nfiner\tsofter\tsupine\tsupine\t+--element q2p1\n' >> "$work/own.tsv"
rows=$run/studies/own
made
study() { call STUDY="$work/own.tsv" "$@" "$rows/softer/supine.json" "$rows/hopeless/supine.json" "$rows/finer/supine.json"; }
study || fail "a study"
grep -q '^own/softer: forward ' "$work/err" && grep -q '^own/hopeless: backward .*folded' "$work/err" || fail "the lines of a study name its rows"
grep -q "^$run/mesh.vtkhdf $rows/softer/reference.vtkhdf .*--materials seed2008 --scale fat=50 " "$rows/softer/reference.vtkhdf" &&
  grep -q "^$rows/softer/reference.vtkhdf $rows/finer/supine.vtkhdf .*--scale fat=50 --element q2p1 " "$rows/finer/supine.vtkhdf" || fail "rows have their options"
grep -q folded "$rows/hopeless/supine.json" && [ ! -e "$rows/hopeless/supine.vtkhdf" ] || fail "what needed a solve that ended early has its reason"
study -q || fail "a second run of a study does nothing"
sed -i 's/fat=50/fat=60/' "$work/own.tsv"
# hopeless has its own scale in the place of that of softer, and stays as it is.
study && [ "$(wc -l < "$work/err")" -eq 3 ] && call -q chain || { cat "$work/err"; fail "a changed row is solved again, with what starts from it, and the case is not"; }
pass "rows of a study follow the rules of the chain"

# A stage that was stopped has no record: whatever is asked next is made.
made ELEMENTS=5
touch "$work/hold"
# Prints the number of a make that has written its mesh and waits.
begin() { # ELEMENTS
  make -f Makefile.pipeline RUNS="$work/runs" CASE=one PRESET=small ELEMENTS="$1" chain > "$work/first" 2>&1 &
  first=$!
  for _ in $(seq 200); do grep -qs -- "--elements $1 " "$run/mesh.vtkhdf" && return; sleep 0.1; done
  fail "hexmesh with ELEMENTS=$1 has begun"
}
begin 20
code=0
call ELEMENTS=5 chain || code=$?
[ "$code" -ne 0 ] && [ "$(grep -c '\*\*\*' "$work/err")" -eq 1 ] && grep -q "process $first, and there ELEMENTS is not ELEMENTS=5; wait" "$work/err" ||
  fail "a second run with other settings is refused by name"
call -n ELEMENTS=20 chain || fail "a plan is never refused"
kill "$first"
wait "$first" 2> /dev/null || true
rm "$work/hold"
sleep 0.3
made ELEMENTS=5
grep -q -- '--elements 5 ' "$run/mesh.vtkhdf" && grep -q '^backward' "$work/err" || fail "the mesh is that of the settings"
pass "a stage that was stopped is run again, and two runs with other settings do not share a folder"

# Nor has one that failed, whatever makes it.
rerun() { # PROGRAM FILE OPTION [SETTING...]
  local program=$1 file=$2 other=$3
  shift 3
  call "$@" "$file" && call -q "$@" "$file" || fail "$file is made"
  touch "$work/break-$program"
  ! call "$@" "$other" "$file" || fail "$program fails"
  rm "$work/break-$program"
  ! call -q "$@" "$file" || fail "$file is made again when $program has failed with $other"
}
rerun cc2mlo "$run/curves.vtp" POINTS=5
rerun export-slicer "$run/slicer/scene.mrml" SLICER_OPTIONS=--points
printf 'x\ty\tz\n' > "$work/pairs.tsv"
rerun identify "$run/identified.tsv" CUT=roller LANDMARKS="$work/pairs.tsv"
pass "a stage that failed is run again with the settings of before"

touch "$work/break-backward"
! call ELEMENTS=6 chain || fail "a stage fails"
tail -n 3 "$work/err" | paste -s -d'|' | grep -q "^backward: no body of this shape|backward ended with exit code 3 after [0-9]* s: see $run/log.txt|make: " ||
  fail "the reason, and where to look"
pass "a stage that fails says why and where to look"

# Plates that do not grip the breast: the shape is kept, nothing is made of it, the rest is finished, and make fails.
rm "$work/break-backward"
made FORCE=70
touch "$work/loose"
! call FORCE=80 chain || fail "a view without a grip fails"
[ -e "$run/mlo.vtkhdf" ] && [ -e "$run/cc.vti" ] && [ ! -e "$run/mlo.vti" ] && [ ! -e "$run/curve.tsv" ] || fail "nothing is made of a shape without a grip"
grep -q '^project-mammogram MLO  .*not made: mlo.vtkhdf is no compression' "$work/err" && grep -q '^cc2mlo  .*not made' "$work/err" &&
  grep -q '^MLO is no compression: the plates do not grip' "$work/err" || fail "what is not made is said"
rm "$work/loose"
! call FORCE=80 chain && ! grep -q '^compress' "$work/err" || fail "the shape without a grip is kept"
made FORCE=90
[ -e "$run/mlo.vti" ] && [ -e "$run/curve.tsv" ] || fail "other plates grip"
pass "a view without a grip is kept and said, and nothing is made of it"

# A shape without derivatives has a page without bands.
grep -q "^$run/cc-sensitivity.vtkhdf $run/mlo-sensitivity.vtkhdf $run/lookup.h5 " "$run/lookup.h5" || fail "curves have bands"
touch "$work/break-sensitivity"
made FORCE=95
grep -q '^sensitivity CC  .*left out: no body of this shape' "$work/err" && [ ! -e "$run/cc-sensitivity.vtkhdf" ] || fail "derivatives that cannot be had are left out"
grep -q "^$run/cc.vtkhdf $run/mlo.vtkhdf $run/lookup.h5 " "$run/lookup.h5" && [ -s "$run/page.html" ] || fail "and the page has curves without bands"
rm "$work/break-sensitivity"
pass "derivatives that cannot be had are left out"
echo "$passed passed, 0 failed"
