# SPDX-License-Identifier: GPL-3.0-or-later
"""Single values of reports, for makefiles and scripts."""
from __future__ import annotations

from ..errors import BreastError
from .kinds import Request, kind
from .stage_report import StageReport
from .table import shortest


@kind("key", "REPORT.json PATH", "one value of a report, at a path of keys (seconds/total) or the first number of that name")
def _key(request: Request) -> str:
    report = StageReport.read(request.word(0))
    value = report.text(request.word(1))
    if not value:
        number = report.first(request.word(1))
        if number is None:
            raise BreastError(f"has no '{request.word(1)}'", request.word(0))
        value = shortest(number)
    return value + "\n"


@kind("place", "REPORT.json LANDMARK [imaged|position]", "position x,y,z of a landmark in mm")
def _place(request: Request) -> str:
    place = StageReport.read(request.word(0)).place(request.word(1), request.word(2, "imaged"))
    if place is None:
        raise BreastError(f"has no landmark '{request.word(1)}'", request.word(0))
    return ",".join(map(shortest, place)) + "\n"
