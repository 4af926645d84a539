# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors of the chain against the truth of a phantom."""
from __future__ import annotations

from pathlib import Path

from .kinds import Request, kind
from .table import NO_VALUE, Row, Table, fixed, number_of, read_table


def truth_summary(truth: Table) -> Table:
    """Errors against the truth as the pages show them: mean, largest, nipple and true tumour."""
    columns = {"imaged_error_mm": "prone_error_mm", "stress_free_error_mm": "stress_free_error_mm",
               "stress_free_moved_mm": "stress_free_true_mm", "supine_error_mm": "supine_error_mm",
               "supine_moved_mm": "supine_true_mm"}
    table = Table(["landmark", *columns])
    for r, (landmark, *_) in enumerate(truth.rows):
        if landmark in ("mean", "largest", "nipple", "true-tumour"):
            table.rows.append([landmark, *(fixed(number_of(truth.cell(r, c)), 2) if c in truth.columns else NO_VALUE
                                           for c in columns.values())])
    return table


def truth_of_postures(runs: list[Path]) -> Table:
    """One row a run and posture: mean displacement of the true landmarks from the scan, mm; mean and largest error of the chain, mm;
    mean error in per cent of that displacement; mean and largest error of the truth itself, mm.

    The values are those of RUN/truth-compressed.tsv, or of RUN/truth.tsv if nothing was compressed.
    """
    table = Table(["case", "shape", "moved_mm", "error_mm", "largest_mm", "error_percent", "own_error_mm", "largest_own_mm"])
    for run in runs:
        compressed = run / "truth-compressed.tsv"
        truth = read_table(compressed if compressed.exists() else run / "truth.tsv")
        for posture in ("stress_free", "supine", "cc", "mlo"):
            if f"{posture}_error_mm" in truth.columns:
                table.rows.append([run.name, posture, *_posture(truth, posture)])
    return table


def _posture(truth: Table, posture: str) -> Row:
    moved, error = (truth.number_at("mean", f"{posture}_{what}_mm") for what in ("true", "error"))
    percent = NO_VALUE if moved is None or error is None or not moved > 0 else fixed(100 * error / moved, 0)
    own = [fixed(truth.number_at(row, f"{posture}_own_error_mm"), 2) for row in ("mean", "largest")]
    return [fixed(moved, 1), fixed(error, 1), fixed(truth.number_at("largest", f"{posture}_error_mm"), 1), percent, *own]


@kind("truth", "TRUTH.tsv", "mean, largest, nipple and tumour of a table of errors against the truth")
def _truth(request: Request) -> Table:
    return truth_summary(request.table(0))


@kind("truth-rows", "RUN...", "errors of runs against their truth, one row per posture")
def _truth_rows(request: Request) -> Table:
    return truth_of_postures(list(map(Path, request.words)))
