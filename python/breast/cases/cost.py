# SPDX-License-Identifier: GPL-3.0-or-later
"""The time and memory to request from a cluster for one case."""
from __future__ import annotations

from typing import NamedTuple

from ..errors import BreastError
from ..text_table import Table, number_in

_TIMES_LONGER, _TIMES_MORE, _LEAST_MINUTES, _LEAST_MB, _ENOUGH_CASES = 3, 1.5, 5, 256, 3


class CaseCost(NamedTuple):
    minutes: int
    memory_mb: int
    source: str


def _asked(seconds: float, mb: float, source: str) -> CaseCost:
    return CaseCost(int(_LEAST_MINUTES + _TIMES_LONGER * seconds / 60), int(_LEAST_MB + _TIMES_MORE * mb), source)


def case_cost(measured: Table | None, assumed: Table, cores: int, element: str, size: float) -> CaseCost:
    """Three times the measured time and one and a half times the measured memory.

    The measurement is that of the most expensive case of `measured` (cost.tsv of a cohort, at least three cases with CPU time) on
    `cores`; otherwise it is the row of `assumed` for the element, extrapolated to larger meshes with the fourth power (time) and the
    cube (memory) of ELEMENTS, which is `size`. Raises BreastError if neither table contains the element.
    """
    rows = range(len(measured.rows)) if measured else ()
    cpu = [measured.number(row, "cpu_seconds") for row in rows]
    if sum(seconds > 0 for seconds in cpu) >= _ENOUGH_CASES:
        seconds = max([0.0, *(used / cores for used in cpu), *(measured.number(row, "wall_seconds") for row in rows)])
        mb = max(measured.number(row, "peak_mb") for row in rows)
        count = sum(seconds > 0 for seconds in cpu)
        return _asked(seconds, mb, f"the most expensive of {count} cases in cost.tsv: {int(seconds)} seconds, {int(mb)} MB")
    row = next((row for row in assumed if row["element"] == element), {})
    known = number_in(row.get("elements", ""))
    if known is None:
        raise BreastError(f"contains no cost of element '{element}'", assumed.name)
    ratio = max(1.0, size / known)
    seconds = (number_in(row["cpu_seconds"]) or 0) * ratio**4
    mb = (number_in(row["peak_mb"]) or 0) * ratio**3
    return _asked(seconds, mb, f"pipelines/cohort-cost.tsv, {element}, ELEMENTS={int(size)}: about {int(seconds)} CPU seconds, "
                  f"{int(mb)} MB")
