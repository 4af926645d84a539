#!/usr/bin/env bash
# cohort.sh run STATUS LOG COMMAND...  runs a case; STATUS says "done", or "failed" and why
# cohort.sh table RUNS CASE...         one table of all cases
# cohort.sh any-done TABLE             fails when no case of it is done
# cohort.sh strange COHORT             one line naming a case file or folder with characters that make or a shell would read
#                                      as code; nothing when there is none
set -euo pipefail
. "$(dirname "$0")/values.sh"
if [ "$1" = strange ]; then
  find -L "$2" -maxdepth 2 \( -name '*.case' -o -name '*.mk' -o -path '*/*/case.txt' \) -print0 |
    while IFS= read -r -d '' file; do
      case "$file" in
        *[[:space:]]* | *[\$\`\;\&\|\<\>\(\)\{\}\[\]\*\?\!\"\'\\^\#=:%~]*)
          printf 'COHORT: %s: a name with such characters is refused; use letters, digits, points, dashes and underscores' \
            "$(printf '%s' "${file#"$2"/}" | tr -c '[:alnum:]./_-' '?')"
          exit 0 ;;
      esac
    done
  exit 0
fi
if [ "$1" = any-done ]; then
  awk -F'\t' '$2 == "done" { found = 1 } END { exit !found }' "$2" || { echo "cohort: every case failed: see $2" >&2; exit 1; }
  exit 0
fi
if [ "$1" = run ]; then
  status=$2 log=$3
  shift 3
  if "$@" > "$log" 2>&1; then
    printf 'done\t\n' > "$status"
  else
    # What make misses, else the last line a program printed before make's own "*** [...] Error", else make's.
    reason=$({ grep -m 1 -E '^make.*No rule to make target' "$log" || grep -vE '^(make|set-up)' "$log" | grep -E '^[a-z0-9-]+: ' || cat "$log"; } |
      tail -n 1 | tr '\t' ' ')
    printf 'failed\t%s\n' "${reason:-see $log}" > "$status"
  fi
  exit 0
fi
runs=$2
shift 2
printf 'case\tstatus\tvolume_ml\tmin_scaled_jacobian\tsupine_nipple_mm\tsupine_tumour_mm\ttumour\tcc_thickness_mm\tcc_force_N\tmlo_thickness_mm\tmlo_force_N\tseconds\treason\n'
for case in "$@"; do
  IFS=$'\t' read -r status reason < "$runs/$case.status" || true
  run=$runs/$case
  moved() { # LANDMARK: its supine displacement
    local value=
    [ ! -s "$run/displacements.tsv" ] || value=$(cell "$run/displacements.tsv" supine.vtkhdf "$1_mm")
    printf '%s' "${value:--}"
  }
  of() { rounded "$3" "$(key "$run/$1.json" "$2")"; }  # STAGE NAME DIGITS
  seconds=0
  for report in "$run"/*.json; do seconds=$(awk -v a="$seconds" -v b="$(number "$report" total)" 'BEGIN { print a + b }'); done
  printf '%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\n' "$case" "$status" "$(of mesh volume_ml 0)" \
    "$(of mesh min_scaled_jacobian 2)" "$(moved nipple)" "$(moved tumour)" "$(tumour_origin "$run/mesh.json")" \
    "$(of cc thickness_mm 1)" "$(of cc force_N 1)" "$(of mlo thickness_mm 1)" "$(of mlo force_N 1)" \
    "$(rounded 0 "$seconds")" "${reason:--}"
done
