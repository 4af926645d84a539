#!/usr/bin/env bash
# Prone to supine with given mechanics: posture-change.sh MESH NAME BACKWARD FORWARD MECHANICS...
# writes NAME-reference.vtkhdf and NAME-supine.vtkhdf with their reports. Where a solve does not converge
# (exit 3), the reason stays in NAME.failed and the files are absent: a finding, not an error.
set -euo pipefail
mesh=$1 name=$2 backward=$3 forward=$4
shift 4
rm -f "$name"-reference.vtkhdf "$name"-supine.vtkhdf "$name".failed
# Exit 3 of a program becomes the mark; any other failure stops.
solve() {
  local program=$1 input=$2 output=$3 posture=$4 code=0
  shift 4
  "$program" "$input" "$output" --posture "$posture" "$@" --report "${output%.vtkhdf}.json" || code=$?
  if [ "$code" -eq 3 ]; then
    sed -n 's/^  "\(explanation\|reason\)": "\(.*\)",\{0,1\}$/\2/p' "${output%.vtkhdf}.json" | tail -n 1 > "$name.failed"
  elif [ "$code" -ne 0 ]; then
    exit "$code"
  fi
  [ "$code" -eq 0 ]
}
solve "$backward" "$mesh" "$name-reference.vtkhdf" prone "$@" &&
  solve "$forward" "$name-reference.vtkhdf" "$name-supine.vtkhdf" supine "$@" || true
