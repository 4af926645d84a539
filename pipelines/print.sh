#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A page as PDF, printed by a headless Chromium with a profile of its own: print.sh CHROMIUM PAGE.html OUT.pdf
set -euo pipefail
export LC_ALL=C
browser=$1 page=$(realpath "$2") out=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# The browser's sandbox stays on wherever it can; it refuses to start with it as root. The page itself forbids scripts (its content
# security policy; Chromium 156 prints nothing when told to switch them off), and no network is reachable.
sandbox=()
[ "$(id -u)" -ne 0 ] || sandbox=(--no-sandbox)
timeout 120 "$browser" --headless "${sandbox[@]}" --proxy-server=127.0.0.1:9 --disable-gpu --disable-dev-shm-usage --user-data-dir="$work/profile" \
  --no-pdf-header-footer --print-to-pdf="$work/out.pdf" "file://$page" > "$work/log" 2>&1 || { cat "$work/log" >&2; exit 1; }
[ -s "$work/out.pdf" ] || { echo "print: $browser made no PDF of $page" >&2; cat "$work/log" >&2; exit 1; }
cp "$work/out.pdf" "$out.part"
mv "$out.part" "$out"
