# SPDX-License-Identifier: GPL-3.0-or-later
"""Slopes d ln u / d ln s of the displacement u with respect to the stiffness s, from one tangent-linear solve and from solving
again."""
from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from .stage_report import Place, StageReport
from .table import NO_VALUE, Table, fixed

_STEPS, _ONE_SIDED = ("90", "110", "50", "200"), ("150", "200", "200", "500")
"""Stiffnesses in per cent, the two near ones first; those of the tumour, which is not softened."""


def parabola_slope(a: float, b: float, f0: float, fa: float, fb: float) -> float:
    """Derivative at 0 of the parabola through (0, f0), (a, fa), (b, fb)."""
    return (fa - f0) * (b / (a * (b - a))) - (fb - f0) * (a / (b * (b - a)))


def slope_between(low: float, u_low: float, high: float, u_high: float) -> float:
    """d ln u / d ln s between two rows with stiffness in per cent; both displacements must be positive."""
    return math.log(u_high / u_low) / math.log(high / low)


def slope_row(slopes: Table, landmark: str, parameter: str) -> int | None:
    """The row of a table of `sensitivity`; for the tumour also that of an artificial one."""
    return next((r for r in range(len(slopes.rows)) if slopes.cell(r, "landmark") in (landmark, "artificial_" + landmark)
                 and slopes.cell(r, "parameter") == parameter), None)


def slope_cell(slopes: Table, landmark: str, parameter: str, decimals: int) -> str:
    row = slope_row(slopes, landmark, parameter)
    return NO_VALUE if row is None else fixed(slopes.number(row, "dlnu"), decimals)


@dataclass(frozen=True)
class Comparison:
    """A slope from the tangent and from solving again.

    Attributes:
        resolved: three-point derivative through the near steps.
        difference: tangent minus resolved.
        step_error: of the near steps, from the same formula with the far steps and the orders of both.
        vector_percent: distance of both derivatives of the place, per cent of the resolved one's length.
        agrees: the difference is at most twice the step error plus 1e-4.
    """

    resolved: float
    difference: float
    step_error: float
    vector_percent: float
    agrees: bool


def compare_slopes(slope: float, derivative: Place, imaged: Place, base: Place, stiffness: Sequence[float],
                   places: Sequence[Place]) -> Comparison:
    """Compares a tangent (slope, and derivative of the place with respect to ln s, mm) with solves at four stiffnesses.

    Args:
        imaged, base: the landmark's place in the scan, and at 100 per cent; mm.
        stiffness, places: s and the landmark's place there, the two near ones first.
    """
    s = [math.log(x) for x in stiffness]
    log0, *logs = (math.log(math.dist(place, imaged)) for place in (base, *places))
    near, wide = (parabola_slope(s[i], s[i + 1], log0, logs[i], logs[i + 1]) for i in (0, 2))
    ratio = s[2] * s[3] / (s[0] * s[1])  # the error of the formula is proportional to the product of its steps
    resolved = [parabola_slope(s[0], s[1], *three) for three in zip(base, places[0], places[1])]
    size, error = math.hypot(*resolved), abs((wide - near) / (ratio - 1))
    percent = 100 * math.dist(resolved, derivative) / size if size > 0 else 0.0
    return Comparison(near, slope - near, error, percent, abs(slope - near) <= 2 * error + 1e-4)


def slopes_table(base: Path, scaled: Path, slopes: Table, tumour_slopes: Table) -> Table:
    """Table VII: every slope in the tables of `sensitivity`, compared with Tables III to VI solved again.

    Args:
        base: supine report of the state at 100 per cent.
        scaled: folder of the variants TISSUE-PERCENT; "not evaluated" where one of a slope's steps has no solution.
    """
    table = Table(["tissue", "landmark", "tangent", "resolved", "difference", "step_error", "vector_difference_percent", "verdict"])
    own, stiff = StageReport.read(base), StageReport.read(scaled / "tumour-100/supine.json")
    for tissue in ("fat", "fibroglandular", "skin", "tumour"):
        zero, tangents = (stiff, tumour_slopes) if tissue == "tumour" else (own, slopes)
        for landmark in ("tumour", "nipple"):
            table.rows.append([tissue, landmark, *_slope_cells(tissue, landmark, zero, scaled, tangents)])
    return table


def _slope_cells(tissue: str, landmark: str, zero: StageReport, scaled: Path, slopes: Table) -> list[str]:
    row = slope_row(slopes, landmark, tissue)
    imaged, base = zero.place(landmark, "imaged"), zero.place(landmark, "position")
    if row is None or imaged is None or base is None:
        return [NO_VALUE] * 5 + ["not evaluated"]
    slope = slopes.number(row, "dlnu")
    derivative = (slopes.number(row, "dx_mm"), slopes.number(row, "dy_mm"), slopes.number(row, "dz_mm"))
    steps = _ONE_SIDED if tissue == "tumour" else _STEPS
    found = [StageReport.read(scaled / f"{tissue}-{step}/supine.json").place(landmark, "position") for step in steps]
    places = [place for place in found if place is not None]
    if len(places) < len(steps):
        return [fixed(slope, 5)] + [NO_VALUE] * 4 + ["not evaluated"]
    c = compare_slopes(slope, derivative, imaged, base, [float(step) / 100 for step in steps], places)
    return [fixed(slope, 5), fixed(c.resolved, 5), fixed(c.difference, 5), fixed(c.step_error, 5), fixed(c.vector_percent, 2),
            "agrees" if c.agrees else "differs"]
