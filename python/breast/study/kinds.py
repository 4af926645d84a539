# SPDX-License-Identifier: GPL-3.0-or-later
"""The kinds of tables and pages that tabulate makes."""
from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from ..command.kinds import Kinds
from .table import Table, read_table


@dataclass(frozen=True)
class Request:
    """One call.

    Attributes:
        words: arguments of the kind.
        pipelines: folder of the pipeline's own tables: advice.tsv, limits.txt, paper/, invivo/.
        calibrated: report of a phantom whose preset was fitted to the chain, or None.
        side: of that phantom.
    """

    words: tuple[str, ...]
    pipelines: Path
    calibrated: Path | None = None
    side: str = ""

    def word(self, place: int, default: str = "") -> str:
        return self.words[place] if place < len(self.words) else default

    def rest(self, first: int) -> list[str]:
        return list(self.words[first:])

    def path(self, place: int) -> Path:
        return Path(self.words[place])

    def table(self, place: int) -> Table:
        return read_table(self.words[place])

    @property
    def remark(self) -> str:
        """What stands in the rows to which the preset was fitted."""
        return "calibrated to this row" if self.calibrated else ""


KINDS = Kinds("tabulate", "a kind of table or page")
kind = KINDS.kind
"""Declares what a function makes of a request: a table, or the text for stdout."""
