#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# docs-current.sh [--write] PROGRAM_FOLDER: compares docs/tools/NAME.md, docs/man/NAME.1 and docs/pairs.md with what the
# built tools say of themselves; exit 1 and a diff when they differ. --write brings them up to date.
set -eu
write=no
if [ "${1:-}" = --write ]; then
  write=yes
  shift
fi
root=$(cd "$(dirname "$0")/../.." && pwd)
programs=${1:-$root/build/release/bin}
if [ ! -d "$programs" ]; then
  echo "docs-current.sh: $programs does not exist; build first or name the folder of programs" >&2
  exit 2
fi
fresh=$(mktemp -d)
trap 'rm -rf "$fresh"' EXIT
mkdir "$fresh/tools" "$fresh/man"
# A tool has a file tools/NAME.cpp, or is a launcher of Python.
launchers=$(sed -n 's/^breast_launcher(\([a-z0-9-]*\) .*/\1/p' "$root/tools/CMakeLists.txt" "$root/cmake/command.cmake")
is_tool() { [ -f "$root/tools/$1.cpp" ] || echo "$launchers" | grep -qx "$1"; }
set --
for program in "$programs"/*; do
  [ -x "$program" ] && is_tool "$(basename "$program")" && set -- "$@" "$program"
done
"$root/tests/tools/help_pages.py" "$fresh" "$@"
# The table of the files that must belong together.
if [ -x "$programs/pairs" ]; then
  "$programs/pairs" all > "$fresh/pairs.md"
else
  cp "$root/docs/pairs.md" "$fresh"
fi
if [ "$write" = yes ]; then
  mkdir -p "$root/docs/tools" "$root/docs/man"
  # Pages of tools that no longer exist go; those of tools not built here stay.
  for page in "$root"/docs/tools/*.md "$root"/docs/man/*.1; do
    name=$(basename "${page%.*}")
    is_tool "$name" || rm -f "$page"
  done
  cp "$fresh/pairs.md" "$root/docs/"
  cp "$fresh"/tools/*.md "$root/docs/tools/"
  cp "$fresh"/man/*.1 "$root/docs/man/"
  exit 0
fi
# Of a tool that is left out of this build, for want of a library, nothing is known.
for source in "$root"/tools/*.cpp; do
  name=$(basename "${source%.cpp}")
  [ ! -x "$programs/$name" ] && [ -f "$root/docs/tools/$name.md" ] || continue
  cp "$root/docs/tools/$name.md" "$fresh/tools/"
  cp "$root/docs/man/$name.1" "$fresh/man/"
done
status=0
diff -ru "$root/docs/tools" "$fresh/tools" || status=1
diff -ru "$root/docs/man" "$fresh/man" || status=1
diff -u "$root/docs/pairs.md" "$fresh/pairs.md" || status=1
[ $status = 0 ] || echo "docs are stale: run tests/tools/docs-current.sh --write $programs" >&2
exit $status
