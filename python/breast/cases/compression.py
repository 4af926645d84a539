# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes between plates that do not grip the breast: they are kept, and nothing is made of them."""
from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from ..reports import parse_report

VIEWS = ("cc", "mlo")


def report_of(file: Path) -> dict[str, object]:
    """A stage's JSON report; {} where there is none, as of a program that writes none."""
    try:
        return parse_report(file.read_text(encoding="utf-8", errors="replace"))
    except (OSError, ValueError):
        return {}


def why_no_compression(shape: Path) -> str:
    """Why `compress` does not accept a shape that it was asked to keep, from the report beside it; "" if it does."""
    report = report_of(shape.with_suffix(".json"))
    return str(report.get("reason") or report.get("status")) if report.get("accepted") is False else ""


def why_not_made(inputs: Iterable[Path]) -> str:
    """Which of the files a stage reads is not there, or is no compression; "" if it can run."""
    for file in inputs:
        if not file.exists():
            return f"there is no {file.name}"
        if why_no_compression(file):
            return f"{file.name} is no compression"
    return ""


def views_without_compression(run: Path) -> list[str]:
    """A sentence for each view of a case whose plates do not grip the breast."""
    whys = {view: why_no_compression(run / f"{view}.vtkhdf") for view in VIEWS}
    return [f"{view.upper()} is no compression: {why}" for view, why in whys.items() if why]
