# SPDX-License-Identifier: GPL-3.0-or-later
"""Tab-separated tables of text cells, without numpy: programs that read a few settings must start at once."""
from __future__ import annotations

import math
import os
import re
from collections.abc import Iterator, Sequence

from .errors import BreastError, Failed

_MOST_BYTES = 16 << 20
_NOT_FINITE = re.compile(r"-?(inf|infinity|nan)(\([a-z0-9_]*\))?", re.IGNORECASE)
_NUMBER = re.compile(r"-?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?")


def not_finite(cell: str) -> bool:
    """Whether it is nan or inf as a program prints them."""
    return _NOT_FINITE.fullmatch(cell) is not None


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


NO_VALUE = "-"
"""A cell without a value; in a file it may also be empty."""
Row = list[str]
FARTHEST_MM = 1e6
"""Places farther from the origin than this are refused."""


class Table:
    """Columns with units in their names (nipple_mm), and rows of text in which NO_VALUE stands for an empty cell.

    Attributes:
        name: of the file it came from, for errors.
    """

    def __init__(self, columns: Sequence[str], rows: Sequence[Sequence[str]] = (), name: str = "table") -> None:
        self.columns, self.rows, self.name = list(columns), [list(row) for row in rows], name

    def __iter__(self) -> Iterator[dict[str, str]]:
        """The rows as dicts by column."""
        return (dict(zip(self.columns, row)) for row in self.rows)

    def column(self, name: str) -> int:
        if name in self.columns:
            return self.columns.index(name)
        raise BreastError(f"has no column '{name}'", self.name, f"it has: {', '.join(self.columns)}")

    def cell(self, row: int, column: str) -> str:
        return self.rows[row][self.column(column)]

    def number(self, row: int, column: str) -> float:
        """A cell that must be a number; raises BreastError naming table, row (from 1) and column."""
        return parse_number(self.cell(row, column), f"{self.name}, row {row + 1}, {column}")

    def texts(self, column: str) -> list[str]:
        """A column, "" where there is no value."""
        at = self.column(column)
        return ["" if row[at] == NO_VALUE else row[at] for row in self.rows]

    def numbers(self, column: str) -> list[float]:
        """A column of numbers, NaN where there is no value; raises BreastError naming a cell that is no number."""
        where = f"{self.name}, {column}"
        return [parse_number(cell.removeprefix("+"), where) if cell else math.nan for cell in self.texts(column)]

    def records(self) -> list[dict[str, str]]:
        """The rows as dicts by column, "" where there is no value."""
        return [{column: "" if cell == NO_VALUE else cell for column, cell in row.items()} for row in self]

    def point(self, row: int, prefix: str) -> tuple[float, float, float]:
        """The columns PREFIXx_mm, PREFIXy_mm and PREFIXz_mm (or without _mm), mm."""
        names = (prefix + axis if prefix + axis in self.columns else f"{prefix}{axis}_mm" for axis in "xyz")
        x, y, z = (self.number(row, name) for name in names)
        if max(map(abs, (x, y, z))) > FARTHEST_MM:
            raise BreastError(f"{self.name}, row {row + 1}: {x:g} {y:g} {z:g} mm, must be within 1e+06")
        return x, y, z

    def at(self, row: str, column: str) -> str:
        """The cell in the row that begins with `row`; a column artificial_COLUMN is found, too. "" where there is none."""
        name = next((c for c in (column, "artificial_" + column) if c in self.columns), None)
        if name is None:
            return ""
        return next((cells[self.columns.index(name)] for cells in self.rows if cells[0] == row), "")

    def number_at(self, row: str, column: str) -> float | None:
        return number_in(self.at(row, column).removeprefix("+"))

    def text(self) -> str:
        """The table as it is printed. Raises Failed naming a row that would read back as another."""
        rows = [[NO_VALUE if cell == "" or not_finite(cell) else cell for cell in row] for row in self.rows]
        one_column = len(self.columns) == 1  # whose empty cell would be an empty line
        lines = [self.columns, *([cell if cell != NO_VALUE or one_column else "" for cell in row] for row in rows)]
        text = "".join("\t".join(line) + "\n" for line in lines)
        self._check_reads_back(rows, text)
        return text

    def _check_reads_back(self, rows: list[Row], text: str) -> None:
        try:
            read = parse_table(text, self.name)
        except BreastError as error:
            reason = str(error)
        else:
            if read.columns == self.columns and read.rows == rows:
                return
            changed = next((n for n, (a, b) in enumerate(zip(rows, read.rows)) if a != b and a), None)
            reason = ("its rows or columns change" if changed is None else
                      f"row {changed + 1}, '{rows[changed][0]}', reads back as another")
        raise Failed(f"{self.name}: cannot be written as tab-separated text ({reason}): names in a table must not contain tabs or "
                     "line breaks, nor begin a row with #")


def parse_table(text: str, name: str) -> Table:
    """Lines that begin with # are comments. Raises BreastError naming the line for rows that do not fit the header, and for nan and
    inf."""
    table: Table | None = None
    for number, line in enumerate(text.split("\n"), 1):
        line = line.removesuffix("\r")
        if not line or line.startswith("#"):
            continue
        cells = line.split("\t")
        if table is None:
            table = Table(cells, name=name)
            continue
        if len(cells) != len(table.columns):
            raise BreastError(f"line {number} has {len(cells)} columns, the header has {len(table.columns)}", name)
        for column, cell in zip(table.columns, cells):
            if not_finite(cell):
                raise BreastError(f"line {number}, {column}: '{cell}' is not finite", name)
        table.rows.append([cell or NO_VALUE for cell in cells])
    if table is None:
        raise BreastError("no header line", name)
    if len(set(table.columns)) != len(table.columns):
        raise BreastError("has two columns of one name", name)
    return table


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


def read_table(file: str | os.PathLike[str]) -> Table:
    return parse_table(read_text(file, _MOST_BYTES), os.fspath(file))
