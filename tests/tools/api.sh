#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# api.sh FOLDER: makes the pages of the C++ headers (FOLDER/cpp, Doxygen) and of the Python package (FOLDER/python, Sphinx); a warning
# of either program is an error. Then checks that pages of some of both exist and state their units. Exit 77 if both are missing.
set -eu
mkdir -p "$1"
out=$(cd "$1" && pwd)
cd "$(dirname "$0")/../.."
missing=
command -v doxygen > /dev/null || missing="doxygen"
command -v sphinx-build > /dev/null || missing="$missing python3-sphinx"
if [ -n "$missing" ]; then
  echo "the API pages need Debian's" $missing "(pipelines/packages.txt): apt-get install" $missing
  [ "$missing" = "doxygen python3-sphinx" ] && exit 77
  exit 1
fi

rm -rf "$out/cpp" "$out/python" "$out/.modules"
{ cat docs/api/Doxyfile; printf 'OUTPUT_DIRECTORY = "%s"\nHTML_OUTPUT = cpp\n' "$out"; } | doxygen -

# The list of modules is made beside the pages, so that nothing is written to the source tree.
mkdir "$out/.modules"
cp docs/api/conf.py docs/api/index.rst "$out/.modules"
export PYTHONPATH="$PWD/python" PYTHONDONTWRITEBYTECODE=1
sphinx-apidoc -q --separate --module-first -o "$out/.modules" python/breast
sphinx-build -q -W --keep-going -b html "$out/.modules" "$out/python"
rm -rf "$out/.modules"

# has PAGE TEXT: the page exists and contains the text.
bad=0
has() {
  grep -qF -- "$2" "$out/$1" && return
  echo "$1: is missing, or does not contain '$2'"
  bad=1
}
has cpp/index.html 'stress is in Pa'
has cpp/files.html 'hexahedral breast mesh'
has cpp/structbreast_1_1MeshShape.html 'kPa per node'
has cpp/structbreast_1_1HexOutput.html 'µN'
has cpp/stress_8hpp.html 'Second Piola'
has cpp/structbreast_1_1MammogramHeader.html 'between the plates'
for name in $(python3 -c 'import breast; print(*(f"{breast._HOME[name]}.{name}" for name in breast.__all__))'); do
  has python/index.html "href=\"breast.${name%.*}.html#breast.$name\""
done
has python/breast.state.html '(N, 3) the shape in the scan'
has python/breast.state.html '(3) the point of the scan'
has python/breast.state.html 'kPa'
has python/breast.study.score.html 'moved_mm'
has python/breast.figures.states.html 'the breast as gravity turns'
# A shape such as (3) is no item of a list.
if grep -l '<ol [^>]*start=' "$out"/python/*.html; then
  echo "these pages show a shape as a numbered list"
  bad=1
fi
exit $bad
