#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# tables.sh BIN checks that other programs load the tables of docs/, and tables that the tools write for a small phantom, without
# options (tables.py). reproduce.sh checks the tables of a whole run.
set -euo pipefail
bin=$(realpath "$1")
cd "$(dirname "$0")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$bin/phantom" "$work/scan.nrrd" --preset small --coarse 4 --truth "$work/truth" --quiet
"$bin/phantom-mesh" "$work/mesh.vtkhdf" --supine "$work/supine.vtkhdf" --level 0.5 --preset small --side left --set "$work/set.tsv" --quiet
"$bin/probe" "$work/mesh.vtkhdf" "$work/supine.vtkhdf" --truth "$work/truth/landmarks.tsv" > "$work/truth.tsv"
"$bin/laws" seed2008 --curves > "$work/laws.tsv"
tests/tools/tables.py "$work" docs/tables
# The check must find these faults.
printf 'a_mm\tb\n1\tx\n# rows 1\n' > "$work/bad.tsv"
! tests/tools/tables.py "$work/bad.tsv" > "$work/said" || { echo "FAILED: a line that is no row is found"; exit 1; }
printf 'a_mm\tb\n1\tx\n-\ty\n' > "$work/bad.tsv"
! tests/tools/tables.py "$work/bad.tsv" > "$work/said" || { echo "FAILED: a word among numbers is found"; exit 1; }
