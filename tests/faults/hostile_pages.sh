#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# tabulate, which writes pages and summaries, given reports, tables and settings whose every text could be markup, a command or
# a terminal's escape: none of it stands unescaped in the page, none is run, no folder is named. hostile_pages.sh [BIN]
set -euo pipefail
bin=$(realpath "${1:-$(dirname "$0")/../../build/release/bin}")
cd "$(dirname "$0")/../.."
pipelines=$PWD/pipelines
export LC_ALL=C
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "FAIL: $1"; exit 1; }
secret=/home/somebody/secret
corpus=('</script><script>alert(1)</script>' '"><img src=x onerror=alert(1)>' "' onload='alert(1)" '--><b>&lt;' ']]><b>'
  '</title></td></table>' '$(touch executed)`touch executed`' $'caf\xe9 \xff\xfe' $'\xe2\x80\xa8alert(1)' '%s%n%d' '\n\\1&')
json() { sed 's/\\/\\\\/g; s/"/\\"/g' <<< "$1"; }

run=
# Every report, table and setting that it reads, with TEXT wherever a text stands.
fill() { # TEXT
  local text=$1 stage name table
  rm -rf "$work/runs"
  name=${text//\//_}
  run="$work/runs/${name:0:60}"
  mkdir -p "$run/tables" "$run/leaveout" "$run/cost" "$run/budget" "$run/figures" "$work/runs/stability" "$work/runs/compare"
  for stage in labels geometry mesh reference supine cc mlo cc-mammogram mlo-mammogram curve lookup; do
    printf '{\n  "tool": "%s",\n  "status": "%s",\n  "tumour": "%s",\n  "blas": "%s",\n  "thickness_mm": 41.5,\n  "reduction_percent": 15,\n  "warnings": [\n    "%s"\n  ],\n  "seconds": {\n    "total": 1.5\n  },\n  "peak_mb": 10\n}\n' \
      "$stage" "$(json "$text")" "$(json "$text")" "$(json "$text")" "$(json "$stage $text")" > "$run/$stage.json"
  done
  for table in displacements cut truth truth-cut-fixed verify curve tables/table2 tables/table3 tables/table3-as-printed tables/table4 tables/table5 \
    tables/table6 tables/table7 tables/table8 tables/conclusions tables/findings leaveout/table leaveout/recommendation "cost/$name" \
    budget/budget ../stability/summary ../stability/mechanics ../compare/all; do
    printf 'name\t%s\n%s\t1\nnipple\t%s\nmean\t2\n' "$text" "$text" "$text" > "$run/$table.tsv"
  done
  printf '%s/build/bin/segment %s/scan.nrrd %s --side left\n' "$secret" "$secret" "$text" > "$run/.labels.settings"
  printf '%s --x\n' "$text" > "$run/.$name.settings"
}

bytes_of_page() { tr -d '\n' < "$1"; }
for text in "${corpus[@]}"; do
  fill "$text"
  (cd "$work" && "$bin/tabulate" report "$run" "$work/runs" --quiet --pipelines "$pipelines" > "$work/page.html" 2> "$work/err") ||
    { cat "$work/err"; fail "a page of a case with the text: $text"; }
  page=$(bytes_of_page "$work/page.html" | tr -d '\0')
  case "$text" in
    *[\<\>\"\']*) case "$page" in *"$text"*) fail "the page holds $text as it is" ;; esac ;;
  esac
  ! grep -aqi '<script\|<img src=x\|<b>&lt;\|</title></td>' "$work/page.html" || fail "the page has the markup of $text"
  ! grep -aqF "$secret" "$work/page.html" || fail "the page names a folder"
  ! grep -aqF "$work" "$work/page.html" || fail "the page names its own folder"
  [ ! -e "$work/executed" ] || fail "$text was run"
  (cd "$work" && "$bin/tabulate" summary "$run" --quiet --pipelines "$pipelines" > "$work/summary.txt" 2> "$work/err") ||
    { cat "$work/err"; fail "a summary of a case with the text: $text"; }
  [ ! -e "$work/executed" ] || fail "$text was run by the summary"
done
echo "passed: ${#corpus[@]} hostile texts in every page and summary"
