# SPDX-License-Identifier: GPL-3.0-or-later
"""The JSON report beside every result."""
from __future__ import annotations

import json
import math
import os
from pathlib import Path
from typing import Any, NoReturn

from .errors import BreastError


def read_report(file: str | os.PathLike[str]) -> dict[str, Any]:
    """A report as nested dicts and lists; keys name their units (force_N). Raises BreastError when it is not one."""
    path = Path(file)
    if not path.is_file():
        raise BreastError("is not a file", path)

    def refuse(constant: str) -> NoReturn:
        raise BreastError(f"holds {constant}, which no report does", path)

    def finite(text: str) -> float:
        number = float(text)
        return number if math.isfinite(number) else refuse(text)

    try:
        report = json.loads(path.read_text(encoding="utf-8"), parse_constant=refuse, parse_float=finite)
    except (ValueError, RecursionError) as error:
        raise BreastError(f"is no JSON ({error})", path, "make it again") from None
    if not isinstance(report, dict):
        raise BreastError("is no report: its outermost value must be an object", path)
    return report
