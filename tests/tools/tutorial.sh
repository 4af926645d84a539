#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# tutorial.sh PAGE.md PROGRAM_FOLDER: runs the fenced `sh` blocks of a page as written and in order, in one empty folder
# and one shell that stops at the first failure, with the programs on the PATH.
set -euo pipefail
page=$(realpath "$1")
programs=$(realpath "$2")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# Each block announces its line, so that a failure names it.
awk -v page="$(basename "$page")" '
  /^```sh[[:space:]]*$/ { inside = 1; printf "echo \"%s, line %d\" >&2\n", page, NR; next }
  /^```/ { inside = 0; next }
  inside' "$page" > "$work/script"
grep -q . "$work/script" || { echo "$page: no block marked sh" >&2; exit 1; }
mkdir "$work/here"
cd "$work/here"
# `breast run` takes these programs too, and builds none.
export INSTALLED="$programs"
export PATH="$programs:$PATH" OPENBLAS_THREAD_TIMEOUT="${OPENBLAS_THREAD_TIMEOUT:-4}" GOMP_SPINCOUNT="${GOMP_SPINCOUNT:-1000}"
bash -eu -o pipefail "$work/script" || { echo "$(basename "$page"): the block above failed" >&2; exit 1; }
echo "$(basename "$page"): $(grep -c '^```sh' "$page") blocks run"
