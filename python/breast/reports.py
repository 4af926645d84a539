# SPDX-License-Identifier: GPL-3.0-or-later
"""The JSON report beside every result."""
from __future__ import annotations

import json
import math
import os
from pathlib import Path
from typing import Any, NoReturn

from .errors import BreastError

_DEEPEST = 64


def parse_report(text: str) -> dict[str, Any]:
    """A report as nested dicts and lists. Raises ValueError for what is no JSON object of finite numbers, or is nested too deeply."""
    def refuse(number: str) -> NoReturn:
        raise ValueError(f"it holds {number}")

    def finite(number: str) -> float:
        return float(number) if math.isfinite(float(number)) else refuse(number)

    try:
        report = json.loads(text, parse_constant=refuse, parse_float=finite)
    except RecursionError as error:
        raise ValueError("it is nested too deeply") from error
    if not _shallow(report, _DEEPEST):
        raise ValueError("it is nested too deeply")
    if not isinstance(report, dict):
        raise ValueError("its outermost value must be an object")
    return report


def read_report(file: str | os.PathLike[str]) -> dict[str, Any]:
    """A report as nested dicts and lists; keys name their units (force_N). Raises BreastError when it is not one."""
    path = Path(file)
    if not path.is_file():
        raise BreastError("is not a file", path)
    try:
        return parse_report(path.read_text(encoding="utf-8"))
    except ValueError as error:
        raise BreastError(f"is no JSON report ({error})", path, "make it again") from None


def _shallow(entry: Any, depth: int) -> bool:
    if not isinstance(entry, (dict, list)):
        return True
    return depth > 0 and all(_shallow(item, depth - 1) for item in (entry.values() if isinstance(entry, dict) else entry))
