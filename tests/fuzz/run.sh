#!/bin/sh
# run.sh [MINUTES [TARGET...]]: fuzzes our own checks of every format for so long in all (default 5), under
# ASan and UBSan, from small valid files and from every input that once crashed (tests/fuzz/seeds/TARGET). Exit 1
# when something crashes, hangs over 10 s or takes over 1 GB; the input is then in build/fuzz/crashes: mend the
# cause and keep the input as a seed.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
build=$root/build/fuzz
minutes=${1:-5}
[ $# -eq 0 ] || shift
command -v clang++ > /dev/null || {
  echo "run.sh: clang++ is needed (apt-get install clang libclang-rt-14-dev)" >&2
  exit 2
}
cmake -S "$root/tests/fuzz" -B "$build" -G Ninja -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ \
  -DCMAKE_CXX_COMPILER_LAUNCHER="$(command -v ccache || true)" > /dev/null
cmake --build "$build" > "$build/build.log" || { tail -40 "$build/build.log" >&2; exit 2; }
[ $# -gt 0 ] || set -- nrrd nifti meta dicom table materials report mesh labels geometry results
rm -rf "$build/seeds"
mkdir -p "$build/seeds" "$build/crashes"
"$build/seeds_program" "$build/seeds"
cp "$root"/pipelines/materials/*.tsv "$build/seeds/materials/"
seconds=$((minutes * 60 / $#))
status=0
for target in "$@"; do
  mkdir -p "$build/corpus/$target"
  kept=$root/tests/fuzz/seeds/$target
  [ -d "$kept" ] || kept=
  "$build/fuzz_$target" -max_total_time=$seconds -timeout=10 -rss_limit_mb=1024 -max_len=131072 -verbosity=0 \
    -print_final_stats=1 -artifact_prefix="$build/crashes/$target-" "$build/corpus/$target" "$build/seeds/$target" \
    $kept > "$build/$target.log" 2>&1 || { status=1; echo "$target: see $build/$target.log"; }
  printf '%s: ' "$target"
  sed -n 's/^stat::number_of_executed_units: */inputs tried: /p' "$build/$target.log"
done
exit $status
