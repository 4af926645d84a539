# SPDX-License-Identifier: GPL-3.0-or-later
"""A program: its arguments are declared one by one, then run with what was given.

    tool = Tool("cases", "reading and checking of cases")
    tool.word("KIND", "action")
    tool.integer("--cores", "N", "cores of a case", 1, 1, 1024)
    tool.example("cases list patients", "list the cases of a cohort")
    sys.exit(tool.main(lambda run: run.print(run.args.kind)))

All programs have --report, --threads, --quiet, --help, --help-all and --version, and the exit codes 0 done, 1 failed, 2 bad usage or
input, 3 not converged. A failure is one line on stderr.
"""
from __future__ import annotations

import json
import math
import os
import resource
import sys
import time
from collections.abc import Callable, Sequence
from types import SimpleNamespace

from ..errors import BreastError, Failed
from ..output import is_stream, write_text, written_by_us
from ..text_table import parse_number
from .declaration import Argument, Declaration, help_completion, help_text, number_text
from .parse import Tokens, assign, tokenize
from .paths import check_paths, named_values


class Run:
    """What a program works with: args (the values by name, as args.cores), the report, and its output on stdout."""

    def __init__(self, tool: str, command: str, args: SimpleNamespace) -> None:
        self.args = args
        self.report: dict[str, object] = {
            "tool": tool, "version": Declaration.version, "command": command, "inputs": [],
            "date": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime()), "status": "ok", "reason": ""}
        self.printed: list[str] = []
        self.notes: list[str] = []

    def print(self, text: str) -> None:
        """Text for stdout, which is written when the program has succeeded."""
        self.printed.append(text)

    def remark(self, text: str) -> None:
        self.report.setdefault("remarks", []).append(text)
        self.notes.append(text)


class Tool:
    """A declaration that can be run. The methods declare arguments in the order in which the help lists them."""

    def __init__(self, name: str, summary: str) -> None:
        self.declaration = Declaration(name, summary)
        self.args = SimpleNamespace(report="", threads=len(os.sched_getaffinity(0)), quiet=False)
        self._rules: list[Callable[[], None]] = []
        common = self.declaration.common
        common.append(Argument("output", ("--report",), "FILE.json", "write a machine-readable report, also in case of failure",
                               endings=(".json",), store=self._into("report")))
        common.append(Argument("integer", ("--threads",), "N", "number of threads", "all cores", low=1, high=1024,
                               store=self._into("threads", int)))
        common.append(Argument("flag", ("--quiet",), "", "print no progress and no warnings on stderr", store=self._set("quiet")))
        common.append(Argument("flag", ("--help",), "", "print a short help"))
        common.append(Argument("flag", ("--help-all",), "", "print the whole description and all options by topic"))
        common.append(Argument("flag", ("--version",), "", "print the name and version"))

    # ---- what the program is ----

    def describe(self, paragraph: str) -> None:
        self.declaration.paragraphs.append(paragraph)

    def cite(self, reference: str) -> None:
        self.declaration.citations.append(reference)

    def example(self, command: str, explanation: str) -> None:
        self.declaration.examples.append((command, explanation))

    def topic(self, name: str, options: Sequence[str]) -> None:
        """Lists options, which are declared before, under a heading of their own; each has at most one."""
        for option in options:
            argument = self._declared(option)
            if argument.topic:
                raise Failed(f"{self.declaration.name} lists {option} under {argument.topic} and under {name}")
            argument.topic = name

    def basic(self, options: Sequence[str]) -> None:
        """Marks the options that --help lists, about ten; --help-all lists all of them."""
        for option in options:
            self._declared(option).basic = True

    def check(self, rule: Callable[[], None]) -> None:
        """A rule about several arguments, which raises BreastError."""
        self._rules.append(rule)

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

    # ---- the run ----

    def main(self, body: Callable[[Run], None], words: Sequence[str] | None = None) -> int:
        """Answers questions such as --help, or checks the words (sys.argv), runs `body` and reports. Returns the exit code."""
        words = list(sys.argv[1:] if words is None else words)
        answer = self._answer(words)
        if answer is not None:
            return self._complain(_outcome(lambda: _write_stdout(answer)))
        tokens = tokenize(self.declaration, words)
        run = Run(self.declaration.name, _history_command(self.declaration, words), self.args)
        run.report["inputs"] = [os.path.basename(value.rstrip("/")) for argument, value in
                                named_values(self.declaration, tokens) if argument.kind == "input"]
        outcome = _outcome(lambda: self._check(tokens))
        reportable = outcome[0] == 0 or _safe_report(self.args.report, tokens)
        if outcome[0] == 0:
            outcome = _outcome(lambda: (body(run), _write_stdout("".join(run.printed))))
        if outcome[0] == 0 and not self.args.quiet:
            for note in run.notes:
                print(f"{self.declaration.name}: {note}", file=sys.stderr)
        self._complain(outcome)
        if reportable and self.args.report:
            reported = _outcome(lambda: write_text(self.args.report, _report_text(run, outcome, tokens)))
            if outcome[0] == 0:
                return self._complain(reported)
        return outcome[0]

    def _answer(self, words: list[str]) -> str | None:
        asked = words[:words.index("--")] if "--" in words else words
        pages = {"--help": help_text, "--help-all": lambda d: help_text(d, everything=True),
                 "--version": lambda d: f"{d.name} (libbreast) {d.version}\n", "--help-completion": help_completion}
        return next((page(self.declaration) for name, page in pages.items() if name in asked), None)

    def _check(self, tokens: Tokens) -> None:
        assign(self.declaration, tokens)
        check_paths(self.declaration, tokens)
        for rule in self._rules:
            rule()

    def _complain(self, outcome: tuple[int, str, str]) -> int:
        if outcome[0] != 0:
            sys.stdout = open(os.devnull, "w")  # what could not be written is not tried again at the end
            if outcome[2]:
                os.write(2, f"{self.declaration.name}: {outcome[2]}\n".encode("utf-8", "surrogateescape"))
        return outcome[0]

    @staticmethod
    def _name(label: str) -> str:
        return label.split(".")[0].lstrip("-").lower().replace("-", "_")

    def _into(self, name: str, convert: Callable[[str], object] = str) -> Callable[[list[str]], None]:
        return lambda values: setattr(self.args, name, convert(values[0]))

    def _set(self, name: str) -> Callable[[list[str]], None]:
        return lambda values: setattr(self.args, name, True)

    def _declared(self, name: str) -> Argument:
        found = next((a for a in self.declaration.options if a.label == name), None)
        if found is None:
            raise Failed(f"{self.declaration.name} names {name}, which it never declared")
        return found

    def _positional(self, kind: str, placeholder: str, help: str, store: Callable[[list[str]], None]) -> Argument:
        argument = Argument(kind, (), placeholder, help, store=store)
        self.declaration.positionals.append(argument)
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
        self.declaration.options.append(argument)
        return argument


def _endings(placeholder: str) -> list[str]:
    """Those of "OUT.inp|OUT.feb": .inp and .feb."""
    return ["." + name.partition(".")[2] for name in placeholder.split("|") if "." in name]


def _outcome(work: Callable[[], object]) -> tuple[int, str, str]:
    """The exit code, status and reason with which the work ends."""
    try:
        work()
    except BreastError as error:
        return error.exit_code, error.status, _printable(str(error))
    except MemoryError:
        return 1, "failed", "out of memory"
    except KeyboardInterrupt:
        return 130, "failed", "interrupted"
    except OSError as error:
        where = f"{error.filename}: " if error.filename else ""
        return 1, "failed", _printable(where + (error.strerror or str(error)))
    return 0, "ok", ""


def _printable(text: str) -> str:
    # Text from a file that a message quotes must not contain control sequences for the terminal.
    return "".join(" " if c in "\t\r\n" else "?" if c < " " or c == "\x7f" else c for c in text)


def _write_stdout(text: str) -> None:
    data = text.encode("utf-8", "surrogateescape")
    try:
        while data:
            data = data[os.write(1, data):]
    except OSError:
        raise OSError("stdout cannot be written") from None


def _report_text(run: Run, outcome: tuple[int, str, str], tokens: Tokens) -> str:
    if outcome[0] != 0:
        reason = outcome[2]
        for value in [*tokens.positionals, *(v for values in tokens.options.values() for v in values)]:
            folder = value.rpartition("/")[0]
            if folder:  # a report may be sent to somebody: it names files, not the folders they lie in
                reason = reason.replace(folder + "/", "")
        run.report["status"], run.report["reason"] = outcome[1], reason
    used = resource.getrusage(resource.RUSAGE_SELF)
    run.report["seconds"] = {"total": round(time.clock_gettime(time.CLOCK_BOOTTIME) - _started(), 3)}
    run.report["cpu_seconds"] = round(used.ru_utime + used.ru_stime, 3)
    run.report["peak_mb"] = used.ru_maxrss / 1024
    return json.dumps(run.report, indent=2, ensure_ascii=False) + "\n"


def _started() -> float:
    """When this process started, in seconds of CLOCK_BOOTTIME."""
    with open("/proc/self/stat", encoding="utf-8", errors="replace") as file:
        return int(file.read().rpartition(")")[2].split()[19]) / os.sysconf("SC_CLK_TCK")


def _safe_report(file: str, tokens: Tokens) -> bool:
    """Whether a report may be written after a usage error: it must not replace a file named for another purpose, nor any that is
    no report."""
    if not file or is_stream(file):
        return bool(file)
    others = [*tokens.positionals, *(v for name, values in tokens.options.items() if name != "--report" for v in values)]
    return (file.endswith(".json") and (not os.path.exists(file) or written_by_us(file)) and
            all(os.path.realpath(other) != os.path.realpath(file) for other in others))


def _history_command(tool: Declaration, words: list[str]) -> str:
    """The command as histories state it: without folders, and without what says only how it was run."""
    parts, left = [tool.name], list(words)
    while left:
        word = left.pop(0)
        name, equals, value = word.partition("=") if word.startswith("--") else (word, "", "")
        common = next((a for a in tool.common if name in a.names), None)
        if common is not None:
            if common.kind != "flag" and not equals and left:
                left.pop(0)
            continue
        bare = (value if equals else word).rstrip("/") or "/"
        parts.append(name + "=" + bare.rpartition("/")[2] if equals else bare.rpartition("/")[2] or bare)
    return " ".join(parts)
