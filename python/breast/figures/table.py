# SPDX-License-Identifier: GPL-3.0-or-later
"""Columns of a table that a chart is drawn from."""
from __future__ import annotations

from pathlib import Path

import numpy as np

from ..errors import BreastError
from ..tables import read_table


class Table:
    """A .tsv file. Raises BreastError naming the columns there are when one is asked for that is missing or of another kind."""

    def __init__(self, file: str) -> None:
        self._file = file
        self._rows = read_table(Path(file), pandas=False)

    def has(self, column: str) -> bool:
        return column in self._rows.dtype.names

    def _column(self, column: str) -> np.ndarray:
        if not self.has(column):
            raise BreastError(f"has no column {column}", self._file, f"it has: {', '.join(self._rows.dtype.names)}")
        return self._rows[column]

    def texts(self, column: str) -> list[str]:
        return [str(cell) for cell in self._column(column)]

    def numbers(self, column: str) -> np.ndarray:
        """Numbers, NaN in empty cells."""
        values = self._column(column)
        if values.dtype.kind not in "fi":
            raise BreastError(f"column {column} must hold numbers", self._file)
        return values.astype(float)
