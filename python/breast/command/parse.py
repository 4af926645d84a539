# SPDX-License-Identifier: GPL-3.0-or-later
"""The words of a command line, sorted and checked against a declaration."""
from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field

from ..errors import BreastError
from ..text_table import parse_number
from .declaration import Argument, Declaration, synopsis
from .nearest import nearest


@dataclass
class Tokens:
    """What was found: `options` by label; `unknown` options; `problem`: why the words cannot be sorted."""

    options: dict[str, list[str]] = field(default_factory=dict)
    positionals: list[str] = field(default_factory=list)
    unknown: list[str] = field(default_factory=list)
    problem: str = ""


def tokenize(tool: Declaration, words: Sequence[str]) -> Tokens:
    """Sorts the words; what follows a bare -- is positional."""
    tokens, left = Tokens(), list(words)
    while left:
        word = left.pop(0)
        if word == "--":
            tokens.positionals += left
            break
        if not re.match(r"-[^0-9]", word):  # a number may be negative
            tokens.positionals.append(word)
            continue
        name, given, value = word.partition("=") if word.startswith("--") else (word[:2], word[2:], word[2:])
        argument = tool.option(name)
        if argument is None:
            tokens.unknown.append(word)
            continue
        values = tokens.options.setdefault(argument.label, [])
        if argument.kind == "flag":
            if given:
                tokens.problem = f"{name} takes no value"
        elif given or left:
            values.append(value if given else left.pop(0))
        else:
            tokens.problem = f"{name} needs a value"
    return tokens


def check_value(argument: Argument, value: str) -> None:
    """Raises BreastError if the value is not of the argument's kind or outside its bounds."""
    label = argument.label
    if argument.kind == "integer":
        number = parse_number(value, label)
        if number != int(number):
            raise BreastError(f"{label}: '{value}' is not a whole number")
        if not argument.low <= number <= argument.high:
            raise BreastError(f"{label} {number:.15g}: must be {argument.bounds()}")
    if argument.kind == "choice" and value not in argument.choices:
        near = nearest(value, argument.choices)
        raise BreastError(f"{label}: '{value}' is none of {', '.join(argument.choices)}" +
                          (f"; did you mean '{near}'?" if near else ""))
    if not value:
        raise BreastError(f"{label}: is empty")


def _store(argument: Argument, values: list[str]) -> None:
    for value in values:
        check_value(argument, value)
    argument.store(values)


def _refuse_unknown(tool: Declaration, word: str) -> None:
    given = word.partition("=")[0]
    near = nearest(given, [name for a in tool.options + tool.common for name in a.names])
    raise BreastError(f"unknown option '{given}'; " + (f"did you mean '{near}'?" if near else f"see {tool.name} --help-all"))


def _assign_positionals(tool: Declaration, values: list[str]) -> None:
    wanted = tool.positionals
    if len(values) < len(wanted):
        raise BreastError(f"{wanted[len(values)].label} is missing; usage: {synopsis(tool)}")
    if len(values) > len(wanted) and not (wanted and wanted[-1].repeatable):
        raise BreastError(f"'{values[len(wanted)]}' is one argument too many; usage: {synopsis(tool)}")
    for i, argument in enumerate(wanted):
        _store(argument, values[i:] if argument.repeatable else values[i:i + 1])


def assign(tool: Declaration, tokens: Tokens) -> None:
    """Checks what was found and stores it. Raises BreastError for the first word that is wrong."""
    report = tokens.options.get("--report", [])
    if len(report) == 1:  # known even when something else is wrong
        _store(tool.option("--report"), report)
    if tokens.problem:
        raise BreastError(f"{tokens.problem}; usage: {synopsis(tool)}")
    if tokens.unknown:
        _refuse_unknown(tool, tokens.unknown[0])
    for argument in tool.options + tool.common:
        values = tokens.options.get(argument.label)
        if values is None:
            continue
        if len(values) > 1:
            raise BreastError(f"{argument.label} is given {len(values)} times; give it once")
        _store(argument, values)
    _assign_positionals(tool, tokens.positionals)
