#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Prints a place x,y,z (mm) of a landmark from a stage's JSON report: landmark.sh REPORT NAME [imaged|position]
set -euo pipefail
export LC_ALL=C
awk -v name="\"$2\":" -v place="\"${3:-imaged}\":" '
  /"landmarks":/ { inside = 1 }
  inside && ($1 == name || $1 == "\"artificial_" substr(name, 2)) { found = 1 }
  found && $1 == place { take = 1; sub(/.*\[/, "") }
  take { gsub(/[^0-9eE+.,-]/, ""); text = text $0 }
  take && (split(text, parts, ",") >= 3 && parts[3] != "") && text !~ /,$/ { print parts[1] "," parts[2] "," parts[3]; exit }
' "$1" | grep . || { echo "$1: has no landmark '$2'" >&2; exit 1; }
