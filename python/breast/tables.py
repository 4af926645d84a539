# SPDX-License-Identifier: GPL-3.0-or-later
"""Tab-separated tables: as a pandas DataFrame where pandas is installed, else as a numpy structured array."""
from __future__ import annotations

import math
import os
import re
from typing import Any

import numpy as np

from . import text_table
from .errors import BreastError
from .text_table import number_in


def read_table(file: str | os.PathLike[str], pandas: bool | None = None) -> Any:
    """A table of the toolkit; the header's names carry the units (nipple_mm).

    Columns of numbers become float64 or int64, and an empty cell or '-' (no value) in them becomes NaN. All other columns are text,
    with "" where there is no value.

    Args:
        file: a .tsv file; lines that begin with # are comments.
        pandas: True a DataFrame, False a structured array, None a DataFrame where pandas is installed.

    Raises:
        BreastError: rows that do not fit the header, or a number that is not finite.
    """
    read = text_table.read_table(file)
    records = read.records()
    columns = {name: _typed([row[name] for row in records]) for name in read.columns}
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


def _typed(cells: list[str]) -> np.ndarray:
    numbers = [number_in(cell.removeprefix("+")) if cell else math.nan for cell in cells]
    if None in numbers:
        return np.array(cells, dtype=str)
    if cells and all(re.fullmatch(r"-?[0-9]{1,18}", cell) for cell in cells):
        return np.array([int(cell) for cell in cells], dtype=np.int64)
    return np.array(numbers, dtype=np.float64)
