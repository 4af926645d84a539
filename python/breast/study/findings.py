# SPDX-License-Identifier: GPL-3.0-or-later
"""The effect of numerical choices on the paper's results, and the comparison with results to which the phantom was fitted."""
from __future__ import annotations

import math
from pathlib import Path

from ..errors import BreastError
from .slopes import slope_cell
from .stage_report import StageReport, posture_failure_of, variant_of
from .table import NO_VALUE, Table, fixed, read_table

LANDMARKS = ("nipple", "tumour")


def moved_in(file: Path, landmark: str) -> float:
    """Distance in mm from the landmark's imaged position, according to a report."""
    report = StageReport.read(file)
    imaged, position = report.place(landmark, "imaged"), report.place(landmark, "position")
    if imaged is None or position is None:
        raise BreastError(f"has no landmark '{landmark}'", file)
    return math.dist(imaged, position)


def findings_table(run: Path, variants: list[str]) -> Table:
    """One row for the paper, the case as solved, and every variant of RUN/studies/findings, of which the last is the finest.

    Columns: displacements of nipple and tumour from the imaged position, stress-free and supine, mm; the difference of the supine
    displacements from the finest, per cent; the solver's own estimate of its error, mm; slopes with respect to fat.
    """
    table = Table(["model", "elements", "stress_free_nipple_mm", "stress_free_tumour_mm", "supine_nipple_mm", "supine_tumour_mm",
                   "nipple_from_finest_percent", "tumour_from_finest_percent", "estimate_mm", "fat_slope_nipple",
                   "fat_slope_tumour"],
                  [["paper", "4096", "4.5", "1.6", "8.78", "3.03", "-", "-", "-", "-0.607", "-0.705"]])
    best = variant_of(run, "findings", variants[-1])
    finest = [moved_in(best / "supine.json", landmark) if posture_failure_of(best) is None else None for landmark in LANDMARKS]
    table.rows.append(["default", *_finding(run, finest)])
    for variant in variants:
        folder = variant_of(run, "findings", variant)
        failed = posture_failure_of(folder) is not None
        table.rows.append([variant, *([NO_VALUE] * (len(table.columns) - 1) if failed else _finding(folder, finest))])
    return table


def _finding(folder: Path, finest: list[float | None]) -> list[str]:
    supine = [moved_in(folder / "supine.json", landmark) for landmark in LANDMARKS]
    report, slopes = StageReport.read(folder / "supine.json"), read_table(folder / "slopes.tsv")
    return [report.text("elements"), *(fixed(moved_in(folder / "reference.json", landmark), 3) for landmark in LANDMARKS),
            *(fixed(mm, 3) for mm in supine), *map(_beyond, supine, finest), fixed(report.number("error_estimate_mm"), 3),
            *(slope_cell(slopes, landmark, "fat", 3) for landmark in LANDMARKS)]


def _beyond(value: float, finest: float | None) -> str:
    if finest is None or not finest > 0:
        return NO_VALUE
    percent = 100 * (value / finest - 1)
    return ("" if percent < 0 else "+") + fixed(percent, 2)


def truth_moves(report: StageReport, side: str) -> list[str]:
    return [fixed(report.number(f"{side}/landmarks/{landmark}/distance_mm"), 2) for landmark in LANDMARKS]


def calibration_note(truth: Path | None, side: str) -> str:
    """A sentence for a phantom whose preset was fitted to results of the chain; "" for any other. `truth` is phantom's report."""
    report = StageReport.read(truth) if truth else StageReport()
    if report.text("parameters/preset") != "paper":
        return ""
    nipple, tumour = truth_moves(report, side)
    return ("calibrated to this row: size and tumour of the preset \"paper\" were fitted so that this chain moves nipple and tumour "
            "by as much as the paper (8.8 and 3.0 mm supine); the phantom's own truth moves "
            f"{nipple} and {tumour} mm")
