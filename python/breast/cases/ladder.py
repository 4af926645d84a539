# SPDX-License-Identifier: GPL-3.0-or-later
"""The meshes of a ladder, the cheapest first, solved until the estimated error is small enough."""
from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ..command.child import run_child
from ..errors import Failed, NotConverged
from ..output import write_text


def climb(run: Path, wanted_mm: float, points: Sequence[str], make: Sequence[str]) -> str:
    """Writes RUN/accuracy.tsv, a table of the points tried, and RUN/accuracy.mk, the ELEMENTS and ELEMENT chosen.

    Chosen is the first point whose estimated error is at most `wanted_mm`, mm, or otherwise the last that has a solution.

    Args:
        points: ELEMENT-TEMPLATE-N, rows of pipelines/studies/cost.tsv.
        make: the command that solves a point, without its target.

    Returns:
        The table, followed by a remark if no point meets `wanted_mm`.

    Raises:
        NotConverged: no point has a solution.
        Failed: a command fails.
    """
    from ..study.cost import accuracy_row
    from ..study.table import Table

    cost, coarser = run / "studies/cost", ""
    table = Table(["point", "elements", "stress_free_estimate_mm", "supine_estimate_mm", "cpu_s", "meets"])
    for point in points:
        # The user should see the output of make, but stdout is reserved for the table.
        if run_child([*make, str(cost / point / "supine.json")], out=2) != 0:
            raise Failed(f"accuracy: {point} could not be made")
        row = accuracy_row(cost, point, coarser, wanted_mm)
        if row is None:
            continue
        table.rows.append(row)
        if point.startswith("q2p1-"):
            coarser = point
        if row[-1] == "yes":
            break
    if not table.rows:
        raise NotConverged(f"accuracy: no mesh of the ladder could be solved: see {cost}")
    write_text(run / "accuracy.tsv", table.text())
    chosen, meets = table.rows[-1][0], table.rows[-1][-1] == "yes"
    element, _, elements = chosen.split("-")
    write_text(run / "accuracy.mk", f"ELEMENTS := {elements}\nELEMENT := {element}\n")
    return table.text() + ("" if meets else f"accuracy: {wanted_mm:g} mm is not met by any mesh tried; the finest is taken\n")
