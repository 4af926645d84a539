# SPDX-License-Identifier: GPL-3.0-or-later
"""The declaration of a program, from which its help and completion follow, in the form of the C++ programs (libbreast/cli/help.cpp)."""
from __future__ import annotations

import math
import os
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from types import SimpleNamespace

from .. import __version__
from ..errors import Failed
from ..text_table import parse_number

_EXIT_CODES = (("0", "done"), ("1", "failed (disk, memory, library)"), ("2", "bad usage or bad input; nothing written"),
               ("3", "not converged; nothing written unless asked for"))


@dataclass
class Argument:
    """An option, or a positional argument if it has no names.

    kind: text, number, integer, choice, flag, input, output or folder.
    low, high: the bounds of a number; endings: of the name of an output; repeatable: of the last positional argument, which takes all words.
    topic: heading under which all options are listed, empty for the first; basic: whether the short help lists it.
    store: called with the list of checked values; with an empty list for a flag.
    """

    kind: str
    names: tuple[str, ...] = ()
    placeholder: str = ""
    help: str = ""
    default_text: str = ""
    choices: Sequence[str] = ()
    endings: Sequence[str] = ()
    low: float = -math.inf
    high: float = math.inf
    repeatable: bool = False
    topic: str = ""
    basic: bool = False
    store: Callable[[list[str]], None] = lambda values: None

    @property
    def label(self) -> str:
        """Its name in messages: the longest name, or the placeholder."""
        return self.names[-1] if self.names else self.placeholder

    def usage(self) -> str:
        """As in "-o, --output FILE"."""
        if not self.names:
            return self.placeholder + ("..." if self.repeatable else "")
        text = ", ".join(self.names)
        if self.kind == "choice":
            return text + " " + "|".join(self.choices)
        return text if self.kind == "flag" else text + " " + self.placeholder

    def bounds(self) -> str:
        if self.kind not in ("number", "integer"):
            return ""
        above, below = math.isfinite(self.low), math.isfinite(self.high)
        if above and below:
            return f"{number_text(self.low)} to {number_text(self.high)}"
        return f"at least {number_text(self.low)}" if above else f"at most {number_text(self.high)}" if below else ""

    def explained(self) -> str:
        """The help with its remarks: "thickness (1 to 95; default: 50)"."""
        parts = [self.bounds(), "default: " + self.default_text if self.default_text else ""]
        remarks = "; ".join(part for part in parts if part)
        return f"{self.help} ({remarks})" if remarks else self.help


class Declaration:
    """A program as its help lists it; the methods declare its arguments in this order, and `args` has their values by name.

    common: options that every program has; version: for the help. examples: pairs of command and explanation.
    """

    version = __version__

    def __init__(self, name: str, summary: str) -> None:
        self.name, self.summary = name, summary
        self.paragraphs: list[str] = []
        self.citations: list[str] = []
        self.examples: list[tuple[str, str]] = []
        self.positionals: list[Argument] = []
        self.options: list[Argument] = []
        self.common: list[Argument] = []
        self.args = SimpleNamespace()

    def option(self, name: str) -> Argument | None:
        return next((a for a in self.options + self.common if name in a.names), None)

    def is_brief(self, option: Argument) -> bool:
        """Whether the short help lists it: one that is basic, and any if the program marks none as basic."""
        return option.basic or not any(a.basic for a in self.options)

    def by_topic(self) -> list[tuple[str, list[Argument]]]:
        """The headings of the options in the order of their first use, each with its options."""
        topics = dict.fromkeys(a.topic for a in self.options)
        return [("Options: " + topic if topic else "Options", [a for a in self.options if a.topic == topic]) for topic in topics]

    # ---- what the program is ----

    def describe(self, paragraph: str) -> None:
        self.paragraphs.append(paragraph)

    def cite(self, reference: str) -> None:
        self.citations.append(reference)

    def example(self, command: str, explanation: str) -> None:
        self.examples.append((command, explanation))

    def topic(self, name: str, options: Sequence[str]) -> None:
        """Lists options, which are declared before, under a heading of their own; each has at most one."""
        for option in options:
            argument = self._declared(option)
            if argument.topic:
                raise Failed(f"{self.name} lists {option} under {argument.topic} and under {name}")
            argument.topic = name

    def basic(self, options: Sequence[str]) -> None:
        """Marks the options that --help lists, about ten; --help-all lists all of them."""
        for option in options:
            self._declared(option).basic = True

    # ---- positional arguments: args.placeholder in lower case, without its ending ----

    def word(self, placeholder: str, help: str, kind: str = "text") -> Argument:
        return self._positional(kind, placeholder, help, self._into(self._name(placeholder)))

    def words(self, placeholder: str, help: str, kind: str = "text") -> Argument:
        name = self._name(placeholder)
        argument = self._positional(kind, placeholder, help, lambda values: setattr(self.args, name, list(values)))
        argument.repeatable = True
        return argument

    def inputs(self, placeholder: str, help: str) -> Argument:
        return self.words(placeholder, help, "input")

    # ---- options: args.name, without dashes at its beginning and with _ for those inside ----

    def flag(self, names: str, help: str) -> Argument:
        argument = self._option("flag", names, "", help, False)
        argument.store = self._set(self._name(argument.label))
        return argument

    def text(self, names: str, placeholder: str, help: str, default: str = "") -> Argument:
        return self._option("text", names, placeholder, help, default)

    def choice(self, names: str, choices: Sequence[str], help: str, default: str = "") -> Argument:
        argument = self._option("choice", names, "NAME", help, default)
        argument.choices = choices
        return argument

    def number(self, names: str, unit: str, help: str, default: float, low: float = -math.inf, high: float = math.inf) -> Argument:
        argument = self._option("number", names, unit, help, default)
        argument.low, argument.high = low, high
        argument.store = self._into(self._name(argument.label), lambda text: parse_number(text, argument.label))
        return argument

    def integer(self, names: str, unit: str, help: str, default: int, low: int, high: int) -> Argument:
        argument = self._option("integer", names, unit, help, default)
        argument.low, argument.high = low, high
        argument.store = self._into(self._name(argument.label), lambda text: int(parse_number(text, argument.label)))
        return argument

    def input_file(self, names: str, placeholder: str, help: str) -> Argument:
        return self._option("input", names, placeholder, help, "")

    def output_file(self, names: str, placeholder: str, help: str) -> Argument:
        argument = self._option("output", names, placeholder, help, "")
        argument.endings = _endings(placeholder)
        return argument

    def output_folder(self, names: str, placeholder: str, help: str) -> Argument:
        return self._option("folder", names, placeholder, help, "")

    @staticmethod
    def _name(label: str) -> str:
        return label.split(".")[0].lstrip("-").lower().replace("-", "_")

    def _into(self, name: str, convert: Callable[[str], object] = str) -> Callable[[list[str]], None]:
        return lambda values: setattr(self.args, name, convert(values[0]))

    def _set(self, name: str) -> Callable[[list[str]], None]:
        return lambda values: setattr(self.args, name, True)

    def _declared(self, name: str) -> Argument:
        found = next((a for a in self.options if a.label == name), None)
        if found is None:
            raise Failed(f"{self.name} names {name}, which it never declared")
        return found

    def _positional(self, kind: str, placeholder: str, help: str, store: Callable[[list[str]], None]) -> Argument:
        argument = Argument(kind, (), placeholder, help, store=store)
        self.positionals.append(argument)
        return argument

    def _option(self, kind: str, names: str, placeholder: str, help: str, default: object) -> Argument:
        argument = Argument(kind, tuple(names.split(",")), placeholder, help)
        name = self._name(argument.label)
        setattr(self.args, name, default)
        if isinstance(default, (int, float)) and not isinstance(default, bool):
            argument.default_text = number_text(default)
        elif isinstance(default, str):
            argument.default_text = default
        argument.store = self._into(name)
        self.options.append(argument)
        return argument


def _endings(placeholder: str) -> list[str]:
    """Those of "OUT.inp|OUT.feb": .inp and .feb."""
    return ["." + name.partition(".")[2] for name in placeholder.split("|") if "." in name]


def number_text(value: float) -> str:
    """The shortest text that reads back as the same number, as 5 and 0.1."""
    return str(int(value)) if float(value).is_integer() and abs(value) < 1e15 else repr(float(value))


def _call_prefix() -> str:
    # An installed tool lies in libexec/breast, where no shell finds it: it is called through the command `breast`.
    folder = os.path.dirname(os.path.realpath(sys.argv[0]))
    return "breast " if folder.endswith("/libexec/breast") else ""


def synopsis(tool: Declaration) -> str:
    return " ".join([_call_prefix() + tool.name, *(a.usage() for a in tool.positionals), "[options]"])


def _wrap(text: str, indent: int) -> str:
    """Lines of at most 88 characters; all but the first are indented."""
    import textwrap
    lines = textwrap.wrap(text, 88 - indent, break_long_words=False, break_on_hyphens=False)
    return ("\n" + " " * indent).join(lines)


def _listed(title: str, arguments: Sequence[Argument]) -> str:
    return f"\n{title}:\n" * bool(arguments) + "".join(f"  {a.usage()}\n      {_wrap(a.explained(), 6)}\n" for a in arguments)


def _examples(tool: Declaration) -> str:
    prefix, out = _call_prefix(), "\nExamples:\n" * bool(tool.examples)
    for command, explanation in tool.examples:
        own = prefix if command.startswith(tool.name + " ") else ""
        out += f"  {own}{command}\n      {_wrap(explanation, 6)}\n"
    return out


def _further(tool: Declaration) -> str:
    """What the full help has beyond the short one."""
    more = [a for a in tool.options if not tool.is_brief(a)]
    if not more:
        return "also explains the common options and the exit codes" if tool.common else "has the whole description and the exit codes"
    topics = ", ".join(dict.fromkeys(a.topic for a in more if a.topic))
    return f"shows {len(more)} further option{'s' * (len(more) > 1)}" + (f" by topic: {topics}" if topics else "")


def help_text(tool: Declaration, everything: bool = False) -> str:
    """The help of a terminal: the first paragraph and the options that most people need; or everything, the options by topic."""
    name = _call_prefix() + tool.name
    out = [f"{name} - {tool.summary}\n\nUsage: {synopsis(tool)}\n"]
    out += [f"\n{_wrap(paragraph, 0)}\n" for paragraph in tool.paragraphs[:None if everything else 1]]
    out.append(_listed("Arguments", tool.positionals))
    if not everything:
        out.append(_listed("Options", [a for a in tool.options if tool.is_brief(a)]))
        if tool.common:
            out.append("\n" + _wrap("Common options: " + ", ".join(a.usage() for a in tool.common), 2) + "\n")
        out += [_examples(tool), "\n" + _wrap(f"{name} --help-all {_further(tool)}", 2) + "\n"]
        return "".join(out)
    out += [_listed(title, arguments) for title, arguments in [*tool.by_topic(), ("Common options", tool.common)]]
    out.append(_examples(tool))
    out.append("\nExit codes:\n" + "".join(f"  {code}  {meaning}\n" for code, meaning in _EXIT_CODES))
    if tool.citations:
        out.append("\nCitation:\n" + "".join(f"  {_wrap(citation, 4)}\n" for citation in tool.citations))
    return "".join(out)


def help_completion(tool: Declaration) -> str:
    """A line "--name<TAB>flag|file|value<TAB>choice choice" for each option, for the completion in a shell."""
    def kind(a: Argument) -> str:
        return "flag" if a.kind == "flag" else "file" if a.kind in ("input", "output", "folder") else "value"
    return "".join(f"{a.label}\t{kind(a)}\t{' '.join(a.choices)}\n" for a in tool.options + tool.common)
