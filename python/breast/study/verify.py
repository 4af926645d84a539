# SPDX-License-Identifier: GPL-3.0-or-later
"""Comparison of a run with expected values."""
from __future__ import annotations

from pathlib import Path

from ..errors import Failed
from .kinds import Request, kind
from .stage_report import StageReport
from .table import Table, number_of, or_dash, table_if_any


def verdict_of(expected: str, computed: str, tolerance: str) -> str:
    """"ok", "differs", or "missing" if `computed` is empty. Numbers agree within `tolerance`, other text must be equal."""
    if not computed:
        return "missing"
    a, b = number_of(expected), number_of(computed)
    if a is not None and b is not None:
        return "ok" if abs(a - b) <= (number_of(tolerance) or 0) else "differs"
    return "ok" if expected == computed else "differs"


def verify(expected: Table, run: Path) -> Table:
    """Columns file, row, column, expected, computed, tolerance, verdict.

    Args:
        expected: columns file (in the folder RUN), row (value in the file's first column; "-" for a report), column (or key of a
            .json report), expected and tolerance.
    """
    result = Table(["file", "row", "column", "expected", "computed", "tolerance", "verdict"])
    for row in range(len(expected.rows)):
        file, name, column, value, tolerance = (expected.cell(row, c) for c in ("file", "row", "column", "expected", "tolerance"))
        computed = _value_of(run / file, name, column)
        result.rows.append([file, name, column, value, or_dash(computed), tolerance, verdict_of(value, computed, tolerance)])
    return result


def _value_of(file: Path, row: str, column: str) -> str:
    if file.suffix == ".json":
        return StageReport.read(file).text(column)
    table = table_if_any(file)
    return table.at(row, column) if table else ""


@kind("verify", "EXPECTED.tsv RUN", "comparison of a run with expected values; exit code 1 if one differs")
def _verify(request: Request) -> Table:
    result = verify(request.table(0), request.path(1))
    wrong = [row for row in result if row["verdict"] != "ok"]
    if wrong:
        raise Failed(f"{len(wrong)} values differ from {request.word(0)}" + "".join(
            "; {file} {row} {column} is {computed}, expected {expected} within {tolerance}".format(**row) for row in wrong))
    return result
