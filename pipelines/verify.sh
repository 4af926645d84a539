#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Compares a run with expected values: verify.sh EXPECTED.tsv RUN
# Rows of EXPECTED: file (below RUN), row (value of the file's first column; "-" for a report), column (or top-level
# key of a .json report), expected, tolerance. Prints the same with the computed value and a verdict; exit 1 when
# one lies outside its tolerance or is missing.
# verify.sh --write EXPECTED.tsv RUN prints EXPECTED.tsv with the run's values where they differ.
set -euo pipefail
write=0
if [ "$1" = --write ]; then write=1; shift; fi
expected=$1 run=$2
. "$(dirname "$0")/values.sh"
value_of() { # FILE ROW COLUMN
  [ -s "$run/$1" ] || return 0
  case "$1" in
    *.json) key "$run/$1" "$3" ;;
    *) cell "$run/$1" "$2" "$3" ;;
  esac
}
failed=0
[ $write -eq 1 ] || printf 'file\trow\tcolumn\texpected\tcomputed\ttolerance\tverdict\n'
while IFS=$'\t' read -r file row column value tolerance; do
  case "$file" in '#'*|file|'') [ $write -eq 1 ] && printf '%s\n' "$file${row:+	$row	$column	$value	$tolerance}"; continue ;; esac
  computed=$(value_of "$file" "$row" "$column")
  verdict=$(awk -v a="$value" -v b="$computed" -v t="$tolerance" 'function number(x) { return x ~ /^[-+]?[0-9]*\.?[0-9]+([eE][-+]?[0-9]+)?$/ }
    BEGIN { if (number(a) && number(b)) { d = a - b; print (d <= t && -d <= t) ? "ok" : "differs" }
            else print (b != "" && a == b) ? "ok" : (b == "" ? "missing" : "differs") }')
  if [ $write -eq 1 ]; then  # what already agrees keeps its value, so that a bound stays a bound
    [ "$verdict" = ok ] || value=${computed:--}
    printf '%s\t%s\t%s\t%s\t%s\n' "$file" "$row" "$column" "$value" "$tolerance"
    continue
  fi
  [ "$verdict" = ok ] || failed=$((failed + 1))
  printf '%s\t%s\t%s\t%s\t%s\t%s\t%s\n' "$file" "$row" "$column" "$value" "${computed:--}" "$tolerance" "$verdict"
done < "$expected"
[ $write -eq 1 ] || [ $failed -eq 0 ] || { echo "$failed values differ from $expected" >&2; exit 1; }
