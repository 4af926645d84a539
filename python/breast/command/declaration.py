# SPDX-License-Identifier: GPL-3.0-or-later
"""The declaration of a program, from which its help and completion follow, in the form of the C++ programs (libbreast/cli/help.cpp)."""
from __future__ import annotations

import math
import os
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from .. import __version__

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


@dataclass
class Declaration:
    """A program: examples are pairs of command and explanation."""

    name: str
    summary: str
    paragraphs: list[str] = field(default_factory=list)
    citations: list[str] = field(default_factory=list)
    examples: list[tuple[str, str]] = field(default_factory=list)
    positionals: list[Argument] = field(default_factory=list)
    options: list[Argument] = field(default_factory=list)
    common: list[Argument] = field(default_factory=list)
    version: str = __version__

    def option(self, name: str) -> Argument | None:
        return next((a for a in self.options + self.common if name in a.names), None)

    def is_brief(self, option: Argument) -> bool:
        """Whether the short help lists it: one that is basic, and any if the program marks none as basic."""
        return option.basic or not any(a.basic for a in self.options)

    def by_topic(self) -> list[tuple[str, list[Argument]]]:
        """The headings of the options in the order of their first use, each with its options."""
        topics = dict.fromkeys(a.topic for a in self.options)
        return [("Options: " + topic if topic else "Options", [a for a in self.options if a.topic == topic]) for topic in topics]


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
