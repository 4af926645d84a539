# SPDX-License-Identifier: GPL-3.0-or-later
# Text and tables for pages that can be sent: every byte of input is escaped. The scripts beside this one source it.
escape() { sed "s/&/\&amp;/g; s/</\&lt;/g; s/>/\&gt;/g; s/\"/\&quot;/g; s/'/\&#39;/g"; }
escaped() { printf '%s' "$1" | escape; }  # TEXT, of a name that may hold anything
# A TSV as a table; cells "fails", "differs", "missing" and "failed" stand out.
table() {
  [ -s "$1" ] || [ -p "$1" ] || return 0
  escape < "$1" | awk -F'\t' '
    /^#/ { next }
    !n++ { print "<table><tr>"; for (i = 1; i <= NF; i++) { gsub("_", " ", $i); print "<th>" $i "</th>" } print "</tr>"; next }
    { line = "<tr>"
      for (i = 1; i <= NF; i++) line = line ($i ~ /^(fails|differs|missing|failed)$/ ? "<td class=bad>" : $i ~ /^[-+0-9.eE]+$/ ? "<td class=n>" : "<td>") $i "</td>"
      print line "</tr>" }
    END { if (n) print "</table>" }'
}
