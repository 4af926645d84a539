# SPDX-License-Identifier: GPL-3.0-or-later
"""How far curves interpolated in a lookup are from those matched anew, and what the lookup costs."""
from __future__ import annotations

from pathlib import Path

import numpy as np

from breast.errors import BreastError
from breast.lookup import Lookup, read_lookup
from breast.study.kinds import Request, kind
from breast.study.stage_report import StageReport
from breast.study.table import Table, fixed

_MATCHED = 1


def interpolated_error(lookup: Lookup, exact: Lookup) -> np.ndarray:
    """(n) mean distance in mm between a curve of `exact` and that interpolated between the four nodes of `lookup` around its point.

    Of every point of `exact` that is no node of `lookup` and whose four nodes have whole curves, places of equal depth compared. Raises
    BreastError if the nodes of `lookup` are none of `exact`'s, or if there is no such point.
    """
    step = round(lookup.pitch_mm / exact.pitch_mm)
    if step < 2 or abs(step * exact.pitch_mm - lookup.pitch_mm) > 1e-9 or (lookup.from_view, lookup.side) != (exact.from_view, exact.side):
        raise BreastError(f"has a pitch of {lookup.pitch_mm} mm in {lookup.from_view}, must be a multiple of {exact.pitch_mm} mm in "
                          f"{exact.from_view}", lookup.file)
    j, i = np.nonzero(exact.status == _MATCHED)
    low_j, low_i = j // step, i // step
    keep = (low_j + 1 < lookup.status.shape[0]) & (low_i + 1 < lookup.status.shape[1]) & ((j % step > 0) | (i % step > 0))
    j, i, low_j, low_i = (index[keep] for index in (j, i, low_j, low_i))
    y, x = (j % step) / step, (i % step) / step
    whole, curve = np.ones(len(j), bool), np.zeros((len(j), *lookup.curve_mm.shape[2:]))
    for dj, weight_y in ((0, 1 - y), (1, y)):
        for di, weight_x in ((0, 1 - x), (1, x)):
            whole &= lookup.status[low_j + dj, low_i + di] == _MATCHED
            curve += (weight_y * weight_x)[:, None, None] * lookup.curve_mm[low_j + dj, low_i + di]
    if not whole.any():
        raise BreastError("has no four neighbouring nodes with whole curves", lookup.file, "give one with a smaller pitch")
    return np.linalg.norm(curve[whole] - exact.curve_mm[j[whole], i[whole]], axis=-1).mean(-1)


def lookup_cost_table(exact: Path, files: list[Path]) -> Table:
    """One row a lookup with its report beside it: pitch in mm, nodes, CPU seconds, and the error in mm: mean and 95th percentile."""
    table, finest = Table(["pitch_mm", "nodes", "cpu_s", "mean_mm", "p95_mm"]), read_lookup(exact)
    for file in files:
        lookup, report = read_lookup(file), StageReport.read(file.with_suffix(".json"))
        error = interpolated_error(lookup, finest)
        table.rows.append([f"{lookup.pitch_mm:g}", str(lookup.status.size), fixed(report.number("cpu_seconds"), 2), fixed(error.mean(), 4),
                           fixed(float(np.percentile(error, 95)), 4)])
    return table


@kind("lookup-cost", "EXACT.h5 LOOKUP.h5...", "how far curves interpolated in lookups of match-lookup are from those of a finer one, whose "
      "nodes are matched, and what they cost (reports beside them)")
def _lookup_cost(request: Request) -> Table:
    return lookup_cost_table(request.path(0), [Path(word) for word in request.rest(1)])
