#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# run.sh [MINUTES | inputs=N [TARGET...]]: fuzzes our own checks of every format for so long in all (default 5 minutes), or
# with N inputs a format, under ASan and UBSan, from small valid files and from every input that once crashed
# (tests/fuzz/seeds/TARGET). Exit 1 when something crashes, hangs over 10 s or takes over 1 GB; the input is then in
# build/fuzz/crashes: mend the cause and keep the input as a seed. A row a format is added to build/fuzz/fuzz.tsv (columns of
# docs/tables/fuzz.tsv). The 10 s are of the clock: where other work has the processors, FUZZ_TIMEOUT is another limit, and
# inputs that took 10 s are kept in crashes as well, to be tried alone. `make check` runs 2000 inputs a format.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
build=$root/build/fuzz
how_long=${1:-5}
[ $# -eq 0 ] || shift
command -v clang++ > /dev/null || {
  echo "run.sh: clang++ is needed (apt-get install clang libclang-rt-14-dev)" >&2
  exit 2
}
cmake -S "$root/tests/fuzz" -B "$build" -G Ninja -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ \
  -DCMAKE_CXX_COMPILER_LAUNCHER="$(command -v ccache || true)" > /dev/null
cmake --build "$build" > "$build/build.log" || { tail -40 "$build/build.log" >&2; exit 2; }
[ $# -gt 0 ] || set -- nrrd nifti meta dicom table materials report mesh labels geometry results vtk segmentation markups
rm -rf "$build/seeds"
mkdir -p "$build/seeds" "$build/crashes"
"$build/seeds_program" "$build/seeds"
cp "$root"/pipelines/materials/*.tsv "$build/seeds/materials/"
case "$how_long" in
  inputs=*) until=-runs=${how_long#inputs=} ;;
  *) until=-max_total_time=$((how_long * 60 / $#)) ;;
esac
[ -s "$build/fuzz.tsv" ] || printf 'format\tthrough\tinputs\taccepted_percent\tfindings\tslowest_s\tmost_MB\n' > "$build/fuzz.tsv"
status=0
for target in "$@"; do
  export FUZZ_TARGET=$target
  "$build/fuzz" -runs=0 > /dev/null 2>&1 || { echo "$target: left out, VTK is missing"; continue; }
  mkdir -p "$build/corpus/$target"
  kept=$root/tests/fuzz/seeds/$target
  [ -d "$kept" ] || kept=
  leaks=1
  [ "$target" != vtk ] || leaks=0  # what VTK's classes share is never freed
  "$build/fuzz" $until -timeout="${FUZZ_TIMEOUT:-10}" -rss_limit_mb=1024 -max_len=131072 -verbosity=0 -detect_leaks=$leaks \
    -print_final_stats=1 -artifact_prefix="$build/crashes/$target-" "$build/corpus/$target" "$build/seeds/$target" \
    $kept > "$build/$target.log" 2>&1 || { status=1; echo "$target: see $build/$target.log"; }
  found=$(find "$build/crashes" -name "$target-*" -newer "$build/seeds" | wc -l)
  awk -v target="$target" -v found="$found" '
    $1 == "stat::number_of_executed_units:" { inputs = $2 }
    $1 == "stat::slowest_unit_time_sec:" { slowest = $2 }
    $1 == "stat::peak_rss_mb:" { most = $2 }
    END { print target "\tour checks, ASan and UBSan\t" inputs + 0 "\t\t" found "\t" slowest + 0 "\t" most + 0 }' \
    "$build/$target.log" | tee -a "$build/fuzz.tsv"
done
exit $status
