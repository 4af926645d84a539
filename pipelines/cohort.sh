#!/usr/bin/env bash
# cohort.sh run STATUS LOG COMMAND...  runs a case; STATUS says "done", or "failed" and why
# cohort.sh table RUNS CASE...         one table of all cases
set -euo pipefail
key() { [ -s "$1" ] && sed -n "s/^  \"$2\": \"\{0,1\}\([^\",]*\)\"\{0,1\},\{0,1\}$/\1/p" "$1" | head -n 1; }
number() {
  local value
  value=$(key "$1" "$2") || true
  [ -n "$value" ] && printf "%.${3}f" "$value" || printf -- '-'
}
if [ "$1" = run ]; then
  status=$2 log=$3
  shift 3
  if "$@" > "$log" 2>&1; then
    printf 'done\t\n' > "$status"
  else
    # The last line a program printed before make's own "*** [...] Error", else make's.
    reason=$({ grep -v '^make' "$log" | grep -E '^[a-z0-9-]+: ' || cat "$log"; } | tail -n 1 | tr '\t' ' ')
    printf 'failed\t%s\n' "${reason:-see $log}" > "$status"
  fi
  exit 0
fi
runs=$2
shift 2
printf 'case\tstatus\tvolume_ml\tmin_scaled_jacobian\tsupine_nipple_mm\tsupine_tumour_mm\tcc_thickness_mm\tcc_force_N\tmlo_thickness_mm\tmlo_force_N\tseconds\treason\n'
for case in "$@"; do
  IFS=$'\t' read -r status reason < "$runs/$case.status" || true
  run=$runs/$case
  moved() { # landmark: supine displacement
    [ -s "$run/displacements.tsv" ] || { printf -- '-'; return; }
    awk -F'\t' -v column="$1_mm" '/^#/ { next } !at { for (i = 1; i <= NF; i++) if ($i == column) at = i; next }
      $1 == "supine.vtkhdf" { value = $at } END { print value == "" ? "-" : value }' "$run/displacements.tsv"
  }
  volume=$(awk '/"volumes_ml":/ { inside = 1; next } inside && /}/ { exit } inside { gsub(/[^0-9.eE+-]/, "", $2); sum += $2 }
    END { printf "%.0f", sum }' "$run/mesh.json" 2>/dev/null || printf -- '-')
  seconds=$(cat "$run"/*.json 2>/dev/null | awk '/"total":/ { gsub(/[^0-9.eE+-]/, "", $2); sum += $2 } END { printf "%.0f", sum }')
  printf '%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\n' "$case" "$status" "$volume" \
    "$(number "$run/mesh.json" min_scaled_jacobian 2)" "$(moved nipple)" "$(moved tumour)" \
    "$(number "$run/cc.json" thickness_mm 1)" "$(number "$run/cc.json" force_N 1)" \
    "$(number "$run/mlo.json" thickness_mm 1)" "$(number "$run/mlo.json" force_N 1)" "$seconds" "${reason:--}"
done
