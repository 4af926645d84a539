# SPDX-License-Identifier: GPL-3.0-or-later
"""Compressed views of many breasts beside what single mammograms show."""
from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from ..cases.compression import VIEWS
from ..errors import BreastError
from .bounds import ANY, LEAST_CONTACT_PERCENT, MOST_EDGE_PERCENT, Bound
from .files import exists
from .kinds import Request, kind
from .stage_report import StageReport
from .table import NO_VALUE, Table, fixed

_BOUNDS = (Bound("thickness_mm", "thickness_mm", 1, 30, 90), Bound("paddle_N", "force_N", 1, 50, 180),
           Bound("pressure_kPa", "pressure_kPa", 1, 5, 30),
           Bound("contact_percent", "coverage/contact_percent_of_projected", 0, LEAST_CONTACT_PERCENT, ANY),
           Bound("paddle_edge_percent", "plates/paddle/edge_force_percent", 0, -ANY, MOST_EDGE_PERCENT),
           Bound("detector_edge_percent", "plates/detector/edge_force_percent", 0, -ANY, MOST_EDGE_PERCENT),
           Bound("min_scaled_jacobian", "min_scaled_jacobian", 3, 0.1, ANY))
_VOLUME = {"CC": Bound("volume_percent", "coverage/volume_percent", 0, 55, ANY),
           "": Bound("volume_percent", "coverage/volume_percent", 0, 90, ANY)}
_TURN = Bound("turn_deg", "turn_deg", 0, -15, 15)
_ROUNDING = 0.005
"""A force that ends a path is met to half a per cent."""


NIPPLE_LINES_DIFFER_MM = 10
"""By so much the nipple lines of a pair of views may differ that clinics accept (docs/validation/views.md)."""


def nipple_line(report: StageReport) -> float | None:
    """From the nipple backwards along its row of the image to the muscle, or to the edge of the image if no muscle is seen there, mm."""
    to_edge, to_muscle = report.number("coverage/nipple_in_front_mm"), report.number("coverage/nipple_to_muscle_mm")
    return to_edge if to_edge is None or to_muscle is None else min(to_edge, to_muscle)


def nipple_lines(run: Path) -> tuple[float, float] | None:
    """nipple_line in CC and in MLO, mm; None unless both views are compressions."""
    reports = [StageReport.read(run / f"{view}.json") for view in VIEWS]
    cc, mlo = (None if report.find("accepted") is False else nipple_line(report) for report in reports)
    return None if cc is None or mlo is None else (cc, mlo)


def _grips(run: Path, view: str) -> bool | None:
    """Whether the plates grip the breast by its shape in the file of the view; None without a file, or for plates that are not judged."""
    file = run / f"{view.lower()}.vtkhdf"
    if not exists(file):
        return None
    from ..state_file import read_state
    from .grip import grip
    found = grip(read_state(file))
    return None if found is None else found.grips()


def _outside(bound: Bound, report: StageReport) -> bool:
    return bound.missed_by(report.number(bound.key), _ROUNDING if bound.name == "paddle_N" else 0)


def views_table(runs: list[Path]) -> Table:
    """One row a view of each run that has one: its numbers, the CC and MLO nipple lines' difference, and which bounds it misses.

    The bounds of docs/methods.md (Target and grip) are applied to the numbers of the report here again, whatever compress itself said,
    and grips_by_shape is found from the shape of the file alone (grip.grip). It compares the contact with the whole silhouette, which is
    larger than what compress compares it with; where it contradicts the status, it is listed as missed.
    The turn of the plates' edge, at most 15 degrees in CC, is listed as missed too, but no view is refused for it. The last two rows
    are the means of each view, and how many of its rows miss none of the other bounds.
    """
    numbers = [bound.name for bound in (*_BOUNDS, _VOLUME[""], _TURN)]
    table = Table(["breast", "view", "status", *numbers, "nipple_line_mm", "cc_minus_mlo_mm", "grips_by_shape", "iterations",
                   "cpu_seconds", "missed"])
    rows: dict[str, list[tuple[StageReport, bool]]] = {"CC": [], "MLO": []}
    for run in runs:
        reports = {view: StageReport.read(run / f"{view.lower()}.json") for view in rows}
        lines = [nipple_line(report) for report in reports.values()]
        apart = NO_VALUE if None in lines else fixed(lines[0] - lines[1], 1)  # type: ignore[operator]
        for view, report in reports.items():
            if not report:
                continue
            bounds = (*_BOUNDS, _VOLUME.get(view, _VOLUME[""]))
            missed = [bound.name for bound in bounds if _outside(bound, report)]
            grips = _grips(run, view)
            if (report.text("status"), grips) in {("converged", False), ("not_gripped", True)}:
                missed.append("grips_by_shape")
            turned = [_TURN.name] if view == "CC" and _outside(_TURN, report) else []
            table.rows.append([run.name, view, report.text("status"),
                               *(fixed(report.number(b.key), b.decimals) for b in (*bounds, _TURN)), fixed(nipple_line(report), 1),
                               apart, {None: NO_VALUE, True: "yes", False: "no"}[grips],
                               fixed(report.number("newton_iterations"), 0), fixed(report.number("cpu_seconds"), 0),
                               ", ".join(missed + turned) or "none"])
            rows[view].append((report, not missed))
    for view, found in rows.items():
        if found:
            table.rows.append(_means(view, found))
    return table


def _means(view: str, found: list[tuple[StageReport, bool]]) -> list[str]:
    def mean(key: str | Callable[[StageReport], float | None], decimals: int) -> str:
        each = (report.number(key) if isinstance(key, str) else key(report) for report, _ in found)
        values = [value for value in each if value is not None]
        return fixed(sum(values) / len(values), decimals) if values else NO_VALUE
    met = sum(good for _, good in found)
    return ["mean", view, NO_VALUE, *(mean(b.key, b.decimals) for b in (*_BOUNDS, _VOLUME[""], _TURN)), mean(nipple_line, 1), NO_VALUE, NO_VALUE,
            mean("newton_iterations", 0), mean("cpu_seconds", 0), f"{met} of {len(found)} miss none"]


@kind("views", "RUN...", "compressed views of finished cases, one row a view, beside what single mammograms show: what each misses")
def _views(request: Request) -> Table:
    table = views_table(list(map(Path, request.words)))
    if not table.rows:
        raise BreastError(f"{request.word(0)}: holds no cc.json and no mlo.json; give the folders of finished cases, as runs/CASE")
    return table
