#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Checks all Python files for undefined names, imports that are not used, and style: with ruff (ruff.toml) where it is installed,
# otherwise with flake8 (.flake8). Prints one line a finding; exit 1 when there is any.
set -eu
cd "$(dirname "$0")/../.."
if command -v ruff > /dev/null; then
  check="ruff check --quiet --no-cache"
  input=--stdin-filename
elif command -v flake8 > /dev/null; then
  check=flake8
  input=--stdin-display-name
else
  echo "neither ruff nor flake8 is installed: apt-get install flake8 (pipelines/packages.txt)"
  exit 1
fi

# With a configuration that leaves one of these faults out, all files would pass.
must_find() { # CODE PROGRAM
  printf '%s\n' "$2" | $check "$input" faulty.py - 2>&1 | grep -q "$1" && return
  echo "${check%% *} does not find the fault $1 in: $2"
  exit 1
}
must_find F401 "import os"
must_find F821 "print(undefined)"
must_find E501 "text = '$(printf '%0150d' 0)'"

find docs python tests -name '*.py' -print0 | xargs -0 $check || exit 1
