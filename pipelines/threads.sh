#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Threads for one recipe: cores divided by the jobs make runs at once (read from MAKEFLAGS).
cores=$(nproc)
jobs=$(sed -n 's/.*-j\([0-9][0-9]*\).*/\1/p' <<< "${MAKEFLAGS:-}")
threads=$((cores / ${jobs:-1}))
echo $((threads > 0 ? threads : 1))
