#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# "; did you mean X?" for the candidate that a slip of the fingers turns into WORD, nothing when none is near, or where nothing is
# built yet: suggest.sh WORD CANDIDATE...
here=$(dirname "$0")
for tabulate in "$here/../build/release/bin/tabulate" "$here/../../../libexec/breast/tabulate"; do
  [ ! -x "$tabulate" ] || exec "$tabulate" nearest "$@" --quiet
done
