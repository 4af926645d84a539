#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Checks that every C++ file is as clang-format 14 writes it by .clang-format. Prints the files that are not.
set -eu
cd "$(dirname "$0")/../.."
program=$(command -v clang-format-14 || command -v clang-format || true)
case "$("${program:-false}" --version 2>&1 || true)" in
  *" 14."*) ;;
  *)
    echo "clang-format 14 is not installed: apt-get install clang-format (pipelines/packages.txt)"
    exit 1
    ;;
esac
differing=$(find libbreast tools tests -name '*.?pp' -print0 | xargs -0 -n 50 "$program" --dry-run 2>&1 |
  sed -n 's/^\([^ :]*\):[0-9]*:[0-9]*: warning: .*/\1/p' | sort -u)
if [ -n "$differing" ]; then
  printf '%s\n' "$differing"
  echo "not as clang-format writes them; run: clang-format -i FILE..."
  exit 1
fi
