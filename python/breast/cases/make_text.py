# SPDX-License-Identifier: GPL-3.0-or-later
"""Text for make: what it would read as code, and assignments.

The makefile calls `cases` while it is read, and evaluates the answer as assignments.
"""
from __future__ import annotations

from ..errors import BreastError
from ..text_table import TextTable

# Replaces the line break in answers to make, because $(shell) turns line breaks into blanks (pipelines/settings.mk). No name or
# value may contain this byte.
LINE_END = "\x1e"
_CODE = frozenset("$`;&|<>(){}[]*?!\"'\\^#")


def make_assignment(name: str, value: str) -> str:
    return f"{name} := {value}{LINE_END}"


def make_addition(name: str, value: str) -> str:
    return f"{name} += {value}{LINE_END}"


def code_in(text: str) -> str:
    """The first character that a shell or make would interpret as code; "" if there is none."""
    return next((c for c in text if c in _CODE), "")


def has_control(text: str) -> bool:
    """Whether the text has a control character, of which LINE_END is one."""
    return any(c < " " or c == "\x7f" for c in text)


def rows_for_make(table: TextTable, name: str) -> str:
    """For every row the assignments cell_COLUMN := CELL, and an evaluation of the variable `name`, whose text refers to them.

    Raises BreastError, naming the table, for a character that make would interpret as code.
    """
    text = ""
    for row in table.rows:
        for column in table.columns:
            cell = row[column]
            if code_in(cell):
                raise BreastError(f"the cell '{cell}' of the column {column} contains the character {code_in(cell)}, which make "
                                  "would read as code; write it without this character", table.name)
            text += make_assignment("cell_" + column, cell)
        text += f"$(eval $(value {name})){LINE_END}"
    return text
