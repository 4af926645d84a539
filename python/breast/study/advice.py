# SPDX-License-Identifier: GPL-3.0-or-later
"""The warnings of a run's stages, each listed once, with advice on what to do."""
from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from ..errors import BreastError
from ..text_table import read_text
from .kinds import Request
from .stage_report import StageReport
from .table import one_line

CHAIN_STAGES = ("labels", "geometry", "mesh", "reference", "supine", "cc", "mlo", "cc-mammogram", "mlo-mammogram", "curve", "lookup")
"""The names of the reports of the chain's stages, in order."""


@dataclass(frozen=True)
class Advice:
    """What to do about the warnings that match an extended regular expression."""

    pattern: re.Pattern[str]
    remedy: str


@dataclass
class Warned:
    """A warning: the stages that give it, as "cc, mlo"; the remedy is "" where there is none or a later warning has the same."""

    stages: str
    text: str
    remedy: str = ""


def read_advice(file: Path) -> list[Advice]:
    """Lines PATTERN<tab>REMEDY; # begins a comment. Raises BreastError naming line and text of an invalid pattern."""
    found = []
    for number, line in enumerate(read_text(file).split("\n"), 1):
        pattern, tab, remedy = line.partition("\t")
        if tab and not line.startswith("#"):
            found.append(Advice(extended_pattern(pattern, f"{file}, line {number}"), remedy))
    return found


def extended_pattern(text: str, where: str) -> re.Pattern[str]:
    try:
        return re.compile(text)
    except re.error:
        raise BreastError(f"{where}: '{text}' is not an extended regular expression") from None


def gather(said: Iterable[tuple[str, list[str]]], advice: list[Advice]) -> list[Warned]:
    """Merges the warnings (stage, texts) in the order of the chain; those with the same advice are adjacent, and only the last of
    them has the advice."""
    known: dict[str, Warned] = {}
    for stage, texts in said:
        for text in map(one_line, texts):
            if text in known:
                known[text].stages += f", {stage}"
            else:
                known[text] = Warned(stage, text)
    groups: dict[object, list[Warned]] = {}
    for warned in known.values():
        own = next((a for a in advice if a.pattern.search(warned.text)), None)
        groups.setdefault(own or warned.text, []).append(warned)  # without advice it is a group of its own
    for own, group in groups.items():
        if isinstance(own, Advice):
            group[-1].remedy = own.remedy
    return [warned for group in groups.values() for warned in group]


def warnings_of(run: Path, advice: list[Advice]) -> list[Warned]:
    """The merged warnings from the reports of a run."""
    return gather(((stage, StageReport.read(run / f"{stage}.json").texts("warnings")) for stage in CHAIN_STAGES), advice)


def own_advice(request: Request) -> list[Advice]:
    return read_advice(request.pipelines / "advice.tsv")
