# SPDX-License-Identifier: GPL-3.0-or-later
"""Error against run time and mesh, from solves on several meshes with several elements and solvers."""
from __future__ import annotations

from pathlib import Path

from .kinds import Request, kind
from .shapes import most_apart
from .stage_report import StageReport, posture_failure_of
from .table import NO_VALUE, Row, Table, fixed


class Point:
    """One discretisation: the folder FOLDER/POINT with its stages reference and supine."""

    def __init__(self, folder: Path) -> None:
        self.reference, self.supine = folder / "reference.vtkhdf", folder / "supine.vtkhdf"
        self.backward, self.forward = (StageReport.read(file.with_suffix(".json")) for file in (self.reference, self.supine))

    def total(self, key: str) -> float:
        return (self.backward.number(key) or 0) + (self.forward.number(key) or 0)

    def estimates(self) -> tuple[float | None, float | None]:
        """The solver's own estimate of its error in mm, stress-free and supine: the second solve carries the error of its start."""
        first, second = (report.number("error_estimate_mm") for report in (self.backward, self.forward))
        return first, None if first is None or second is None else first + second

    def apart(self, other: Point) -> tuple[float, float]:
        """The largest distances of a landmark from its place in the other, mm, stress-free and supine."""
        return most_apart(self.reference, other.reference), most_apart(self.supine, other.supine)


def cost_table(folder: Path, finest: str, points: list[str]) -> Table:
    """One row a point ELEMENT-TEMPLATE-N[-SOLVER], the variant FOLDER/POINT.

    error_mm: the largest distance of tumour or nipple from the point `finest`; estimate_mm: the solver's own estimate; "-": no
    solution, or no estimate.
    """
    table = Table(["point", "element", "template", "solver", "elements", "unknowns", "newton_iterations", "cpu_s", "wall_s",
                   "peak_mb", "stress_free_error_mm", "supine_error_mm", "stress_free_estimate_mm", "supine_estimate_mm"])
    for name in points:
        parts = name.split("-")
        row = [name, parts[0], parts[1] if len(parts) > 1 else NO_VALUE, parts[3] if len(parts) > 3 else "auto"]
        if posture_failure_of(folder / name) is not None:
            row += [NO_VALUE] * (len(table.columns) - len(row))
        else:
            p = Point(folder / name)
            newton = "+".join(report.text("newton_iterations") for report in (p.backward, p.forward))
            row += [p.forward.text("elements"), p.forward.text("unknowns"), newton, fixed(p.total("cpu_seconds"), 2),
                    fixed(p.total("seconds/total"), 2), fixed(p.backward.number("peak_mb"), 0),
                    *(fixed(mm, 4) for mm in (*p.apart(Point(folder / finest)), *p.estimates()))]
        table.rows.append(row)
    return table


def accuracy_row(folder: Path, point: str, coarser: str, wanted: float) -> Row | None:
    """One discretisation tried by ACCURACY: its estimated errors, its cost, and whether both errors are at most `wanted` mm.

    8-node elements estimate their own error. That of 27-node elements is assumed to be at most the distance to the previous
    discretisation with 27-node elements, `coarser` ("" for the first, which only starts the comparison). None without a solution.
    """
    if posture_failure_of(folder / point) is not None:
        return None
    p = Point(folder / point)
    errors: tuple[float | None, float | None] = (None, None)
    if not point.startswith("q2p1"):
        errors = p.estimates()
    elif coarser:
        errors = p.apart(Point(folder / coarser))
    meets = all(mm is not None and mm <= wanted for mm in errors)
    return [point, p.forward.text("elements"), *(fixed(mm, 4) for mm in errors), fixed(p.total("cpu_seconds"), 2),
            "yes" if meets else "no"]


@kind("cost", "FOLDER FINEST POINT...", "error against run time for the points ELEMENT-TEMPLATE-N[-SOLVER]")
def _cost(request: Request) -> Table:
    return cost_table(request.path(0), request.word(1), request.rest(2))
