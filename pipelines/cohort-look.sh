#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What of a finished or broken-off case asks for a look, a line each: cohort-look.sh RUN WOMEN_TSV
set -euo pipefail
run=$1 women=$2
here=$(dirname "$0")
. "$here/values.sh"
below() { awk -v a="$1" -v b="$2" 'BEGIN { exit !(a != "" && a + 0 < b) }'; }  # A B
warnings=$("$here/warnings.sh" "$run" | wc -l)
[ "$warnings" -eq 0 ] || echo "$warnings warnings"
# segment's own grades, 0 to 1.
if [ -s "$run/labels.json" ]; then
  for part in contrast wall extent tissue; do
    grade=$(sed -n '/^  "quality"/,/^  }/p' "$run/labels.json" | sed -n "s/^ *\"$part\": \([-+0-9.e]*\),\{0,1\}$/\1/p")
    ! below "$grade" 0.5 || echo "quality of $part $(rounded 2 "$grade")"
  done
fi
! below "$(key "$run/mesh.json" min_scaled_jacobian)" 0.1 || echo "element shape $(rounded 2 "$(key "$run/mesh.json" min_scaled_jacobian)")"
for view in cc mlo; do
  [ ! -s "$run/$view.json" ] || [ "$(key "$run/$view.json" status)" = converged ] || echo "${view^^} $(key "$run/$view.json" status)"
done
# Motion from prone to supine farther than two standard deviations from the mean of living women: the first of the table.
[ -s "$run/motion.tsv" ] || exit 0
awk -F'\t' '/^#/ { next } FNR == NR { mean[$1] = $2; sd[$1] = $3; next } !n++ { for (i = 1; i <= NF; i++) name[i] = $i; next }
  { for (i = 1; i <= NF; i++) if (sd[name[i]] > 0 && $i == $i + 0 && ($i - mean[name[i]]) ^ 2 > 4 * sd[name[i]] ^ 2 && !far++)
      first = name[i] " " $i " (women " mean[name[i]] ", sd " sd[name[i]] ")" }
  END { if (far) print first (far > 1 ? " and " far - 1 " more" : "") }' "$women" "$run/motion.tsv"
