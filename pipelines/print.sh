#!/usr/bin/env bash
# A page as PDF, printed by a headless Chromium with a profile of its own: print.sh CHROMIUM PAGE.html OUT.pdf
set -euo pipefail
browser=$1 page=$(realpath "$2") out=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
timeout 120 "$browser" --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --user-data-dir="$work/profile" \
  --no-pdf-header-footer --print-to-pdf="$work/out.pdf" "file://$page" > "$work/log" 2>&1 || { cat "$work/log" >&2; exit 1; }
[ -s "$work/out.pdf" ] || { echo "print: $browser made no PDF of $page" >&2; cat "$work/log" >&2; exit 1; }
cp "$work/out.pdf" "$out.part"
mv "$out.part" "$out"
