#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# installed.sh BUILD [PYTHON]: the build installed under a temporary prefix, used as a user would from a folder with a blank in its name:
# version, list, help, a tool, completion, and plans (make -n) of runs on scans of every name.
set -euo pipefail
unset MAKEFLAGS MFLAGS MAKEOVERRIDES MAKELEVEL  # of a make that runs the tests
build=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
passed=0
pass() { passed=$((passed + 1)); echo "ok: $*"; }
fail() { echo "FAILED: $*"; echo "$passed passed, 1 failed"; exit 1; }

export HOME=$work/built
cmake --install "$build" --prefix "$HOME/.local" > "$work/log" || { tail -n 5 "$work/log"; fail "cmake --install"; }
mv "$HOME" "$work/home"  # everything finds everything else by its place
export HOME=$work/home
prefix=$HOME/.local
PATH=$prefix/bin:$PATH
for file in bin/breast libexec/breast/segment share/breast/Makefile.pipeline share/breast/pipelines/materials/seed2008.tsv \
  share/man/man1/breast.1.gz share/man/man1/breast-forward.1.gz share/bash-completion/completions/breast \
  share/doc/libbreast/README.md share/doc/libbreast/docs/file-formats.md; do
  [ -s "$prefix/$file" ] || fail "$file is installed"
done
[ "$(ls "$prefix/bin")" = breast ] || fail "only breast lands in bin: the tools' names collide with nobody"
gzip -dc "$prefix/share/man/man1/breast-forward.1.gz" | grep -q '^breast\\-forward \\- ' || fail "manual pages call a tool as it is called"
[ "$(ls "$prefix"/share/man/man1/breast-*.gz | wc -l)" -ge "$(ls "$prefix/libexec/breast" | wc -l)" ] || fail "every tool has its manual page"
# From another folder a script of the pipeline is found by $(PIPELINES) alone.
! grep -nE "([[:space:]@\"']|[$][(])pipelines/" "$prefix"/share/breast/pipelines/*.mk | grep -v ':[0-9]*:#' || fail "a rule names pipelines/ instead of \$(PIPELINES)/"
pass "programs, pipeline, materials, manual pages, completion and documents are installed"
(cd / && /usr/bin/python3 -c 'import breast; breast.load') || fail "import breast"
pass "import breast works"

mkdir "$work/my cases"
cd "$work/my cases"
said() { # TEXT COMMAND...
  local text=$1
  shift
  "$@" > "$work/out" 2> "$work/err" || { cat "$work/err"; fail "$*"; }
  grep -qF -- "$text" "$work/out" || { cat "$work/out"; fail "$* says '$text'"; }
}
refused() { # TEXT COMMAND...: exit 2, one line, nothing on stdout
  local text=$1 code=0
  shift
  "$@" > "$work/out" 2> "$work/err" || code=$?
  [ "$code" -eq 2 ] && [ ! -s "$work/out" ] && [ "$(wc -l < "$work/err")" -eq 1 ] || { cat "$work/out" "$work/err"; fail "$*: exit $code, one line"; }
  grep -qF -- "$text" "$work/err" || { cat "$work/err"; fail "$* says '$text'"; }
}
said "breast (libbreast) " breast --version
grep -q "^version: $(sed 's/.* //' "$work/out")\$" "$prefix/share/doc/libbreast/CITATION.cff" || fail "CITATION.cff names this version"
said "segment " breast list
[ "$(wc -l < "$work/out")" -eq "$(ls "$prefix/libexec/breast" | wc -l)" ] || fail "breast list names what is installed"
! grep -qE '^[a-z0-9-]+ *$' "$work/out" || { cat "$work/out"; fail "every tool has its summary"; }
said "Usage: breast compress " breast help compress
said "  breast compress reference.vtkhdf" breast compress --help
said "--side left|right" breast help run
said "REDUCTION=P" breast help settings
said "point x,y,z[:radius]" breast help TUMOUR
said "a number from 1 to 95" breast help reduction
said "average/page.html" breast page --dry-run
said "average/report.html" breast demo --target report --dry-run
said "laws (libbreast) " breast laws --version
said "fibroglandular" breast laws seed2008
refused "did you mean 'compress'" breast compres
refused "--no-such" breast laws seed2008 --no-such
refused "give a command" breast
refused "'made' is not a kind of table or page" breast tabulate made table.tsv result.json  # the upkeep of the source tree's pages
pass "version, list, help, a tool; an unknown command and option"

source "$prefix/share/bash-completion/completions/breast"
completed() { # WANTED WORD...
  local wanted=$1
  shift
  COMP_WORDS=(breast "$@") COMP_CWORD=$# COMPREPLY=()
  _breast 2> /dev/null || true  # compopt complains outside a completion
  [ "${COMPREPLY[*]}" = "$wanted" ] || fail "completion of '$*' is '${COMPREPLY[*]}', not '$wanted'"
}
completed compress compr
completed --estimate forward --est
completed "q1p0 q2p1" forward --element ''
completed q2p1 forward --element = q2
completed "left right" run x --side ''
completed REDUCTION= run x RED
completed "--runs" demo --ru
completed "" segment sca
pass "completion of commands, options, choices and settings"

planned() { # TEXT COMMAND...
  said "$@"
  grep -q "$prefix/libexec/breast/segment" "$work/out" || { cat "$work/out"; fail "${*:2}: with the installed tools"; }
  ! grep -qE 'apt-get|cmake|ninja' "$work/out" || fail "${*:2}: builds and installs nothing"
}
planned "runs/average/labels.vtkhdf" breast demo --dry-run
planned "--reduction 40" breast demo REDUCTION=40 --dry-run
names=("scan.nrrd" "my scan.nrrd" "it's [a] \"scan\" (1).nrrd" 'a=b;c$d&e.nrrd' "été 乳房.nrrd" "-x.nrrd" $'a\nb.nrrd' $'latin-\xe9.nrrd')
folders=(scan my_scan it_s__a___scan___1_ a_b_c_d_e été_乳房 -x a_b latin-_)
for i in "${!names[@]}"; do
  rm -rf runs
  touch -- "${names[i]}"
  planned "runs/${folders[i]}-left/labels.vtkhdf" breast run "./${names[i]}" --side left --dry-run
done
mkdir -p "series 1" sub
touch "series 1/IM (1).dcm" "series 1/IM 2.dcm"
planned "runs/series_1-right/labels.vtkhdf" breast run "series 1/" --side right --dry-run
planned "runs/series_1-right/labels.vtkhdf" breast run "$PWD/series 1" --side right --dry-run
(cd sub && planned "../runs/scan-left/labels.vtkhdf" breast run ../scan.nrrd --side left --runs ../runs --dry-run)
(cd / && planned "$work/elsewhere/scan-left/labels.vtkhdf" breast run "$work/my cases/scan.nrrd" --side left --runs "$work/elsewhere" --dry-run)
planned "runs/scan-left/labels.vtkhdf" breast run scan.nrrd --dry-run
planned "runs/scan-right/labels.vtkhdf" breast run scan.nrrd --dry-run
printf 'x_mm\ty_mm\tz_mm\n-60\t-40\t12\n' > scan-tumour.tsv
planned "--tumour scan-tumour.tsv" breast run scan.nrrd --side right --dry-run
rm scan-tumour.tsv
touch "a wall.nrrd" "fat image.nrrd"
planned "fat_image.nrrd" breast run scan.nrrd --side left "FAT=fat image.nrrd" --dry-run
planned "a_wall.nrrd" breast run scan.nrrd --side left "CHEST_WALL=a wall.nrrd" --dry-run
printf 'MR = scan.nrrd\n' > "series 1/one.case"
said "runs/cohort-series_1" breast cohort "series 1" --dry-run
said "#SBATCH --partition=long" breast cohort "series 1" --slurm --partition long --dry-run
[ -z "$(find "$prefix" -newer "$work/log" -type f)" ] || fail "nothing is written into the prefix"
pass "runs are planned from any folder, for scans of any name, with the installed tools"

refused "'missing.nrrd' does not exist" breast run missing.nrrd --side left
refused "--side left|right is missing" breast run scan.nrrd CASE=one
refused "did you mean SIDE?" breast run scan.nrrd --side left SIDES=left
refused "did you mean seed2008?" breast run scan.nrrd --side left MATERIALS=seed208
refused "'wall.nrrd'" breast run scan.nrrd --side left CHEST_WALL=wall.nrrd
refused "may not stand in it" breast run scan.nrrd --side left 'FIT_OPTIONS=$(shell touch executed)'
refused "make cannot write to a folder with such a name" breast run scan.nrrd --side left --runs 'a b'
refused "is not writable" breast run scan.nrrd --side left --runs /proc
refused "needs the source tree" breast run scan.nrrd --side left --target check
refused "not a target of the pipeline" breast run scan.nrrd --side left --target summry
touch "a header.mhd"
refused "rename it" breast run "a header.mhd" --side left
[ ! -e executed ] && [ ! -e 'a b' ] || fail "what is refused leaves nothing"
pass "what the pipeline refuses is refused in one line, before anything runs"
echo "$passed passed, 0 failed"
