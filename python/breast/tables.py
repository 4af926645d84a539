# SPDX-License-Identifier: GPL-3.0-or-later
"""Tab-separated tables: as a pandas DataFrame where pandas is installed, else as a numpy structured array."""
from __future__ import annotations

import math
import os
import re
from pathlib import Path
from typing import Any

import numpy as np

from .errors import BreastError


def read_table(file: str | os.PathLike[str], pandas: bool | None = None) -> Any:
    """A table of the toolkit; the header's names carry the units (nipple_mm).

    Columns of numbers become float64 or int64, and an empty cell or '-' (no value) in them becomes NaN. All other columns are text.

    Args:
        file: a .tsv file; lines that begin with # are comments.
        pandas: True a DataFrame, False a structured array, None a DataFrame where pandas is installed.

    Raises:
        BreastError: rows that do not fit the header, or a number that is not finite.
    """
    columns = _columns(Path(file))
    if pandas is not False:
        try:
            import pandas as pd
        except ImportError as error:
            if pandas:
                raise BreastError("a DataFrame needs pandas", None, "apt-get install python3-pandas") from error
        else:
            return pd.DataFrame(columns)
    rows = len(next(iter(columns.values())))
    table = np.empty(rows, dtype=[(name, values.dtype) for name, values in columns.items()])
    for name, values in columns.items():
        table[name] = values
    return table


def _columns(path: Path) -> dict[str, np.ndarray]:
    if not path.is_file():
        raise BreastError("is not a file", path)
    try:
        text = path.read_text(encoding="utf-8")
    except UnicodeDecodeError:
        raise BreastError("is not UTF-8 text", path) from None
    header: list[str] = []
    rows: list[list[str]] = []
    for number, line in enumerate(text.splitlines(), 1):
        if not line or line.startswith("#"):
            continue
        cells = line.split("\t")
        if not header:
            header = cells
        elif len(cells) != len(header):
            raise BreastError(f"line {number} has {len(cells)} columns, the header has {len(header)}", path)
        else:
            rows.append(cells)
    if not header:
        raise BreastError("no header line", path)
    if len(set(header)) != len(header):
        raise BreastError("has two columns of one name", path)
    return {name: _typed(path, name, [row[c] for row in rows]) for c, name in enumerate(header)}


def _typed(path: Path, name: str, cells: list[str]) -> np.ndarray:
    try:
        numbers = [math.nan if cell in ("", "-") else float(cell) for cell in cells]
    except ValueError:
        return np.array(cells, dtype=str)
    for row, (cell, number) in enumerate(zip(cells, numbers), 1):
        if cell not in ("", "-") and not math.isfinite(number):
            raise BreastError(f"row {row}, {name}: '{cell}' is not finite", path)
    if cells and all(re.fullmatch(r"-?[0-9]{1,18}", cell) for cell in cells):
        return np.array([int(cell) for cell in cells], dtype=np.int64)
    return np.array(numbers, dtype=np.float64)
