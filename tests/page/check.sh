#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# check.sh PROGRAM_FOLDER RUN_FOLDER [PICTURES]: the page of a finished run in a real browser (Debian package
# chromium), without network: points at three places, compares what the page draws with cc2mlo, keeps
# screenshots in PICTURES. Not part of the tests: the browser is larger than everything else together.
set -euo pipefail
export LC_ALL=C
bin=$(cd "$1" && pwd) run=$(cd "$2" && pwd) pictures=${3:-}
command -v chromium >/dev/null || { echo "check.sh: install chromium" >&2; exit 2; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"$bin/tabulate" page "$run" --quiet > page.html
! grep -qE '(src|href)="?([^"d]|d[^a])|https?://|fetch\(|XMLHttpRequest' page.html || { echo "the page asks for more files" >&2; exit 1; }
sandbox=()
[ "$(id -u)" -ne 0 ] || sandbox=(--no-sandbox)  # as root it refuses to start with it
browser() {  # every network request would go to a closed port
  chromium --headless=new "${sandbox[@]}" --disable-gpu --user-data-dir="$work/profile" \
    --proxy-server=127.0.0.1:9 --window-size=1500,700 --hide-scrollbars --virtual-time-budget=3000 "$@" 2>/dev/null
}
status=0
for point in 30,50 20,90 45,40; do
  browser --dump-dom "file://$work/page.html#$point" > dom.txt
  [ -z "$pictures" ] || browser --screenshot="$pictures/page-$point.png" "file://$work/page.html#$point"
  "$bin/cc2mlo" "$run/cc-sensitivity.vtkhdf" "$run/mlo-sensitivity.vtkhdf" curve.vtp --point $point --quiet > table.tsv
  # Column length and chord of the page's curve against cc2mlo's, mm.
  sed -n 's/.*data-curve="\([^"]*\)".*/\1/p' dom.txt | tr ';' '\n' > curve.txt
  depth=$(sed -n 's/.*[,:] \([0-9.]*\) mm of tissue.*/\1/p' dom.txt)
  awk -F'\t' -v point=$point -v depth="$depth" '
    FILENAME == "curve.txt" { split($0, p, " "); if (!n++) { u = p[1]; v = p[2] } x = p[1]; y = p[2]; next }
    FNR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
    { chord = sqrt((x - u)^2 + (y - v)^2)
      ok = n == 25 && (chord - $column["chord_mm"])^2 < 0.5^2 && (depth - $column["column_mm"])^2 < 0.8^2
      printf "%s: chord %.2f (cc2mlo %.2f), column %.1f (%.1f): %s\n", point, chord, $column["chord_mm"],
        depth, $column["column_mm"], ok ? "ok" : "WRONG"
      exit !ok }' curve.txt table.tsv || status=1
done
exit $status
