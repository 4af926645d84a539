# SPDX-License-Identifier: GPL-3.0-or-later
"""Tab-separated tables as text, without numpy: for programs that read a few settings and must start at once."""
from __future__ import annotations

import math
import os
import re

from .errors import BreastError

_MOST_BYTES = 16 << 20
_NOT_FINITE = re.compile(r"-?(inf|infinity|nan)(\([a-z0-9_]*\))?", re.IGNORECASE)
_NUMBER = re.compile(r"-?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?")


def number_in(text: str) -> float | None:
    """The whole text as one finite number; None for any other text."""
    value = float(text) if _NUMBER.fullmatch(text) else math.inf
    return value if math.isfinite(value) else None


def parse_number(text: str, where: str) -> float:
    """The same; raises BreastError that begins with `where`."""
    value = number_in(text)
    if value is None:
        raise BreastError(f"{where}: '{text}' is not a finite number")
    return value


class TextTable:
    """The cells of a table by column; "" where a cell is empty or '-', which both mean no value.

    Attributes:
        name: of the file, for messages.
        columns: the header. rows: a dictionary for every row.
    """

    def __init__(self, name: str, columns: list[str], rows: list[dict[str, str]]) -> None:
        self.name, self.columns, self.rows = name, columns, rows

    def cell(self, row: dict[str, str], column: str) -> str:
        """Raises BreastError if there is no such column."""
        if column not in self.columns:
            raise BreastError(f"{self.name} has no column '{column}'; it has: {', '.join(self.columns)}")
        return row[column]

    def number(self, row: dict[str, str], column: str) -> float:
        """Raises BreastError if the cell is no number."""
        return parse_number(self.cell(row, column) or "-", f"{self.name}, row {self.rows.index(row) + 1}, {column}")

    def find(self, key: str) -> dict[str, str] | None:
        """The row with this text in its first column."""
        return next((row for row in self.rows if row[self.columns[0]] == key), None)


def parse_table(text: str, name: str) -> TextTable:
    """Lines that begin with # are comments. Raises BreastError naming the line for rows that do not fit the header, and for nan and
    inf."""
    columns: list[str] = []
    rows = []
    for number, line in enumerate(text.split("\n"), 1):
        line = line.removesuffix("\r")
        if not line or line.startswith("#"):
            continue
        cells = line.split("\t")
        if not columns:
            columns = cells
            continue
        if len(cells) != len(columns):
            raise BreastError(f"line {number} has {len(cells)} columns, the header has {len(columns)}", name)
        for column, cell in zip(columns, cells):
            if _NOT_FINITE.fullmatch(cell):
                raise BreastError(f"line {number}, {column}: '{cell}' is not finite", name)
        rows.append({column: "" if cell == "-" else cell for column, cell in zip(columns, cells)})
    if not columns:
        raise BreastError("no header line", name)
    if len(set(columns)) != len(columns):
        raise BreastError("has two columns of one name", name)
    return TextTable(name, columns, rows)


def read_text(file: str | os.PathLike[str], most_bytes: int = 1 << 32) -> str:
    """The whole file. Raises BreastError naming it, also for a device or pipe, which may never end, and for one that is too large."""
    name = os.fspath(file)
    if not os.path.isfile(name):
        raise BreastError("cannot be opened" if not os.path.exists(name) else "is not a file", name)
    if os.path.getsize(name) > most_bytes:
        raise BreastError(f"has {os.path.getsize(name)} bytes and may have {most_bytes}", name)
    try:
        with open(name, encoding="utf-8", errors="surrogateescape", newline="") as stream:
            return stream.read()
    except OSError as error:
        raise BreastError(error.strerror or "cannot be read", name) from None


def read_table(file: str | os.PathLike[str]) -> TextTable:
    return parse_table(read_text(file, _MOST_BYTES), os.fspath(file))
