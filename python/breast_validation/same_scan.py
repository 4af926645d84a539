# SPDX-License-Identifier: GPL-3.0-or-later
"""The same scan in other voxels, positions and qualities: how far the results move, and whether the scores of segment show it."""
from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

from breast.output import write_text
from breast.study.bounds import Bound
from breast.study.cohort import Case, read_cases
from breast.study.kinds import Request, kind
from breast.study.sides import last_stage
from breast.study.stage_report import StageReport
from breast.study.table import Table, fixed, or_dash, table_if_any

UNCHANGED = "unchanged"
_BETWEEN = "--"
_MOVED = (Bound("nipple_mm", "", 1, high=3), Bound("volume_percent", "", 1, low=-3, high=3), Bound("wall_mm", "", 2, high=1.5),
          Bound("supine_percent", "", 1, low=-5, high=5))


def same_scan_table(runs: Path, cases: list[Case]) -> Table:
    """One row a changed scan, whose case is called CASE--CHANGE, compared with CASE--unchanged.

    Distance of the nipple; change of the volume within the rim and of the labelled breast; mean distance of the chest wall behind the
    breast (labels-same.tsv); change of the length of the nipple's displacement from the scan to the supine shape, and distance of the
    two displacements; skin of the labelled breast at the border of the scan; which bounds are missed; the reason why the case ended.
    A mirror image, whose side is the other one, is compared with the mirror image of the unchanged scan.
    """
    table = Table(["case", "change", "reached", "nipple_mm", "volume_ml", "volume_percent", "labels_percent", "wall_mm",
                   "supine_mm", "supine_percent", "supine_apart_mm", "cut_by_view_cm2", "missed", "reason"])
    for case in cases:
        of, _, change = case.name.partition(_BETWEEN)
        run, base = _Run(runs / case.name), _Run(runs / f"{of}{_BETWEEN}{UNCHANGED}")
        mirrored = run.side != base.side
        apart = _apart(run.nipple, base.nipple, mirrored)
        supine_apart = _apart(run.displacement, base.displacement, mirrored)
        values = [apart, _percent(run.volume, base.volume), run.wall, _percent(_length(run.displacement), _length(base.displacement))]
        reached = last_stage(runs / case.name)
        missed = [bound.name for bound, value in zip(_MOVED, values) if bound.missed_by(value)]
        table.rows.append([
            of, change.replace("-percent", " %").replace("-", " "), reached, fixed(apart, 1), fixed(run.volume, 0), fixed(values[1], 1),
            fixed(_percent(run.labels, base.labels), 1), fixed(run.wall, 2), fixed(_length(run.displacement), 1),
            fixed(values[3], 1), fixed(supine_apart, 1), fixed(run.cut, 0),
            "none" if change == UNCHANGED or not missed else ", ".join(missed), or_dash(case.reason)])
    return table


def flag_table(runs: Path, cases: list[Case]) -> Table:
    """One row a case with true labels (labels-truth.tsv): the score of segment for wall, gland and extent, and what each judges.

    wall: mean distance of the chest wall on the labelled breast from the truth; gland: what its Dice coefficient within the labelled
    breast lacks of one; extent: what the Dice coefficient of the breast with that of the unchanged scan lacks of one (labels-same.tsv),
    for changed scans only, because true labels seldom have a border of the breast.
    """
    table = Table(["case", "wall_score", "wall_mm", "gland_score", "gland_lacks", "extent_score", "extent_lacks"])
    for case in cases:
        labels, truth = StageReport.read(runs / case.name / "labels.json"), table_if_any(runs / case.name / "labels-truth.tsv")
        if truth is None:
            continue
        changed = _BETWEEN in case.name and not case.name.endswith(_BETWEEN + UNCHANGED)
        same = table_if_any(runs / case.name / "labels-same.tsv") if changed else None
        gland = truth.number_at("fibroglandular_in_breast_dice", "value")
        extent = same.number_at("breast_dice", "value") if same else None
        table.rows.append([
            case.name, fixed(labels.number("quality/wall"), 3), fixed(truth.number_at("wall_on_breast_mean_mm", "value"), 3),
            fixed(labels.number("quality/tissue"), 3), fixed(None if gland is None else 1 - gland, 4),
            fixed(labels.number("quality/extent"), 3), fixed(None if extent is None else 1 - extent, 4)])
    return table


def flag_correlations(flags: Table) -> Table:
    """Spearman's rank correlation of one minus the score with the error, and the number of cases, for each flag of `flag_table`."""
    table = Table(["flag", "cases", "spearman_rho"])
    for flag, error in (("wall", "wall_mm"), ("gland", "gland_lacks"), ("extent", "extent_lacks")):
        pairs = [(1 - flags.number(n, f"{flag}_score"), flags.number(n, error)) for n, row in enumerate(flags)
                 if "-" not in (row[f"{flag}_score"], row[error])]
        rho = spearman([score for score, _ in pairs], [wrong for _, wrong in pairs])
        table.rows.append([flag, str(len(pairs)), fixed(rho, 2)])
    return table


def spearman(first: Sequence[float], second: Sequence[float]) -> float | None:
    """Pearson's correlation of the ranks, ties with their mean rank; None where one of the two has no spread."""
    if not first:
        return None
    a, b = _ranks(first), _ranks(second)
    middle = (len(a) + 1) / 2
    spread = math.sqrt(sum((x - middle) ** 2 for x in a) * sum((y - middle) ** 2 for y in b))
    return sum((x - middle) * (y - middle) for x, y in zip(a, b)) / spread if spread > 0 else None


def _ranks(values: Sequence[float]) -> list[float]:
    return [sum(other < value for other in values) + (sum(other == value for other in values) + 1) / 2 for value in values]


class _Run:
    """What is compared of one case; None, or no place, where its stage was not reached."""

    def __init__(self, folder: Path) -> None:
        labels, geometry, mesh, supine = (StageReport.read(folder / f"{stage}.json") for stage in ("labels", "geometry", "mesh", "supine"))
        same = table_if_any(folder / "labels-same.tsv")
        self.side = labels.text("side")
        self.nipple = labels.place("nipple", "imaged")
        self.displacement = supine.place("nipple", "displacement_from_scan_mm")
        self.volume, self.labels = mesh.number("volume_ml"), geometry.number("volumes_ml/labels")
        self.cut = labels.number("cut_by_view_cm2")
        self.wall = same.number_at("wall_mean_mm", "value") if same else None


def _length(vector: tuple[float, float, float] | None) -> float | None:
    return None if vector is None else math.hypot(*vector)


def _apart(vector: tuple[float, float, float] | None, other: tuple[float, float, float] | None, mirrored: bool) -> float | None:
    """Length of the difference; `mirrored`: of the other one's mirror image about x = 0."""
    if vector is None or other is None:
        return None
    return math.dist(vector, (-other[0] if mirrored else other[0], other[1], other[2]))


def _percent(value: float | None, base: float | None) -> float | None:
    return None if value is None or not base else 100 * (value / base - 1)


@kind("same-scan", "RUNS",
      "table of all cases CASE--CHANGE in RUNS/.cases, written to RUNS/same-scan.tsv and printed: how far nipple, volume, chest wall and "
      "supine displacement are from those of CASE--unchanged")
def _same_scan(request: Request) -> str:
    text = same_scan_table(request.path(0), read_cases(request.path(0))).text()
    write_text(request.path(0) / "same-scan.tsv", text)
    return text


@kind("flags", "RUNS",
      "table of the scores of segment and the errors that they judge, of all cases in RUNS/.cases with true labels, written to "
      "RUNS/flags.tsv, and Spearman's correlation of the two, printed")
def _flags(request: Request) -> Table:
    flags = flag_table(request.path(0), read_cases(request.path(0)))
    write_text(request.path(0) / "flags.tsv", flags.text())
    return flag_correlations(flags)
