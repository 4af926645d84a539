# SPDX-License-Identifier: GPL-3.0-or-later
"""The JSON report of a stage, in which an absent entry has no value and is no error."""
from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

from ..errors import BreastError
from ..reports import parse_report
from ..text_table import read_text
from .files import exists, valid, with_ending
from .table import one_line

Place = tuple[float, float, float]
_MOST_BYTES = 16 << 20


class StageReport:
    """A report that may be absent, because a stage may have been replaced by a program that writes none.

    Keys are joined in a path: "seconds/total".
    """

    def __init__(self, root: dict[str, Any] | None = None) -> None:
        self.root = root or {}

    @staticmethod
    def read(file: str | os.PathLike[str]) -> StageReport:
        """An empty report if the file is absent or empty. Raises BreastError naming a file that holds anything but a JSON object."""
        if not exists(Path(file)):
            return StageReport()
        return StageReport.parse(valid(read_text(file, _MOST_BYTES)), os.fspath(file))

    @staticmethod
    def parse(text: str, name: str) -> StageReport:
        try:
            return StageReport(parse_report(text))
        except ValueError:
            raise BreastError("not a JSON report; remove it, or run its stage again", name) from None

    def __bool__(self) -> bool:
        return bool(self.root)

    def find(self, path: str) -> Any:
        entry: Any = self.root
        for key in path.split("/"):
            if not isinstance(entry, dict) or key not in entry:
                return None
            entry = entry[key]
        return entry

    def number(self, path: str) -> float | None:
        return _number(self.find(path))

    def text(self, path: str) -> str:
        """A text, or a number or truth value as JSON writes it; "" for anything else."""
        entry = self.find(path)
        if entry is None or isinstance(entry, (dict, list)):
            return ""
        return entry if isinstance(entry, str) else json.dumps(entry)

    def texts(self, path: str) -> list[str]:
        """The texts in a list."""
        entry = self.find(path)
        return [item for item in entry if isinstance(item, str)] if isinstance(entry, list) else []

    def first(self, name: str) -> float | None:
        """The first number of that name at any depth, in the order of the file."""
        return _first(self.root, name)

    def landmark(self, name: str) -> str:
        """The key of a landmark; "tumour" also finds an artificial one; "" if there is none."""
        return next((key for key in (name, "artificial_" + name) if self.find(f"landmarks/{key}") is not None), "")

    def place(self, landmark: str, what: str) -> Place | None:
        """Where a landmark is, mm LPS; `what` is "imaged" or "position"."""
        entry = self.find(f"landmarks/{self.landmark(landmark)}/{what}")
        if not isinstance(entry, list) or len(entry) != 3 or None in map(_number, entry):
            return None
        return (float(entry[0]), float(entry[1]), float(entry[2]))


def variant_of(run: Path, study: str, variant: str) -> Path:
    """The folder with STAGE.json and STAGE.vtkhdf for every stage of a variant."""
    return run / "studies" / study / variant


def failure_of(name: Path) -> str | None:
    """Why the solve NAME.vtkhdf, NAME.json has no result: the sentence of its report, else its typed reason. None if it has a
    result or was never tried."""
    if with_ending(name, ".vtkhdf").exists():
        return None
    report = StageReport.read(with_ending(name, ".json"))
    if not report:
        return None
    return one_line(report.text("explanation") or report.text("reason") or report.text("status"))


def posture_failure_of(variant: Path) -> str | None:
    """The same for the change of posture of a variant, which fails with its stage reference or its stage supine."""
    failures = (failure_of(variant / shape) for shape in ("reference", "supine"))
    return next((failure for failure in failures if failure is not None), None)


def _number(entry: Any) -> float | None:
    return float(entry) if isinstance(entry, (int, float)) and not isinstance(entry, bool) else None


def _first(entry: Any, name: str) -> float | None:
    if not isinstance(entry, dict):
        return None
    for key, value in entry.items():
        number = _number(value) if key == name else None
        number = _first(value, name) if number is None else number
        if number is not None:
            return number
    return None
