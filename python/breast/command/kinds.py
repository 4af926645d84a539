# SPDX-License-Identifier: GPL-3.0-or-later
"""A program whose first word says what it does: `tabulate KIND ARGUMENT...`, `cases KIND ARGUMENT...`."""
from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from ..errors import BreastError
from .nearest import suggestion
from .tool import Tool

Make = Callable[..., Any]


@dataclass(frozen=True)
class Kind:
    """`arguments` as in "RUN VARIANT..." or "RUN [PHANTOM.json]"; what stands behind -- is a command."""

    name: str
    arguments: str
    help: str
    make: Make


class Kinds:
    """The kinds of one program, by name in the order of their declaration; what: what each is called, as "an action"."""

    def __init__(self, program: str, what: str) -> None:
        self._program, self._what = program, what
        self.known: dict[str, Kind] = {}

    def kind(self, name: str, arguments: str, help: str) -> Callable[[Make], Make]:
        """Declares what a function makes."""
        def declared(make: Make) -> Make:
            self.known[name] = Kind(name, arguments, help, make)
            return make

        return declared

    def called(self, name: str) -> Kind:
        """Raises BreastError with a suggestion if there is none."""
        if name not in self.known:
            hint = suggestion(name, self.known) or f"; {self._program} --help-all explains all"
            raise BreastError(f"'{name}' is not {self._what}{hint}")
        return self.known[name]

    def declare(self, tool: Tool) -> None:
        """The words of the program, with a rule that refuses too few or too many."""
        tool.word("KIND", f"{self._what}: {', '.join(self.known)}")
        tool.words("ARGUMENT", "its arguments: files, folders and names")
        tool.check(lambda: self._check_count(self.called(tool.args.kind), len(tool.args.argument)))

    def _check_count(self, kind: Kind, count: int) -> None:
        names = [name for name in kind.arguments.split() if name != "--"]
        least = sum(not name.startswith("[") for name in names)
        usage = f"usage: {self._program} {kind.name} {kind.arguments}"
        if count < least:
            raise BreastError(f"{kind.name}: has {count} arguments and needs {least}; {usage}")
        if count > len(names) and "..." not in kind.arguments:
            raise BreastError(f"{kind.name}: has {count} arguments and takes {len(names)}; {usage}")
