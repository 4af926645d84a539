#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# gallery.sh PROGRAMS RUN SCAN PAGE.md : the pictures of a page, by the commands that it shows (`render ... -o NAME.png`), run in a copy of
# the folder RUN beside the scan of a phantom, and scaled to 900 pixels for the page, into the folder PAGE.
set -eu
programs=$(realpath "$1") run=$(realpath "$2") scan=$(realpath "$3") page=$(realpath "$4")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/phantom"
ln -s "$scan" "$work/phantom/"
cp -r "$run" "$work/run"
out=${page%.md}
mkdir -p "$out"
cd "$work/run"
PATH="$programs:$PATH"
sed -n 's/^    render /render /p' "$page" > "$work/commands"
while read -r command; do
  eval "$command" < /dev/null
  name=${command##*-o }
  pngtopam "$name" | pamscale -xsize 900 | pnmquant -quiet 128 | pnmtopng -quiet -compression 9 > "$out/$name"
done < "$work/commands"
