#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What became of every stage of a study's variants: study.sh FOLDER PROBE LANDMARKS VARIANT...
# A row a report FOLDER/VARIANT/STAGE.json: its status, why it ended early, elements, CPU seconds, and for a shape how far its
# landmarks are from their imaged places, mm.
set -euo pipefail
. "$(dirname "$0")/values.sh"
folder=$1 probe=$2 landmarks=$3
shift 3
printf 'variant\tstage\tstatus\treason\telements\tcpu_seconds'
printf '\t%s_mm' ${landmarks//,/ }
printf '\n'
for variant in "$@"; do
  for stage in labels geometry mesh reference supine cc mlo curve slopes; do
    report=$folder/$variant/$stage.json shape=$folder/$variant/$stage.vtkhdf
    [ -s "$report" ] || continue
    reason=$(key "$report" reason || true) elements=$(number "$report" elements)
    printf '%s\t%s\t%s\t%s\t%s\t%s' "$variant" $stage "$(key "$report" status)" "${reason:--}" "${elements:--}" "$(rounded 2 "$(number "$report" cpu_seconds)")"
    case $stage in reference | supine | cc | mlo) ;; *) shape= ;; esac
    moved=
    [ -z "$shape" ] || [ ! -s "$shape" ] || moved=$("$probe" "$shape" --landmarks "$landmarks" --quiet)
    for landmark in ${landmarks//,/ }; do
      place=$([ -z "$moved" ] || cell - $stage.vtkhdf ${landmark}_mm <<< "$moved")
      printf '\t%s' "${place:--}"
    done
    printf '\n'
  done
done
