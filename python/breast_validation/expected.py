# SPDX-License-Identifier: GPL-3.0-or-later
"""Upkeep of the tables of expected values (pipelines/expected)."""
from __future__ import annotations

from pathlib import Path

from breast.study.kinds import Request, kind
from breast.study.summary import lines_of
from breast.study.table import parse_table
from breast.study.verify import verify
from breast.text_table import read_text


def expected_anew(text: str, run: Path) -> str:
    """The table of expected values, brought up to date: where the run differs, its own value replaces the expected one. Rows that
    agree and comments stay as they are, so that a bound remains a bound."""
    verified = iter(verify(parse_table(text, "expected values"), run))
    lines = []
    for line in lines_of(text):
        if line and not line.startswith(("#", "file\t")):
            cells, found = line.split("\t"), next(verified)
            if found["verdict"] != "ok":
                cells[3] = found["computed"]
            line = "\t".join(cells)
        lines.append(line + "\n")
    return "".join(lines)


@kind("expected", "EXPECTED.tsv RUN", "the table of expected values, brought up to date: a row from which the run differs gets the value of the run")
def _expected(request: Request) -> str:
    return expected_anew(read_text(request.word(0)), request.path(1))
