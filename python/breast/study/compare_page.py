# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of two runs side by side."""
from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from ..page.remarks import Banner, Remark, banners_of, remarks_of
from .compared_runs import TOPICS, Pair
from .files import exists
from .html import Block, Section, data_uri, page, table, text
from .stage_report import StageReport

_PICTURES = {
    "slices": "The scan in three planes with the contours of its segmentation",
    "cc-mammogram": "Simulated CC mammogram",
    "mlo-mammogram": "Simulated MLO mammogram",
    "outlines": "Shapes in the scan, stress-free and supine, superimposed",
    "cc-compression": "The breast before and after CC compression",
    "mlo-compression": "The breast between the plates in MLO",
    "pressure": "Contact pressure under both plates",
    "force-thickness": "Force of both plates against thickness"}
"""Pictures of the figures/ folder and their captions."""
_PLAIN = {"cc-mammogram": "cc", "mlo-mammogram": "mlo"}
"""Images in the run's own folder, which stand in where a run has no figures."""
_HEADER = {"landmarks": ("place", "unit", "first", "second", "distance", "error of first", "error of second"),
           "model": ("setting", "", "first", "second")}


@dataclass(frozen=True)
class Picture:
    """One half of a pair; source is empty for a run that lacks it. width: per cent of the space, so that both have one scale."""

    source: str
    alt: str
    width: float = 100


@dataclass(frozen=True)
class _Side:
    name: str
    banners: list[Banner]
    remarks: list[Remark]


def compare_page(pair: Pair) -> str:
    """All text is escaped, and no folder is named but those that tell runs of one name apart."""
    names = pair.names()
    sides = [_Side(name, banners_of(run), remarks_of(run)) for name, run in zip(names, (pair.first, pair.second))]
    return page("compare", title=f"libbreast: {names[0]} and {names[1]}", style="compare.css", sides=sides, remarks=pair.remarks,
                sections=[_section(pair, topic) for topic in TOPICS], pictures=_pictures(pair, names))


def _section(pair: Pair, topic: str) -> Section:
    rows = pair.of_topic(topic)
    if not rows:
        return Section(TOPICS[topic], [text("Nothing differs.")] if topic == "model" else [])
    header = _HEADER.get(topic, ("quantity", "unit", "first", "second", "difference"))
    cells = [[row.quantity, row.unit, row.first, row.second, row.difference, row.first_error, row.second_error][:len(header)]
             for row in rows]
    if not header[1]:
        header, cells = (header[0], *header[2:]), [[row[0], *row[2:]] for row in cells]
    notes: list[Block | None] = []
    if topic == "landmarks":
        notes.append(text("L P S in the frame of the scan, or u v on the image, mm. The errors are the runs' own estimates of their "
                          "discretisation; a distance that is not larger says nothing."))
    return Section(TOPICS[topic], [*notes, table(list(header), cells)])


def _pictures(pair: Pair, names: tuple[str, str]) -> list[tuple[str, list[Picture]]]:
    """Captions, each with the pictures of both runs; a picture that neither has is left out."""
    found = []
    for name, caption in _PICTURES.items():
        figures = [run / "figures" / f"{name}.png" for run in (pair.first, pair.second)]
        plain = name in _PLAIN and not all(map(exists, figures))
        files = [run / f"{_PLAIN[name]}.png" for run in (pair.first, pair.second)] if plain else figures
        if any(map(exists, files)):
            widths = _widths(files) if plain else [100.0, 100.0]
            sources = [data_uri(file.read_bytes(), "png") if exists(file) else "" for file in files]
            alts = [f"{caption}, {order} run ({run})" for order, run in zip(("first", "second"), names)]
            found.append((caption, [Picture(*half) for half in zip(sources, alts, widths)]))
    return found


def _widths(files: list[Path]) -> list[float]:
    """Per cent of the space for each image, by its width in mm as its report states it."""
    reports = [StageReport.read(file.with_name(f"{file.stem}-mammogram.json")) for file in files]
    widths = [(report.number("width_pixels") or 0) * (report.number("pixel_mm") or 0) for report in reports]
    return [100 * width / max(widths) if width > 0 else 100.0 for width in widths]
