# SPDX-License-Identifier: GPL-3.0-or-later
"""How far each side of a cohort gets from the scan to the supine shape, and how well."""
from __future__ import annotations

from pathlib import Path

from ..output import write_text
from .bounds import Bound
from .cohort import Case, cohort_cost, read_cases
from .files import exists
from .kinds import Request, kind
from .stage_report import StageReport
from .table import NO_VALUE, Table, fixed, general, or_dash, table_if_any

_STAGES = ("labels", "geometry", "mesh", "reference", "supine")
_TRUE = (Bound("body_dice", "body_dice", 3, low=0.99), Bound("gland_dice", "fibroglandular_in_breast_dice", 3),
         Bound("wall_mean_mm", "wall_on_breast_mean_mm", 1, high=1.2), Bound("wall_p95_mm", "wall_on_breast_p95_mm", 1, high=2),
         Bound("wall_in_view_mean_mm", "wall_mean_mm", 1), Bound("wall_in_view_p95_mm", "wall_p95_mm", 1))
"""Rows of labels-truth.tsv. Gland has no bound: it depends on what the truth calls gland."""
_FIT = (Bound("fit_mean_mm", "fit/mean_mm", 2, high=0.2), Bound("fit_p95_mm", "fit/p95_mm", 2, high=0.5))
_SHAPE = Bound("min_scaled_jacobian", "min_scaled_jacobian", 2, low=0.2)
_CLOSURE_MM = 1e-6


def side_table(runs: Path, cases: list[Case]) -> Table:
    """One row a case.

    The last stage reached; agreement of the labels with the truth (labels-truth.tsv, where the case has one), on the breast as it is
    labelled and, of the wall, on all of the scan's half; the wall's own uncertainty; distance of the skin's fit; worst scaled Jacobian;
    volume within the rim and of the labelled breast; how closely the shape loaded again returns to the scan; CPU seconds and memory of
    all stages; what was mended; which bounds are missed; and the reason why the case ended. A bound is missed by a value outside it,
    and by no value where the stage was reached.
    """
    table = Table(["case", "status", "reached", *(bound.name for bound in _TRUE), "wall_stated_mm", *(bound.name for bound in _FIT),
                   _SHAPE.name, "volume_ml", "labels_ml", "closure_mm", "cpu_s", "peak_mb", "mended", "missed", "reason"])
    cost = cohort_cost(runs, cases)
    for case in cases:
        run, reached = runs / case.name, last_stage(runs / case.name)
        labels, geometry, mesh, reference = (StageReport.read(run / f"{stage}.json") for stage in _STAGES[:4])
        truth = table_if_any(run / "labels-truth.tsv")
        true = [(bound, truth.number_at(bound.key, "value") if truth else None) for bound in _TRUE]
        fit = [(bound, geometry.number(bound.key)) for bound in _FIT]
        shape, closure = mesh.number(_SHAPE.key), reference.number("closure_mm")
        judged = [*(true if truth else []), *(fit if geometry else []), *([(_SHAPE, shape)] if mesh else [])]
        missed = [*([] if reached == _STAGES[-1] else ["supine"]), *(bound.name for bound, value in judged if bound.missed_by(value)),
                  *(["closure_mm"] if closure is not None and not closure < _CLOSURE_MM else [])]
        table.rows.append([
            case.name, case.status, reached, *(fixed(value, bound.decimals) for bound, value in true),
            fixed(labels.number("chest_wall/sigma_mean_mm"), 1), *(fixed(value, bound.decimals) for bound, value in fit),
            fixed(shape, _SHAPE.decimals), fixed(mesh.number("volume_ml"), 0), fixed(geometry.number("volumes_ml/labels"), 0),
            NO_VALUE if closure is None else general(closure, 2), cost.at(case.name, "cpu_seconds"), cost.at(case.name, "peak_mb"),
            or_dash("; ".join(geometry.texts("mended") + mesh.texts("mended"))), ", ".join(missed) or "none", or_dash(case.reason)])
    return table


def last_stage(run: Path) -> str:
    """The last stage whose file is there, with those before it."""
    last = NO_VALUE
    for stage in _STAGES:
        if not exists(run / f"{stage}.vtkhdf"):
            break
        last = stage
    return last


@kind("sides", "RUNS",
      "table of all cases in RUNS/.cases, written to RUNS/sides.tsv and printed: how far each side gets from the scan to the supine "
      "shape, how well, and which bounds it misses")
def _sides(request: Request) -> str:
    text = side_table(request.path(0), read_cases(request.path(0))).text()
    write_text(request.path(0) / "sides.tsv", text)
    return text
