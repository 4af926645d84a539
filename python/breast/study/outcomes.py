# SPDX-License-Identifier: GPL-3.0-or-later
"""What became of the variants of a study, stage by stage."""
from __future__ import annotations

from pathlib import Path

from .kinds import Request, kind
from .shapes import moved
from .stage_report import StageReport
from .table import NO_VALUE, Table, fixed, one_line, or_dash, shortest

_STUDY_STAGES = ("labels", "geometry", "mesh", "reference", "supine", "cc", "mlo", "curve", "slopes")
_SHAPES = ("reference", "supine", "cc", "mlo")


def outcomes_table(folder: Path, landmarks: list[str], variants: list[str]) -> Table:
    """One row a report FOLDER/VARIANT/STAGE.json: status, the reason if it ended early, elements, CPU seconds and, if a shape was
    found, the distance of its landmarks from their imaged positions in mm."""
    table = Table(["variant", "stage", "status", "reason", "elements", "cpu_seconds", *(f"{name}_mm" for name in landmarks)])
    for variant in variants:
        for stage in _STUDY_STAGES:
            file, shape = folder / variant / f"{stage}.json", folder / variant / f"{stage}.vtkhdf"
            if not file.exists():
                continue
            report = StageReport.read(file)
            elements = report.first("elements")
            found = stage in _SHAPES and shape.exists()
            table.rows.append([
                Path(variant).name, stage, or_dash(one_line(report.text("status"))), or_dash(one_line(report.text("reason"))),
                NO_VALUE if elements is None else shortest(elements), fixed(report.number("cpu_seconds"), 2),
                *(fixed(moved(shape, name), 4) if found else NO_VALUE for name in landmarks)])
    return table


@kind("study", "FOLDER LANDMARK,... VARIANT...", "outcome of every stage in the variants FOLDER/VARIANT")
def _study(request: Request) -> Table:
    return outcomes_table(request.path(0), request.word(1).split(","), request.rest(2))
