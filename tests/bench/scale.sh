#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The rows of docs/tables/scale.tsv: the gravity block of N³ elements by the serial tool and by processes.
#   scale.sh PROGRAM_FOLDER N[:TOOL[:RANKS]]...     for example build/release/bin 24 48:backward 96:forward:1
# TOOL: forward, backward or both (default); RANKS: a number, or 1 and 2 (default). Rows go to stdout.
# Without SERIAL=no the serial tool runs first, for the difference. Meshes lie in a temporary folder.
set -euo pipefail
bin=$(cd "$1" && pwd)
shift
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 GOMP_SPINCOUNT=1000
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
row() { # WHAT REPORT DIFFERENCE
  python3 - "$@" <<'END'
import json, sys
what, report, difference = sys.argv[1:]
j = json.load(open(report))
newton, krylov = j["newton_iterations"], j["linear_iterations"]
print(what, j["elements"], j["unknowns"], newton, j["factorisations"], krylov, f"{krylov / newton:.1f}",
      f"{j['cpu_seconds']:.0f}", f"{j['seconds']['total']:.0f}", f"{j['peak_mb']:.0f}", difference, sep="\t")
END
}
difference() { # ONE OTHER: largest difference of a coordinate, mm
  /usr/bin/python3 -c 'import h5py, sys
a, b = (h5py.File(f)["VTKHDF/Points"][:] for f in sys.argv[1:])
print(f"{abs(a - b).max():.1g}")' "$1" "$2"
}
printf 'solve\telements\tunknowns\tnewton_iterations\tset_ups\tgmres_iterations\tgmres_a_step\tcpu_s\twall_s\tpeak_mb\tfrom_serial_mm\n'
for what in "$@"; do
  IFS=: read -r n tools ranks <<< "$what::"
  case "$tools" in '' | both) tools="forward backward" ;; esac
  ranks=${ranks%%:*}
  "$bin/block_mesh" "$n" block.vtkhdf
  for tool in $tools; do
    if [ "${SERIAL:-yes}" = yes ]; then
      "$bin/$tool" block.vtkhdf serial.vtkhdf --materials seed2008 --gravity 0,0,-9810 --estimate none --threads 1 --solver multigrid \
        --quiet --report serial.json
      row "$tool" serial.json ""
    fi
    for count in ${ranks:-1 2}; do
      mpirun --oversubscribe -n "$count" "$bin/$tool-mpi" block.vtkhdf "$count.vtkhdf" --materials seed2008 --gravity 0,0,-9810 --quiet \
        --report "$count.json"
      far=
      [ "${SERIAL:-yes}" != yes ] || far=$(difference serial.vtkhdf "$count.vtkhdf")
      row "$tool-mpi, $count" "$count.json" "$far"
    done
  done
done
