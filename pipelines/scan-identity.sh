#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Whose run a folder holds, so that two patients' scans never share one:
#   scan-identity.sh check RUN SIDE SCAN    one line saying why SCAN may not be run in RUN; nothing when it may
#   scan-identity.sh record RUN SIDE SCAN   remembers SCAN and SIDE in RUN/.scan
# SCAN is a file, a folder of slices, or phantom:PRESET. What is remembered is the SHA-256 of the content (of a phantom its
# name) and a stamp of its files (place on the disk, size, times), by which an unchanged scan is recognised without reading it
# again; no path. Size and time alone would not do: archives unpack two patients' slices with the same of both.
set -euo pipefail
export LC_ALL=C
what=$1 run=$2 side=$3 scan=$4
record=$run/.scan
stamp() {
  case "$scan" in phantom:*) echo "$scan"; return ;; esac
  if [ -d "$scan" ]; then (cd "$scan" && find -L . -type f -printf '%P %D %i %s %T@ %C@\n' | sort); else stat -L -c '%d %i %s %y %z' -- "$scan"; fi |
    sha256sum | cut -c1-64
}
content() {
  case "$scan" in phantom:*) echo "$scan"; return ;; esac
  if [ -d "$scan" ]; then (cd "$scan" && find -L . -type f -print0 | sort -z | xargs -0 sha256sum); else sha256sum < "$scan"; fi |
    sha256sum | cut -c1-64
}
if [ "$what" = record ]; then
  mkdir -p "$run"
  printf 'side\t%s\ncontent\t%s\nstamp\t%s\n' "$side" "$(content)" "$(stamp)" > "$record.part"
  mv "$record.part" "$record"
  exit 0
fi
case "$scan" in phantom:*) ;; *) [ -e "$scan" ] || exit 0 ;; esac  # make says that it is not there
[ -f "$record" ] || exit 0
remembered() { awk -F'\t' -v key="$1" '$1 == key { print $2; exit }' "$record"; }
if [ "$(remembered side)" != "$side" ]; then
  echo "$run holds the $(remembered side) breast of its scan: name this run otherwise, CASE=NAME, or remove that folder"
elif [ "$(remembered stamp)" != "$(stamp)" ] && [ "$(remembered content)" != "$(content)" ]; then
  echo "$run holds the run of another scan: name this one otherwise, CASE=NAME, or remove that folder if the scan itself was replaced"
fi
