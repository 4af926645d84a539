#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# threads.sh [alone]: threads for one recipe: cores divided by the jobs make runs at once (read from MAKEFLAGS); with `alone`, all cores.
jobs=$([ "${1:-}" = alone ] || sed -n 's/.*-j\([0-9][0-9]*\).*/\1/p' <<< "${MAKEFLAGS:-}")
threads=$(($(nproc) / ${jobs:-1}))
echo $((threads > 0 ? threads : 1))
