#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# cohort.sh run STATUS LOG KIND COMMAND...  runs a case; STATUS says "done", or "failed" and why; while it runs, "running"
# cohort.sh any-done TABLE           fails when no case of it is done
# cohort.sh strange COHORT           one line naming a case file or folder with characters that make or a shell would read
#                                    as code; nothing when there is none
set -euo pipefail
export LC_ALL=C
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
  grep -qE $'^[^\t]*\tdone(\t|$)' "$2" || { echo "cohort: every case failed: see $2" >&2; exit 1; }
  exit 0
fi

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
