#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Generated tables in a page: between the lines `<!-- table FILE -->` and `<!-- end of table -->` stands FILE (TSV, from the
# repository's top), as Markdown.
#   validation.sh fill PAGE...     writes them anew
#   validation.sh check PAGE...    fails, naming the table, where page and file differ or a file has no place in a page
#   validation.sh numbers          fails where a number of docs/numbers.tsv is another in the page than in its source
#   validation.sh truth TRUTH.tsv  rows of a table of errors against the truth, as the page shows them
set -euo pipefail
export LC_ALL=C
what=$1
shift
if [ "$what" = truth ]; then
  awk -F'\t' -v OFS='\t' '
    /^#/ { next }
    !header { header = 1; for (i = 1; i <= NF; i++) at[$i] = i
      print "landmark", "imaged error", "stress-free error", "of", "supine error", "of"; next }
    $1 == "mean" || $1 == "largest" || $1 == "nipple" || $1 == "true-tumour" {
      line = $1
      count = split("prone_error_mm stress_free_error_mm stress_free_true_mm supine_error_mm supine_true_mm", name, " ")
      for (k = 1; k <= count; k++) line = line OFS (at[name[k]] ? sprintf("%.2f", $at[name[k]]) : "-")
      print line }' "$1"
  exit 0
fi
if [ "$what" = numbers ]; then
  number_in() { # FILE-OR-FOLDER PATTERN: the first number that the pattern's group finds
    grep -rhE -- "$2" "$1" | sed -nE "s#.*$2.*#\\1#p" | sed -n 1p
  }
  bad=0
  while IFS=$'\t' read -r page page_pattern source source_pattern; do
    case "$page" in '#'* | page) continue ;; esac
    stated=$(number_in "$page" "$page_pattern") || true
    decided=$(number_in "$source" "$source_pattern") || true
    [ -n "$stated" ] && [ "$stated" = "$decided" ] || {
      echo "$page says '${stated:-nothing}' for $page_pattern; $source has '${decided:-nothing}' for $source_pattern" >&2
      bad=1
    }
  done < docs/numbers.tsv
  exit $bad
fi
# The page with its tables as the files have them.
filled() {
  awk '
    function table(file,    line, cells, n, i, rule, rows) {
      while ((getline line < file) > 0) {
        if (line ~ /^#/) continue
        n = split(line, cells, "\t")
        printf "|"
        for (i = 1; i <= n; i++) printf " %s |", cells[i]
        printf "\n"
        if (!rows++) { rule = "|"; for (i = 1; i <= n; i++) rule = rule "---|"; print rule }
      }
      close(file)
      if (!rows) { print "no table " file > "/dev/stderr"; exit 1 }
    }
    /^<!-- table [^ ]+ -->$/ { print; print ""; table($3); print ""; inside = 1; next }
    /^<!-- end of table -->$/ { inside = 0 }
    !inside { print }
    END { if (inside) { print "a table has no end" > "/dev/stderr"; exit 1 } }' "$1"
}
status=0
for page in "$@"; do
  filled "$page" > "$page.part"
  if [ "$what" = fill ]; then
    cmp -s "$page" "$page.part" || { cat "$page.part" > "$page"; echo "$page: tables written" >&2; }
  elif ! diff "$page" "$page.part" >&2; then
    echo "$page: its tables are not those of docs/tables: make -f Makefile.pipeline validation-page" >&2
    status=1
  fi
  rm -f "$page.part"
done
if [ "$what" = check ]; then
  for file in docs/tables/*.tsv; do
    grep -qF -- "<!-- table $file -->" "$@" || { echo "$file: stands in no page" >&2; status=1; }
  done
fi
exit $status
