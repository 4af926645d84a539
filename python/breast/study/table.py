# SPDX-License-Identifier: GPL-3.0-or-later
"""Tab-separated tables of text cells, and numbers as the cells hold them."""
from __future__ import annotations

import os
import re
from collections.abc import Iterator, Sequence
from decimal import Decimal
from pathlib import Path

from .. import text_table
from ..errors import BreastError, Failed
from ..text_table import number_in, parse_number, read_text
from .files import exists

NO_VALUE = "-"
"""A cell without a value; in a file it is empty."""
Row = list[str]
FARTHEST_MM = 1e6
"""Places farther from the origin than this are refused."""
_MOST_BYTES = 16 << 20
_NOT_FINITE = re.compile(r"-?(nan(\(\w*\))?|inf(inity)?)", re.IGNORECASE)


class Table:
    """Columns with units in their names (nipple_mm), and rows of text.

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
        raise BreastError(f"{self.name} has no column '{name}'; it has: {', '.join(self.columns)}")

    def cell(self, row: int, column: str) -> str:
        return self.rows[row][self.column(column)]

    def number(self, row: int, column: str) -> float:
        """A cell that must be a number; raises BreastError naming table, row (from 1) and column."""
        return parse_number(self.cell(row, column), f"{self.name}, row {row + 1}, {column}")

    def point(self, row: int, prefix: str) -> tuple[float, float, float]:
        """The columns PREFIXx_mm, PREFIXy_mm and PREFIXz_mm (or without _mm), mm."""
        names = (prefix + axis if prefix + axis in self.columns else f"{prefix}{axis}_mm" for axis in "xyz")
        x, y, z = (self.number(row, name) for name in names)
        if max(map(abs, (x, y, z))) > FARTHEST_MM:
            raise BreastError(f"{self.name}, row {row + 1}: {general(x)} {general(y)} {general(z)} mm, must be within 1e+06")
        return x, y, z

    def at(self, row: str, column: str) -> str:
        """The cell in the row that begins with `row`; a column artificial_COLUMN is found, too. "" where there is none."""
        name = next((c for c in (column, "artificial_" + column) if c in self.columns), None)
        if name is None:
            return ""
        return next((cells[self.columns.index(name)] for cells in self.rows if cells[0] == row), "")

    def number_at(self, row: str, column: str) -> float | None:
        return number_of(self.at(row, column))

    def text(self) -> str:
        """The table as it is printed. Raises Failed naming a row that would read back as another."""
        rows = [[NO_VALUE if cell == "" or _not_finite(cell) else cell for cell in row] for row in self.rows]
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
    """Lines that begin with # are comments. Raises BreastError with the line's number, also for a cell that is nan or inf."""
    known = text_table.parse_table(text, name)
    return Table(known.columns, [[row[column] or NO_VALUE for column in known.columns] for row in known.rows], name)


def read_table(file: str | os.PathLike[str]) -> Table:
    return parse_table(read_text(file, _MOST_BYTES), os.fspath(file))


def table_if_any(file: str | os.PathLike[str]) -> Table | None:
    """The table; None if the file is absent or empty."""
    return read_table(file) if exists(Path(file)) else None


def fixed(value: float | None, decimals: int) -> str:
    return NO_VALUE if value is None else f"{value:.{decimals}f}"


def general(value: float, digits: int = 6) -> str:
    """The value with so many significant digits, as C's %g."""
    return f"{value:.{digits}g}"


def or_dash(text: str) -> str:
    return text or NO_VALUE


def number_of(cell: str) -> float | None:
    """The number in a cell, perhaps with a plus sign; None for any other text."""
    return number_in(cell.removeprefix("+"))


def shortest(value: float) -> str:
    """The shortest text that reads back to the same number: 0.5, 10000, 1e-05."""
    sign, digits, exponent = Decimal(repr(float(value))).normalize().as_tuple()
    mantissa = "".join(map(str, digits))
    power = len(mantissa) - 1 + int(exponent)
    fraction = "." + mantissa[1:] if mantissa[1:] else ""
    scientific = f"{mantissa[0]}{fraction}e{'-' if power < 0 else '+'}{abs(power):02d}"
    return ("-" if sign else "") + min(format(Decimal((0, digits, exponent)), "f"), scientific, key=len)


def one_line(text: str) -> str:
    """The text with tabs and line breaks as blanks, so that it fits into a cell."""
    return text.replace("\n", " ").replace("\r", " ").replace("\t", " ")


def _not_finite(cell: str) -> bool:
    return _NOT_FINITE.fullmatch(cell) is not None
