#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Prone to supine with given mechanics: posture-change.sh MESH NAME BACKWARD FORWARD MECHANICS...
# writes NAME-reference.vtkhdf and NAME-supine.vtkhdf with their reports. Where a solve does not converge, the reason
# stays in NAME.failed: a finding, not an error.
set -euo pipefail
export LC_ALL=C
attempt=$(dirname "$0")/attempt.sh
mesh=$1 name=$2 backward=$3 forward=$4
shift 4
rm -f "$name-supine.vtkhdf" "$name".failed
"$attempt" "$name-reference" "$backward" "$mesh" --posture prone "$@"
"$attempt" "$name-supine" "$forward" "$name-reference.vtkhdf" --posture supine "$@"
if [ -f "$name-supine.failed" ]; then mv "$name-supine.failed" "$name.failed"; fi
rm -f "$name-reference.failed"
