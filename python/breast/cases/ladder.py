# SPDX-License-Identifier: GPL-3.0-or-later
"""The meshes of a ladder, the cheapest first, solved until the estimated error is small enough."""
from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ..command.child import capture_child, run_child
from ..errors import Failed, NotConverged
from ..output import write_text

_HEADER = "point\telements\tstress_free_estimate_mm\tsupine_estimate_mm\tcpu_s\tmeets\n"


def _tried(cost: Path, wanted_mm: str, point: str, coarser: str, tabulate: Sequence[str], make: Sequence[str]) -> str:
    """Solves a point and returns its row of the table, or "" if the point has no solution."""
    # The user should see the output of make, but stdout is reserved for the table.
    if run_child([*make, str(cost / point / "supine.json")], out=2) != 0:
        raise Failed(f"accuracy: {point} could not be made")
    said = capture_child([*tabulate, "accuracy", str(cost), point, wanted_mm, *([coarser] if coarser else [])])
    if said.exit_code != 0:
        raise Failed(" ".join(said.err.splitlines()))
    return said.out


def climb(run: Path, wanted_mm: str, points: Sequence[str], tabulate: Sequence[str], make: Sequence[str]) -> str:
    """Writes RUN/accuracy.tsv, a table of the points tried, and RUN/accuracy.mk, the ELEMENTS and ELEMENT chosen.

    Chosen is the first point whose estimated error is at most `wanted_mm`, mm, or otherwise the last that has a solution.

    Args:
        points: ELEMENT-TEMPLATE-N, rows of pipelines/studies/cost.tsv.
        tabulate: the command `tabulate`, whose kind `accuracy` judges a point.
        make: the command that solves a point, without its target.

    Returns:
        The table, followed by a remark if no point meets `wanted_mm`.

    Raises:
        NotConverged: no point has a solution.
        Failed: a command fails.
    """
    cost = run / "studies/cost"
    table, row, chosen, coarser = _HEADER, "", "", ""
    for point in points:
        found = _tried(cost, wanted_mm, point, coarser, tabulate, make)
        if not found:
            continue
        row, chosen = found, point
        table += row
        if point.startswith("q2p1-"):
            coarser = point
        if row.endswith("yes\n"):
            break
    if not chosen:
        raise NotConverged(f"accuracy: no mesh of the ladder could be solved: see {cost}")
    write_text(run / "accuracy.tsv", table)
    element, _, elements = chosen.split("-")
    write_text(run / "accuracy.mk", f"ELEMENTS := {elements}\nELEMENT := {element}\n")
    return table + ("" if row.endswith("yes\n") else f"accuracy: {wanted_mm} mm is not met by any mesh tried; the finest is taken\n")
