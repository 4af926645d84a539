# SPDX-License-Identifier: GPL-3.0-or-later
"""What is wrong or uncertain about a run, worst first, in the words of those who read the page."""
from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path

from ..cases.compression import VIEWS, why_no_compression
from ..study.advice import CHAIN_STAGES, extended_pattern
from ..study.stage_report import StageReport
from ..study.table import one_line, read_table
from ..study.views import NIPPLE_LINES_DIFFER_MM, nipple_lines

_WORDS = Path(__file__).with_name("words.tsv")
_UNKNOWN = 2  # the weight of a warning without a row
_WHERE = {"reference": "in the shape without gravity", "supine": "in the supine shape", "cc": "between the plates",
          "mlo": "between the plates"}


@dataclass
class Remark:
    """weight: 1 the result may be wrong, 2 check something, 3 good to know. said: the warnings behind it, as "stage: words"."""

    weight: int
    words: str
    said: list[str] = field(default_factory=list)


@dataclass(frozen=True)
class Banner:
    """A view that is no compression, or stopped before its end. said: the program's words."""

    headline: str
    reason: str
    said: list[str]


def _words() -> list[tuple[re.Pattern[str], int, str]]:
    return [(extended_pattern(row["pattern"], str(_WORDS)), int(row["weight"]), row["words"]) for row in read_table(_WORDS)]


def remarks_of(run: Path) -> list[Remark]:
    """Every warning of the stages of a run in the words of words.tsv, worst first: one remark for all warnings of a row, and a warning
    without a row as it is; and one for views of which no clinic would accept that they show the same part of the breast. What concerns
    a view that is not shown is said by its banner."""
    table = _words()
    remarks: dict[str, Remark] = {}
    for stage in (*CHAIN_STAGES, "patient"):
        if stage in VIEWS and why_no_compression(run / f"{stage}.vtkhdf"):
            continue
        for text in map(one_line, StageReport.read(run / f"{stage}.json").texts("warnings")):
            weight, said = next(((weight, said) for pattern, weight, said in table if pattern.search(text)), (_UNKNOWN, text))
            said = said.replace("{where}", _WHERE.get(stage, "in places"))
            remarks.setdefault(said, Remark(weight, said)).said.append(f"{stage}: {text}")
    cc, mlo = nipple_lines(run) or (0, 0)
    if abs(cc - mlo) > NIPPLE_LINES_DIFFER_MM:
        said = (f"Behind the nipple, CC shows {cc:.0f} mm and MLO {mlo:.0f} mm of the breast; clinics accept a difference of "
                f"{NIPPLE_LINES_DIFFER_MM} mm.")
        remarks[said] = Remark(2, said)
    return sorted(remarks.values(), key=lambda remark: remark.weight)


def banners_of(run: Path) -> list[Banner]:
    """Of the views that are no compression, or stopped before their end."""
    banners, table = [], _words()
    for view in VIEWS:
        report = StageReport.read(run / f"{view}.json")
        status, name = report.text("status"), report.text("view") or view.upper()
        why = one_line(report.text("explanation") or report.text("reason") or status)
        reason = " ".join(words for pattern, _, words in table if pattern.search(why)) or why
        warnings = report.texts("warnings") if why_no_compression(run / f"{view}.vtkhdf") else []  # else remarks_of has them
        said = [f"{view}: {text}" for text in (why, *map(one_line, warnings))]
        nothing = f"There is no {name} image, and no line to or from it."
        reduction = report.number("reduction_percent")
        early = "the simulated compression stopped early" + (f", when the breast was {reduction:.0f} % thinner" if reduction else "")
        if status == "not_gripped":
            headline = f"{name}: the simulated plates do not hold the breast. {nothing}"
        elif status == "stopped_early" and report.find("accepted") is False:
            headline = f"{name}: {early}, which is not enough. {nothing}"
        elif status == "stopped_early":
            headline = f"{name}: {early}. The image shows a breast that is pressed less firmly than in an examination."
        elif status not in ("", "ok", "converged") or report.find("accepted") is False:
            headline = f"{name}: the simulated compression failed. {nothing}"
        else:
            continue
        banners.append(Banner(headline, reason, said))
    return banners
