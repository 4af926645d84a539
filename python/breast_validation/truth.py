# SPDX-License-Identifier: GPL-3.0-or-later
"""The chain against the truth of a phantom: errors, what remains of them when a stage is replaced by the truth, and its calibration."""
from __future__ import annotations

import math
from pathlib import Path

from breast.study.findings import LANDMARKS, moved_in, truth_moves
from breast.study.kinds import Request, kind
from breast.study.stage_report import StageReport, failure_of, variant_of
from breast.study.table import NO_VALUE, Row, Table, fixed, number_of, one_line, or_dash, read_table, table_if_any


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


# ---- error budget ----------------------------------------------------------------------------------------------------

_REPLACED = {
    "chain": ("labels", "geometry", "mesh", "reference", "supine", "truth-cc", "truth-mlo", "cc-mammogram", "mlo-mammogram"),
    "segmentation": ("labels",), "body": ("labels", "geometry", "mesh"), "tissue": ("labels",),
    "discretisation": ("reference", "supine", "truth-cc", "truth-mlo"), "backward": ("reference",),
    "compression": ("reference", "truth-cc", "truth-mlo")}
"""The stages of the chain that a row of the budget replaces."""


def budget_table(run: Path, rows: list[str]) -> Table:
    """The errors that remain when one stage is replaced by the truth: one row for the chain and for every RUN/budget/ROW.

    Columns: mean and largest error in mm of the true positions in the stress-free and supine shapes; distance of their MLO positions
    from the curve (mean, 95 %, largest); CPU seconds of the chain's own stages that the row replaces (for the chain: of all stages);
    missing: the reason why a cell is "-".
    """
    table = Table(["replaced", "stress_free_mean_mm", "stress_free_largest_mm", "supine_mean_mm", "supine_largest_mm",
                   "curve_mean_mm", "curve_p95_mm", "curve_largest_mm", "cpu_s", "missing"])
    for name in ("chain", *rows):
        landmarks, curves = (table_if_any(run / "budget" / name / file) for file in ("landmarks.tsv", "curves-summary.tsv"))
        errors = [landmarks.number_at(which, f"{shape}_error_mm") if landmarks else None
                  for shape in ("stress_free", "supine") for which in ("mean", "largest")]
        errors += [curves.number_at(which, "true_to_curve_mm") if curves else None for which in ("mean", "p95", "largest")]
        stages = _REPLACED.get(name)
        cpu = sum(StageReport.read(run / f"{stage}.json").number("cpu_seconds") or 0 for stage in stages or ())
        table.rows.append([name, *(fixed(mm, 3) for mm in errors), "0" if stages is None else fixed(cpu, 2), _missing(run, name)])
    return table


def _missing(run: Path, row: str) -> str:
    said = ["stress-free, supine: not solved in this row"] if row == "compression" else []
    for shape in ("reference", "supine", "cc", "mlo"):
        solve = variant_of(run, "budget", row) / shape
        failure = failure_of(solve)
        if failure is not None:
            said.append(f"{shape}: {one_line(StageReport.read(solve.with_name(shape + '.json')).text('reason') or failure)}")
    return or_dash("; ".join(said))


@kind("budget", "RUN ROW...", "errors that remain when one stage is replaced by the truth (RUN/budget/ROW)")
def _budget(request: Request) -> Table:
    return budget_table(request.path(0), request.rest(1))


# ---- calibration of the preset `paper` --------------------------------------------------------------------------------

def calibration_table(run: Path, truth: Path, side: str, landmarks: Table) -> Table:
    """Motion from the prone shape in mm: in the paper, with the model as printed, as solved, and in the truth (`landmarks`)."""
    table = Table(["model", "supine_nipple_mm", "supine_tumour_mm", "stress_free_nipple_mm", "stress_free_tumour_mm", "remark"],
                  [["the paper", "8.8", "3.0", "4.5", "1.6", ""]])
    for name, folder, remark in (
            ("as printed in the paper", variant_of(run, "findings", "as-printed"), "calibrated to this row"),
            ("default chain", run, "calibrated to this row, by the same fit")):
        moves = [fixed(moved_in(folder / f"{stage}.json", landmark), 2)
                 for stage in ("supine", "reference") for landmark in LANDMARKS]
        table.rows.append([name, *moves, remark])
    stress_free = [NO_VALUE, NO_VALUE]
    for r in range(len(landmarks.rows)):
        if landmarks.cell(r, "side") == side and landmarks.cell(r, "landmark") in LANDMARKS:
            moved = math.dist(landmarks.point(r, "stress_free_"), landmarks.point(r, "prone_"))
            stress_free[LANDMARKS.index(landmarks.cell(r, "landmark"))] = fixed(moved, 2)
    table.rows.append(["the phantom's truth", *truth_moves(StageReport.read(truth), side), *stress_free, ""])
    return table


@kind("calibration", "RUN PHANTOM.json SIDE", "values to which the preset was fitted, beside the motion of its truth")
def _calibration(request: Request) -> Table:
    truth = request.path(1)
    landmarks = truth.with_name(truth.stem + "-truth") / "landmarks.tsv"
    return calibration_table(request.path(0), truth, request.word(2), read_table(landmarks))
