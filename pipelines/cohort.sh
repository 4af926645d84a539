#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# cohort.sh run STATUS LOG KIND COMMAND...  runs a case; STATUS says "done", or "failed" and why; while it runs, "running"
# cohort.sh results RUNS POPULATION  of all cases of RUNS/.cases: cohort.tsv (failures first), cost.tsv, motion.tsv, women.tsv, and the
#                                    pages cohort.html and contours.html
# cohort.sh any-done TABLE           fails when no case of it is done
# cohort.sh strange COHORT           one line naming a case file or folder with characters that make or a shell would read
#                                    as code; nothing when there is none
set -euo pipefail
here=$(dirname "$0")
. "$here/values.sh"
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
  status=$2 log=$3 kind=$4
  shift 4
  case=$(basename "${status%.status}")
  say() { printf '%s\t%s\n' "$1" "$2" > "$status.part"; mv "$status.part" "$status"; }
  # A task that was started again must not meet itself: its first node may only have been out of reach.
  exec 9> "$(dirname "$status")/.$case.lock"
  flock -n 9 || { echo "cohort: $case: another process works on it; waiting for it" >&2; flock 9; }
  trap 'say failed "stopped by a signal: cancelled, out of its time, or interrupted"; exit 1' TERM INT HUP XCPU
  say running ''
  # Cases of one phantom share its scan, which only one of them may make.
  shared() { [ "$kind" != phantom ] || flock "$(dirname "$status")/.phantoms.lock" "${@:1:$#-1}" phantom-scan; }
  if { shared "$@" && "$@"; } > "$log" 2>&1 9>&-; then
    say done ''
  else
    # What make misses, else the last line a program printed before make's own "*** [...] Error", else make's. Without folders: the
    # reason is the same wherever the case was run.
    reason=$({ grep -m 1 -E '^make.*No rule to make target' "$log" || grep -vE '^(make|set-up)' "$log" | grep -E '^[a-z0-9-]+: ' || cat "$log"; } |
      tail -n 1 | tr '\t' ' ' | sed -E "s/^make(\[[0-9]+\])?: \*\*\* //; s/\.  Stop\.\$//")
    reason=$(sed -E "s#(^|[] '\",=:(])[.]{0,2}/[^ '\",=:)]*/#\1#g" <<< "${reason//"$(dirname "$status")/"/}")
    reason=$(sed -E "s#^No rule to make target '(.*)', needed by .*#'\1', which a setting names, does not exist#" <<< "$reason")
    say failed "${reason:-nothing was said; see the log}"
  fi
  exit 0
fi

runs=$2 population=$3
list=$runs/.cases
table_header='case\tstatus\tvolume_ml\tmin_scaled_jacobian\tsupine_nipple_mm\tsupine_tumour_mm\ttumour\tcc_thickness_mm\tcc_force_N\tmlo_thickness_mm\tmlo_force_N\tlook\tlog\treason\n'
row() { # CASE
  local case=$1 run=$runs/$1 status=failed reason='never started' look=
  moved() { # LANDMARK: its supine displacement
    local value=
    [ ! -s "$run/displacements.tsv" ] || value=$(cell "$run/displacements.tsv" supine.vtkhdf "$1_mm")
    printf '%s' "${value:--}"
  }
  of() { rounded "$3" "$(key "$run/$1.json" "$2")"; }  # STAGE NAME DIGITS
  [ ! -f "$runs/$case.status" ] || IFS=$'\t' read -r status reason < "$runs/$case.status" || true
  [ "$status" != running ] || { status=failed; reason='ended without a word: killed, out of memory, or its node was lost; or it still runs'; }
  [ ! -d "$run" ] || look=$("$here/cohort-look.sh" "$run" "$here/invivo/women.tsv" | paste -s -d ';' | sed 's/;/; /g')
  printf '%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\n' "$case" "$status" "$(of mesh volume_ml 0)" \
    "$(of mesh min_scaled_jacobian 2)" "$(moved nipple)" "$(moved tumour)" "$(tumour_origin "$run/mesh.json")" \
    "$(of cc thickness_mm 1)" "$(of cc force_N 1)" "$(of mlo thickness_mm 1)" "$(of mlo force_N 1)" \
    "${look:--}" "$case.log" "${reason:--}"
}
cost() { # CASE: what its stages took, each as it last ran
  { cat "$runs/$1"/*.json 2> /dev/null || true; } | awk -v case="$1" '$1 == "\"total\":" { wall += $2 } $1 == "\"cpu_seconds\":" { cpu += $2 }
    $1 == "\"peak_mb\":" && $2 + 0 > peak { peak = $2 + 0 } $1 == "\"elements\":" && !n { n = $2 + 0 }
    END { printf "%s\t%d\t%.0f\t%.0f\t%.0f\n", case, n, wall, cpu, peak }'
}
motion() { # CASE: how its tissue moved, where its mesh has a wall to measure from; made again when the supine shape is newer
  local run=$runs/$1
  [ -s "$run/supine.vtkhdf" ] || { rm -f "$run/motion.tsv"; return; }
  [ "$run/motion.tsv" -nt "$run/supine.vtkhdf" ] || "$population" "$run/supine.vtkhdf" --table "$run/motion.tsv" --quiet 2> /dev/null || rm -f "$run/motion.tsv"
}
complete() { mv "$1.part" "$1"; }

shapes=()
while IFS=$'\t' read -r case file kind; do
  motion "$case"
  [ ! -s "$runs/$case/motion.tsv" ] || shapes+=("$runs/$case/supine.vtkhdf")
  row "$case"
done < "$list" > "$runs/.rows"
{ printf "$table_header"; awk -F'\t' '$2 != "done"' "$runs/.rows"; awk -F'\t' '$2 == "done"' "$runs/.rows"; } > "$runs/cohort.tsv.part"
complete "$runs/cohort.tsv"
rm -f "$runs/.rows"
{ printf 'case\telements\twall_seconds\tcpu_seconds\tpeak_mb\n'; while IFS=$'\t' read -r case file kind; do cost "$case"; done < "$list"; } > "$runs/cost.tsv.part"
complete "$runs/cost.tsv"
rm -f "$runs/motion.tsv" "$runs/women.tsv"
[ ${#shapes[@]} -eq 0 ] || "$population" "${shapes[@]}" --women "$here/invivo/women.tsv" --table "$runs/motion.tsv" --summary "$runs/women.tsv" --quiet
"$here/cohort-page.sh" cohort "$runs" > "$runs/cohort.html.part"
complete "$runs/cohort.html"
"$here/cohort-page.sh" contours "$runs" > "$runs/contours.html.part"
complete "$runs/contours.html"
