# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of a run that may be absent, and numbers as cells hold them."""
from __future__ import annotations

import os
from decimal import Decimal
from pathlib import Path

from ..text_table import NO_VALUE, Row, Table, number_in, parse_table, read_table  # noqa: F401  what this folder works with
from .files import exists


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
