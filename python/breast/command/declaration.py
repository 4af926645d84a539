# SPDX-License-Identifier: GPL-3.0-or-later
"""The declaration of a program, from which its help and completion follow, in the form of the C++ programs (libbreast/cli/help.cpp)."""
from __future__ import annotations

import os
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from types import SimpleNamespace

from .. import __version__
from ..text_table import parse_number

_EXIT_CODES = (("0", "done"), ("1", "failed (disk, memory, library)"), ("2", "bad usage or bad input; nothing written"),
               ("3", "not converged; nothing written unless asked for"))


@dataclass
class Argument:
    """An option, or a positional argument if it has no names.

    kind: text, integer, choice, flag, input, output or folder.
    low, high: the bounds of an integer; endings: of the name of an output; repeatable: of the last positional argument, which takes all words.
    store: called with the list of checked values; with an empty list for a flag.
    """

    kind: str
    names: tuple[str, ...] = ()
    placeholder: str = ""
    help: str = ""
    default_text: str = ""
    choices: Sequence[str] = ()
    endings: Sequence[str] = ()
    low: int = 0
    high: int = 0
    repeatable: bool = False
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
        return f"{self.low} to {self.high}" if self.kind == "integer" else ""

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

    # ---- what the program is ----

    def describe(self, paragraph: str) -> None:
        self.paragraphs.append(paragraph)

    def cite(self, reference: str) -> None:
        self.citations.append(reference)

    def example(self, command: str, explanation: str) -> None:
        self.examples.append((command, explanation))

    # ---- positional arguments: args.placeholder in lower case, without its ending ----

    def word(self, placeholder: str, help: str, kind: str = "text") -> Argument:
        return self._positional(kind, placeholder, help, self._into(self._name(placeholder)))

    def words(self, placeholder: str, help: str, kind: str = "text") -> Argument:
        name = self._name(placeholder)
        argument = self._positional(kind, placeholder, help, lambda values: setattr(self.args, name, list(values)))
        argument.repeatable = True
        return argument

    # ---- options: args.name, without dashes at its beginning and with _ for those inside ----

    def flag(self, names: str, help: str) -> Argument:
        argument = self._option("flag", names, "", help, False)
        argument.store = lambda values: setattr(self.args, self._name(argument.label), True)
        return argument

    def text(self, names: str, placeholder: str, help: str, default: str = "") -> Argument:
        return self._option("text", names, placeholder, help, default)

    def choice(self, names: str, choices: Sequence[str], help: str, default: str = "") -> Argument:
        argument = self._option("choice", names, "NAME", help, default)
        argument.choices = choices
        return argument

    def integer(self, names: str, help: str, default: int, low: int, high: int) -> Argument:
        argument = self._option("integer", names, "N", help, default)
        argument.low, argument.high = low, high
        argument.store = self._into(self._name(argument.label), lambda text: int(parse_number(text, argument.label)))
        return argument

    def input_file(self, names: str, placeholder: str, help: str) -> Argument:
        return self._option("input", names, placeholder, help, "")

    def output_file(self, names: str, placeholder: str, help: str) -> Argument:
        argument = self._option("output", names, placeholder, help, "")
        argument.endings = _endings(placeholder)
        return argument

    def output_folder(self, names: str, help: str) -> Argument:
        return self._option("folder", names, "FOLDER", help, "")

    @staticmethod
    def _name(label: str) -> str:
        return label.split(".")[0].lstrip("-").lower().replace("-", "_")

    def _into(self, name: str, convert: Callable[[str], object] = str) -> Callable[[list[str]], None]:
        return lambda values: setattr(self.args, name, convert(values[0]))

    def _positional(self, kind: str, placeholder: str, help: str, store: Callable[[list[str]], None]) -> Argument:
        argument = Argument(kind, (), placeholder, help, store=store)
        self.positionals.append(argument)
        return argument

    def _option(self, kind: str, names: str, placeholder: str, help: str, default: object) -> Argument:
        argument = Argument(kind, tuple(names.split(",")), placeholder, help)
        name = self._name(argument.label)
        setattr(self.args, name, default)
        argument.default_text = "" if default is False else str(default)
        argument.store = self._into(name)
        self.options.append(argument)
        return argument


def _endings(placeholder: str) -> list[str]:
    """Those of "OUT.inp|OUT.feb": .inp and .feb."""
    return ["." + name.partition(".")[2] for name in placeholder.split("|") if "." in name]


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


def help_text(tool: Declaration, everything: bool = False) -> str:
    """The help of a terminal: the first paragraph and the program's own options; or everything."""
    name = _call_prefix() + tool.name
    out = [f"{name} - {tool.summary}\n\nUsage: {synopsis(tool)}\n"]
    out += [f"\n{_wrap(paragraph, 0)}\n" for paragraph in tool.paragraphs[:None if everything else 1]]
    out += [_listed("Arguments", tool.positionals), _listed("Options", tool.options)]
    if not everything:
        if tool.common:
            out.append("\n" + _wrap("Common options: " + ", ".join(a.usage() for a in tool.common), 2) + "\n")
        further = "also explains the common options and the exit codes" if tool.common else "has the whole description and the exit codes"
        out += [_examples(tool), "\n" + _wrap(f"{name} --help-all {further}", 2) + "\n"]
        return "".join(out)
    out += [_listed("Common options", tool.common), _examples(tool)]
    out.append("\nExit codes:\n" + "".join(f"  {code}  {meaning}\n" for code, meaning in _EXIT_CODES))
    if tool.citations:
        out.append("\nCitation:\n" + "".join(f"  {_wrap(citation, 4)}\n" for citation in tool.citations))
    return "".join(out)


def help_completion(tool: Declaration) -> str:
    """A line "--name<TAB>flag|file|value<TAB>choice choice" for each option, for the completion in a shell."""
    def kind(a: Argument) -> str:
        return "flag" if a.kind == "flag" else "file" if a.kind in ("input", "output", "folder") else "value"
    return "".join(f"{a.label}\t{kind(a)}\t{' '.join(a.choices)}\n" for a in tool.options + tool.common)
