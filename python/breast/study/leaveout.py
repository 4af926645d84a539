# SPDX-License-Identifier: GPL-3.0-or-later
"""The effect of leaving out parts of the model, and the simplest model that stays within a given error."""
from __future__ import annotations

import math
from pathlib import Path

from ..text_table import parse_number
from ..errors import BreastError
from .kinds import Request, kind
from .shapes import apart
from .stage_report import StageReport, variant_of
from .table import NO_VALUE, Table, fixed, read_table, shortest

QUESTIONS = {"surgery": ("reference", "supine"), "matching": ("reference", "cc", "mlo")}
"""The stages that each question needs."""


def leaveout_table(run: Path, variants: list[str]) -> Table:
    """One row for the base and for every variant of RUN/studies/leaveout.

    Supine: distance of tumour and nipple from their positions in the base; CC, MLO: the same for the tumour; curve: distance of the
    MLO curve from that of the base; all in mm. CPU seconds of the stages that each question needs, and those saved.
    """
    from .curve_distance import curve_distance

    base = {question: _seconds_of(run, stages) for question, stages in QUESTIONS.items()}
    columns = ["variant", "supine_tumour_mm", "supine_nipple_mm", "cc_tumour_mm", "mlo_tumour_mm", "curve_mean_mm", "curve_max_mm",
               "cc_force_N", *(f"{question}_{what}_s" for question in QUESTIONS for what in ("cpu", "saved"))]
    table = Table(columns, [["base", *["0"] * 6, _force(run), *(c for cpu in base.values() for c in (fixed(cpu, 1), "0"))]])
    for variant in variants:
        folder = variant_of(run, "leaveout", variant)
        gaps = [apart(folder / f"{shape}.vtkhdf", run / f"{shape}.vtkhdf", landmark) for shape, landmark in
                (("supine", "tumour"), ("supine", "nipple"), ("cc", "tumour"), ("mlo", "tumour"))]
        row = [variant, *(fixed(mm, 3) for mm in (*gaps, *curve_distance(folder / "curve.vtp", run / "curve.vtp"))), _force(folder)]
        for question, stages in QUESTIONS.items():
            own = _seconds_of(folder, stages)
            row += [fixed(own, 1), fixed(base[question] - own, 1)]
        table.rows.append(row)
    return table


def changes(leaveout: Table, question: str, parts: list[str]) -> list[tuple[str, float]]:
    """Each part with the change in mm that leaving it out makes, smallest first.

    For surgery it is that of the supine positions of tumour and nipple, for matching the largest distance on the MLO curve. Raises
    BreastError for another question.
    """
    if question not in QUESTIONS:
        raise BreastError(f"'{question}' is not a question; use surgery or matching")
    # Surgery is a question without a compression.
    asked = [part for part in parts if not (question == "surgery" and part == "no-gravity-in-compression")]
    return sorted(((part, _change_of(leaveout, part, question)) for part in asked), key=lambda pair: (pair[1], pair[0]))


def least_model(ordered: list[tuple[str, float]], allowed: float) -> list[tuple[str, float]]:
    """The parts that can be left out: those with the smallest changes, as long as the changes add up to no more than `allowed` mm."""
    chosen, total = [], 0.0
    for part, change in ordered:
        total += change
        if total <= allowed:
            chosen.append((part, change))
    return chosen


def recommendation(run: Path, allowed: float, parts: list[str]) -> Table:
    """For both questions: the parts of least_model(), the sum of their changes, the change in the variant least-QUESTION solved with
    all of them left out, and whether it stays within the error. (The changes need not add up.)"""
    table = Table(["question", "allowed_mm", "left_out", "sum_of_changes_mm", "measured_mm", "cpu_s", "base_cpu_s", "saved_percent",
                   "keeps_the_error"])
    known = read_table(run / "leaveout/table.tsv")
    for question in QUESTIONS:
        chosen = least_model(changes(known, question, parts), allowed)
        least = f"least-{question}"
        own = leaveout_table(run, [least])
        change = _change_of(own, least, question)
        cells = [own.at(row, f"{question}_cpu_s") for row in (least, "base")]
        seconds, base = (float(cell) for cell in cells)
        table.rows.append([
            question, shortest(allowed), " ".join(part for part, _ in chosen) or "nothing", fixed(sum(c for _, c in chosen), 3),
            fixed(change, 3), *cells, fixed(100 * (1 - seconds / base) if base > 0 else 0, 0), "yes" if change <= allowed else "no"])
    return table


def wall_table(run: Path, variants: list[str]) -> Table:
    """Displacement in mm of the predicted positions when the chest wall moves by its own standard deviation: RUN/studies/wall."""
    places = (("supine", "tumour"), ("supine", "nipple"), ("cc", "tumour"), ("mlo", "tumour"))
    table = Table(["wall", "sigma_mean_mm", "volume_ml", *(f"{stage}_{landmark}_mm" for stage, landmark in places)],
                  [["as found", *_wall(run), "0", "0", "0", "0"]])
    for variant in variants:
        folder = variant_of(run, "wall", variant)
        row = [variant, *_wall(folder)]
        for stage, landmark in places:
            here, there = (StageReport.read(f / f"{stage}.json").place(landmark, "position") for f in (folder, run))
            row.append(fixed(math.dist(here, there), 2) if here and there else NO_VALUE)
        table.rows.append(row)
    return table


def _wall(folder: Path) -> list[str]:
    return [fixed(StageReport.read(folder / "labels.json").first("sigma_mean_mm"), 2),
            fixed(StageReport.read(folder / "mesh.json").first("volume_ml"), 1)]


def _force(folder: Path) -> str:
    return fixed(StageReport.read(folder / "cc.json").number("force_N"), 1)


def _seconds_of(folder: Path, stages: tuple[str, ...]) -> float:
    """As printed, so that the saving is the difference of two cells of the table."""
    return float(fixed(sum(StageReport.read(folder / f"{stage}.json").number("cpu_seconds") or 0 for stage in stages), 1))


def _change_of(table: Table, variant: str, question: str) -> float:
    columns = ("curve_max_mm",) if question == "matching" else ("supine_tumour_mm", "supine_nipple_mm")
    return max(table.number_at(variant, column) or 0.0 for column in columns)


@kind("leaveout", "RUN VARIANT...", "change in mm and time saved in s by each variant of RUN/studies/leaveout")
def _leaveout(request: Request) -> Table:
    return leaveout_table(request.path(0), request.rest(1))


@kind("least", "TABLE.tsv surgery|matching MM PART...",
      "parts of the model that can be left out while their changes add up to no more than MM")
def _least(request: Request) -> str:
    allowed = parse_number(request.word(2), "least: MM")
    return " ".join(part for part, _ in least_model(changes(request.table(0), request.word(1), request.rest(3)), allowed))


@kind("recommendation", "RUN MM PART...",
      "those parts, the sum of their changes, and the change in RUN/studies/leaveout/least-QUESTION")
def _recommendation(request: Request) -> Table:
    return recommendation(request.path(0), parse_number(request.word(1), "recommendation: MM"), request.rest(2))


@kind("wall", "RUN VARIANT...",
      "motion of positions when the chest wall moves by its own standard deviation (RUN/studies/wall/VARIANT)")
def _wall_kind(request: Request) -> Table:
    return wall_table(request.path(0), request.rest(1))
