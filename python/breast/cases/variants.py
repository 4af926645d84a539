# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies as data: the rows of a table are variants of a case."""
from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple, NoReturn

from ..command.make_name import plain_for_make
from ..command.nearest import suggestion
from ..errors import BreastError
from ..text_table import Table, parse_table
from .make_text import code_in, has_control
from .scan_identity import content_of

_COLUMNS = ("variant", "starts_at", "ends_at", "from", "given", "if")


@dataclass
class StudyBase:
    """The case from which the rows of a study start.

    run: folder of the case; variants are RUN/studies/STUDY/VARIANT. stages: all stages of the chain, in order. ends_at: stages at which
    a row without `ends_at` ends. attributes: the columns with options, and their values in the case. placeholders: the text that
    replaces {NAME} in a cell.
    """

    run: str
    stages: Sequence[str]
    ends_at: str
    attributes: dict[str, str] = field(default_factory=dict)
    placeholders: dict[str, str] = field(default_factory=dict)


class _Row(NamedTuple):
    table: Table
    cells: Mapping[str, str]
    study: str
    origin: str  # the row from which the study's rows come unless they say otherwise

    def cell(self, column: str) -> str:
        return self.cells.get(column, "")

    def fault(self, what: str) -> NoReturn:
        raise BreastError(f"{self.cell('variant') or '-'} {what}", self.table.name)


def _check_among(where: str, given: Iterable[str], known: Sequence[str]) -> None:
    for word in given:
        if word not in known:
            raise BreastError(f"'{word}' is none of {', '.join(known)}{suggestion(word, known)}", where)


def _check_cells(lines: str, file: str) -> None:
    # The error names a row by its first cell, which tells the user more than the number of its line.
    columns = 0
    for line in lines.split("\n"):
        cells = line.removesuffix("\r").split("\t")
        if cells == [""]:
            continue
        if any(map(has_control, cells)):
            raise BreastError(f"{cells[0]} holds a control character", file)
        columns = columns or len(cells)
        if len(cells) != columns:
            raise BreastError(f"{cells[0]} has {len(cells)} cells and not {columns}; separate cells by one tab, and write - for an "
                              "empty one", file)


def _options_in(text: str) -> list[tuple[str, str]]:
    """The options of a command line, each "--name" with the words up to the next one; "--name=value" is one word."""
    options: list[tuple[str, str]] = []
    for word in text.split():
        if word.startswith("--"):
            options.append((word.partition("=")[0], word))
        elif options:
            options[-1] = options[-1][0], f"{options[-1][1]} {word}"
    return options


def _options_without(text: str, other: str) -> str:
    """The options of `text` whose names do not occur in `other`."""
    named = {name for name, _ in _options_in(other)}
    return " ".join(option for name, option in _options_in(text) if name not in named)


def _options_with(text: str, added: str) -> str:
    """The options of `text` and those added, which replace options of the same name; of one that is given once for each part, as
    "--scale fat=50", the one of the same part."""
    def part(name: str, option: str) -> tuple[str, str]:
        value, equals, _ = option.removeprefix(name).strip(" =").partition("=")
        return name, value if equals else ""
    named = {part(*option) for option in _options_in(added)}
    return " ".join([*(option for name, option in _options_in(text) if part(name, option) not in named), added])


class Variant(NamedTuple):
    """A row as it is made: its folder, the folder from which it starts, the stages that it makes itself, those whose files an explicit rule
    of the makefile makes, its last stages, the folder on which it depends ("" if on none), its options by column, and what it leaves
    out."""

    study: str
    name: str
    folder: str
    origin: str
    stages: tuple[str, ...]
    given: tuple[str, ...]
    ends_at: tuple[str, ...]
    only_if: str
    options: dict[str, str]
    drops: str


class Studies:
    """Reads the rows of studies.

    The order in which studies are added matters, since a row may start from a row of an earlier study.

    Attributes:
        case: the options of the case. variants: of all rows added, by folder. names: of the studies, in order.
    """

    def __init__(self, base: StudyBase) -> None:
        self._base = base
        self._known: dict[str, dict[str, str]] = {base.run: dict(base.attributes)}
        self.case = base.attributes
        self.variants: dict[str, Variant] = {}
        self.names: list[str] = []

    def add(self, study: str, text: str, file: str, origin: str = "") -> None:
        """Adds the rows of the table `text` as variants of `origin`: STUDY/VARIANT, or the case if empty.

        Raises BreastError, naming `file` and where possible the row, for an unknown column or stage, for a name that is not valid or
        occurs twice, for a character that make or a shell would interpret as code, and for a row whose `from` is not a row above it.
        """
        bare = "".join(line + "\n" for line in text.split("\n") if not line.startswith("#"))
        names = sorted(self._base.placeholders)
        for name in names:
            bare = bare.replace("{" + name + "}", "")
        if code_in(bare):
            raise BreastError(f"the character {code_in(bare)} may not stand in a study, because make or a shell would read it as code; "
                              f"write the cell without it ({{NAME}} is one of {', '.join(names)})", file)
        _check_cells(bare, file)
        table = parse_table(text, file)
        _check_among(file, table.columns, [*_COLUMNS, *self._base.attributes])
        self.names.append(study)
        for row in table.records():
            self._add_row(_Row(table, row, study, origin))

    def _folder(self, study: str, variant: str) -> str:
        return f"{self._base.run}/studies/{'' if '/' in variant else study + '/'}{variant}"

    def _named(self, cell: str) -> str:
        for name in sorted(self._base.placeholders):
            cell = cell.replace("{" + name + "}", self._base.placeholders[name])
        return cell

    def _option(self, cell: str, before: str) -> str:
        if not cell:
            return before
        return _options_with(before, self._named(cell[1:])) if cell.startswith("+") and before else self._named(cell.removeprefix("+"))

    def _drops(self, row: _Row, origin: Mapping[str, str]) -> str:
        """What the cells of a row leave out, as "mechanics: --materials invivo; hexmesh: --muscle measured"."""
        parts = []
        for attribute in self._base.attributes:
            cell = row.cell(attribute)
            if cell and not cell.startswith("+"):
                left_out = _options_without(origin.get(attribute, ""), self._named(cell))
                parts += [f"{attribute}: {left_out}"] if left_out else []
        return "; ".join(parts)

    def _check_row(self, row: _Row, folder: str) -> None:
        name, start = row.cell("variant"), row.cell("starts_at")
        if not plain_for_make(name or "-") or "/" in name or folder in self._known:
            row.fault("is no name of a row of its own; give each row another name of letters, digits, points, dashes and underscores")
        if not start:
            row.fault("does not say in the column starts_at at which stage it begins; write one of " + ", ".join(self._base.stages))
        _check_among(row.table.name, [start], self._base.stages)
        _check_among(row.table.name, f"{row.cell('ends_at')} {row.cell('given')}".split(), self._base.stages)

    def _add_row(self, row: _Row) -> None:
        name = row.cell("variant")
        folder = self._folder(row.study, name)
        self._check_row(row, folder)
        start = row.cell("from") or row.origin
        origin = self._folder(row.study, start) if start else self._base.run
        before = self._known.get(origin)
        if before is None:
            row.fault(f"comes from '{row.cell('from')}', and no row above has this name; write the row from which it comes above it")
        only_if = row.cell("if") and self._folder(row.study, row.cell("if"))
        if only_if and only_if not in self._known:
            row.fault(f"depends on '{row.cell('if')}', and no row above has this name; write that row above it")
        own = {attribute: self._option(row.cell(attribute), before.get(attribute, "")) for attribute in self._base.attributes}
        if "materials" in own:
            own["mechanics"] = own["mechanics"].replace("--materials " + before["materials"], "--materials " + own["materials"])
            if own["materials"] != before["materials"]:
                # A file that a rule makes is a prerequisite of the row instead.
                known = os.path.isfile(own["materials"]) and not own["materials"].startswith(self._base.run + "/")
                own["content"] = content_of(own["materials"])[:12] if known else ""
        first = self._base.stages.index(row.cell("starts_at"))
        self.variants[folder] = Variant(
            row.study, name, folder, origin, tuple(self._base.stages[first:]), tuple(row.cell("given").split()),
            tuple((row.cell("ends_at") or self._base.ends_at).split()), only_if, own, self._drops(row, before))
        self._known[folder] = own
