# SPDX-License-Identifier: GPL-3.0-or-later
"""The kinds of tables and pages that tabulate makes."""
from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from ..command.nearest import nearest
from ..errors import BreastError
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


@dataclass(frozen=True)
class Kind:
    """`arguments` as in "RUN VARIANT..." or "RUN [PHANTOM.json]"."""

    name: str
    arguments: str
    help: str
    make: Callable[[Request], Table | str]

    def check_count(self, count: int) -> None:
        """Raises BreastError for too few or too many words."""
        names = self.arguments.split()
        least = sum(not name.startswith("[") for name in names)
        usage = f"usage: tabulate {self.name} {self.arguments}"
        if count < least:
            raise BreastError(f"{self.name}: has {count} arguments and needs {least}; {usage}")
        if count > len(names) and not names[-1].endswith("..."):
            raise BreastError(f"{self.name}: has {count} arguments and takes {len(names)}; {usage}")


KINDS: dict[str, Kind] = {}
Make = Callable[[Request], "Table | str"]


def kind(name: str, arguments: str, help: str) -> Callable[[Make], Make]:
    """Declares what a function makes of a request: a table, or the text for stdout."""
    def declared(make: Make) -> Make:
        KINDS[name] = Kind(name, arguments, help, make)
        return make

    return declared


def kind_called(name: str) -> Kind:
    if name in KINDS:
        return KINDS[name]
    near = nearest(name, KINDS)
    hint = f"did you mean '{near}'?" if near else "tabulate --help-all explains all kinds"
    raise BreastError(f"'{name}' is not a kind of table or page; {hint}")
