# SPDX-License-Identifier: GPL-3.0-or-later
"""Solves beside finer ones and beside those of another program: convergence of the compressed shapes, a block solved by CalculiX."""
from __future__ import annotations

from pathlib import Path

from breast.errors import BreastError
from breast.study.kinds import Request, kind
from breast.study.shapes import apart
from breast.study.stage_report import StageReport
from breast.study.table import NO_VALUE, Row, Table, fixed, general, or_dash
from breast.text_table import parse_number


def convergence_table(folder: Path, meshes: list[str]) -> Table:
    """Convergence of compressed shapes: one row a mesh, the variant FOLDER/N with its stages cc and mlo.

    Distance in mm of tumour and nipple from those of the last N, the solver's own error estimate at the tumour, mm, forces of paddle
    and detector, N, and reduction of the thickness, per cent. "-": not reached.
    """
    quantities = ("tumour_mm", "tumour_estimate_mm", "nipple_mm", "paddle_N", "detector_N", "reduction_percent")
    table = Table(["N", "elements", *(f"{view}_{quantity}" for view in ("CC", "MLO") for quantity in quantities)])
    for n in meshes:
        row = [n, or_dash(StageReport.read(folder / n / "mesh.json").text("elements"))]
        for view in ("cc", "mlo"):
            row += _converging_view(folder / n / f"{view}.vtkhdf", folder / meshes[-1] / f"{view}.vtkhdf")
        table.rows.append(row)
    return table


def _converging_view(file: Path, finest: Path) -> Row:
    if not file.exists():
        return [NO_VALUE] * 6
    report = StageReport.read(file.with_suffix(".json"))
    tumour, nipple = (fixed(apart(file, finest, name), 2) if finest.exists() else NO_VALUE for name in ("tumour", "nipple"))
    estimate = report.number(f"landmarks/{report.landmark('tumour')}/error_estimate_mm")
    forces = [fixed(report.number(key), decimals) for key, decimals in
              (("force_N", 1), ("detector_force_N", 1), ("reduction_percent", 0))]
    return [tumour, fixed(estimate, 2), nipple, *forces]


@kind("convergence", "FOLDER N...", "distances of the compressed shapes FOLDER/N-CC and N-MLO from those of the last N")
def _convergence(request: Request) -> Table:
    return convergence_table(request.path(0), request.rest(1))


def pressed_table(ours: Table, scene: str, gap: float, reached: float, force: str, iterations: int, cpu: float) -> Table:
    """A block pressed between plates: CalculiX's result beside the output of bench_pressed_block.

    The last row of that output is the requested state; its seconds and iterations are the sums over all rows.

    Args:
        gap: requested, in per cent of the block's height.
        reached: fraction of the plates' motion that CalculiX reached, 0 to 1.
        force: on the upper plate, N, as printed.
    """
    if not ours.rows:
        raise BreastError("has no rows", ours.name)
    rows = range(len(ours.rows))
    newton, seconds = (sum(ours.number(r, column) for r in rows) for column in ("newton", "cpu_seconds"))
    return Table(
        ["scene", "gap_percent", "ccx_reached_gap_percent", "ccx_force_N", "our_force_N", "ccx_iterations", "our_newton",
         "ccx_cpu_s", "our_cpu_s", "ccx_over_ours", "ours"],
        [[scene, general(gap), fixed(100 - reached * (100 - gap), 1), force, ours.cell(rows[-1], "force_N"), str(iterations),
          general(newton), fixed(cpu, 2), fixed(seconds, 2), fixed(cpu / seconds, 1) if seconds > 0 else NO_VALUE,
          ours.cell(rows[-1], "status")]])


@kind("pressed", "OURS.tsv SCENE GAP REACHED FORCE ITERATIONS SECONDS",
      "block pressed between plates: CalculiX (results given as arguments) beside ours")
def _pressed(request: Request) -> Table:
    gap, reached, iterations, seconds = (parse_number(request.word(n), "pressed") for n in (2, 3, 5, 6))
    return pressed_table(request.table(0), request.word(1), gap, reached, request.word(4), int(iterations), seconds)
