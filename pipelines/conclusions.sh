#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Values of the paper's conclusions (pipelines/paper/conclusions.tsv), a line each: name, value ("-": no solution).
#   conclusions.sh rows TABLE3 TABLE4 TABLE5 TABLE6 [PREFIX]  slopes d ln u / d ln s between the rows of 90 and 110 per
#                                                            cent, from columns PREFIXnipple_mm, PREFIXtumour_mm
#   conclusions.sh slopes SLOPES TABLE6                      slopes as `sensitivity --table` wrote them
# Of TABLE6 the changes by a stiff tumour are taken.
set -euo pipefail
. "$(dirname "$0")/values.sh"
how=$1
shift
if [ "$how" = rows ]; then
  tables=("$1" "$2" "$3") stiff=$4 prefix=${5:-}
  slope() { # NUMBER-OF-TISSUE TISSUE LANDMARK
    awk -v low="$(cell "${tables[$1]}" 90 "$prefix$3_mm")" -v high="$(cell "${tables[$1]}" 110 "$prefix$3_mm")" \
      'BEGIN { if (low > 0 && high > 0) printf "%.4f", log(high / low) / log(110 / 90); else print "-" }'
  }
else
  slopes=$1 stiff=$2 prefix=
  [ -s "$slopes" ] || slopes=/dev/null  # a material without a stress-free body has none
  slope() {
    awk -F'\t' -v tissue="$2" -v landmark="$3" '{ sub(/^artificial_/, "", $1) } $1 == landmark && $2 == tissue { value = sprintf("%.4f", $7) }
      END { print (value == "" ? "-" : value) }' "$slopes"
  }
fi
change() { # PERCENT LANDMARK: relative to the 100 per cent row, per cent
  awk -v a="$(cell "$stiff" "$1" "$prefix$2_mm")" -v b="$(cell "$stiff" 100 "$prefix$2_mm")" \
    'BEGIN { if (a == "" || a == "-" || !(b > 0)) print "-"; else printf "%.3f", 100 * (a / b - 1) }'
}
tissues=(fat fibroglandular skin)
for landmark in nipple tumour; do
  for t in 0 1 2; do
    value[t]=$(slope $t "${tissues[$t]}" $landmark)
    printf '%s_%s\t%s\n' "${tissues[$t]}" $landmark "${value[$t]}"
  done
  awk -v name="order_$landmark" -v f="${value[0]}" -v g="${value[1]}" -v s="${value[2]}" 'function size(x) { return x < 0 ? -x : x }
    BEGIN { print name "\t" (f == "-" || g == "-" || s == "-" ? "-" : (size(f) > 3 * size(g) && size(g) > size(s)) ? 1 : 0) }'
done
printf 'tumour_1000\t%s\ntumour_2000\t%s\n' "$(change 1000 tumour)" "$(change 2000 nipple)"
