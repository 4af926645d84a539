# SPDX-License-Identifier: GPL-3.0-or-later
"""HTML pages of a cohort: an overview of all cases, and the contours of their segmentations."""
from __future__ import annotations

import io
from dataclasses import dataclass
from pathlib import Path
from statistics import fmean, stdev
from typing import Any

from PIL import Image

from .files import exists
from .html import data_uri, page, table_of_text
from .table import NO_VALUE, Table, fixed, general, number_of

_QUANTITIES = ("volume_ml", "min_scaled_jacobian", "supine_nipple_mm", "supine_tumour_mm", "cc_thickness_mm", "cc_force_N",
               "mlo_thickness_mm", "mlo_force_N")
# Three axial and two sagittal slices out of the sixteen that segment draws, four per row of 500 x 360 pixels with the breast in the
# middle, as (row, column).
_SLICES = ((0, 1), (0, 3), (1, 1), (2, 1), (2, 2))


@dataclass(frozen=True)
class CohortPages:
    """What the pages show.

    Attributes:
        cases: from cohort_table.
        cost: from cohort_cost.
        motion: one row a case; None where no chest wall can be measured from.
        women: columns quantity, mean, sd, measured on living women.
    """

    runs: Path
    cases: Table
    cost: Table
    motion: Table | None
    women: Table


def cohort_page(cohort: CohortPages) -> str:
    """The overview: failures first, with reason and log; distributions beside the values of living women; then every case."""
    rows = sorted(cohort.cases, key=_rank)
    failed = [{"name": row["case"], "reason": row["reason"], "log": row["log"],
               "picture": _small(cohort.runs / row["case"] / "contours.png", 240)} for row in cohort.cases if _rank(row) == 0]
    done = [{"name": row["case"], "kind": _kind(row), "look": row["look"].split("; "),
             "page": f"{row['case']}/page.html" if exists(cohort.runs / row["case"] / "page.html") else "",
             "cells": [row["volume_ml"], row["supine_nipple_mm"],
                       *(f"{row[f'{v}_thickness_mm']}, {row[f'{v}_force_N']}" for v in ("cc", "mlo"))],
             "picture": _small(cohort.runs / row["case"] / "figures/summary.png", 480)} for row in rows if _rank(row) > 0]
    return _page("cohort", cohort, cohort.runs.name, failed=failed, done=done, distributions=_distributions(cohort),
                 cost=table_of_text(cohort.cost.text()))


def contours_page(cohort: CohortPages) -> str:
    """The contours of every segmentation, beginning with those that failed or should be checked."""
    cases = []
    for row in sorted(cohort.cases, key=_rank):
        said = {"bad": f"failed: {row['reason']}", "look": row["look"], "": ""}[_kind(row)]
        cases.append({"name": row["case"], "kind": _kind(row), "said": said,
                      "picture": _slices(cohort.runs / row["case"] / "contours.png")})
    return _page("contours", cohort, f"Segmentations of {cohort.runs.name}", cases=cases)


def _page(template: str, cohort: CohortPages, title: str, **context: Any) -> str:
    ranks = list(map(_rank, cohort.cases))
    failed, looking = ranks.count(0), ranks.count(1)
    counted = f"{len(ranks)} cases: {len(ranks) - failed} done, {failed} failed, {looking} ask for a look."
    return page(template, title=title, style="cohort.css", counted=counted, **context)


def _rank(row: dict[str, str]) -> int:
    """Failed cases first, then those that should be checked, then the others."""
    return 0 if row["status"] != "done" else 1 if row["look"] != NO_VALUE else 2


def _kind(row: dict[str, str]) -> str:
    return ("bad", "look", "")[_rank(row)]


def _distributions(cohort: CohortPages) -> list[dict[str, Any]]:
    tables = [(cohort.cases, column) for column in _QUANTITIES]
    if cohort.motion:
        tables += [(cohort.motion, column) for column in cohort.motion.columns[2:]]
    found = (distribution(table, column, cohort.women) for table, column in tables if column in table.columns)
    return [dots for dots in found if dots]


def distribution(table: Table, column: str, women: Table) -> dict[str, Any] | None:
    """The numbers of a column as a row of dots, one per case, over a grey band for the women's mean and deviation."""
    values = sorted(value for row in table if (value := number_of(row[column])) is not None)
    if not values:
        return None
    mean, sd = women.number_at(column, "mean"), women.number_at(column, "sd")
    known = mean is not None and sd is not None
    low, high = min(values[0], mean - 2 * sd) if known else values[0], max(values[-1], mean + 2 * sd) if known else values[-1]
    scale = 100 / (high - low) if high > low else 0.0
    return {"name": column,
            "cells": [str(len(values)), *(general(value, digits) for value, digits in
                                          ((fmean(values), 4), (stdev(values) if values[1:] else 0, 3), (values[0], 4), (values[-1], 4)))],
            "women": f"{women.at(column, 'mean')} ({women.at(column, 'sd')})" if known else NO_VALUE,
            "band": (fixed((mean - sd - low) * scale, 1), fixed(2 * sd * scale, 1)) if known else None,
            "dots": [fixed((value - low) * scale, 1) for value in values]}


def _small(png: Path, width: int) -> str:
    """A picture in that many pixels' width as a data URI; "" where there is none."""
    picture = _read(png)
    return _jpeg(picture.resize((width, round(picture.height * width / picture.width)))) if picture else ""


def _slices(png: Path) -> str:
    """Some of the contours of segment side by side, pixel by pixel, because a contour is one pixel wide; "" where there are none."""
    picture = _read(png)
    if picture is None or picture.width < 4 * 500 or picture.height < 3 * 360:  # another program made the picture
        return ""
    width, height = 340, 280
    strip = Image.new("RGB", (width * len(_SLICES), height))
    for place, (row, column) in enumerate(_SLICES):
        left, top = 500 * column + 80, 360 * row + 40
        strip.paste(picture.crop((left, top, left + width, top + height)), (width * place, 0))
    return _jpeg(strip, subsampling=0)


def _read(png: Path) -> Image.Image | None:
    try:
        with Image.open(png) as picture:
            return picture.convert("RGB")
    except OSError:
        return None


def _jpeg(picture: Image.Image, **options: int) -> str:
    written = io.BytesIO()
    picture.save(written, "JPEG", quality=70, **options)
    return data_uri(written.getvalue(), "jpeg")
