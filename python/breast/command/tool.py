# SPDX-License-Identifier: GPL-3.0-or-later
"""A program: its arguments are declared one by one, then run with what was given.

    tool = Tool("cases", "reading and checking of cases")
    tool.word("KIND", "action")
    tool.integer("--cores", "cores of a case", 1, 1, 1024)
    tool.example("cases list patients", "list the cases of a cohort")
    sys.exit(tool.main(lambda run: run.print(run.args.kind)))

All programs have --report, --threads, --quiet, --help, --help-all and --version, and the exit codes 0 done, 1 failed, 2 bad usage or
input, 3 not converged. A failure is one line on stderr.
"""
from __future__ import annotations

import json
import os
import resource
import sys
import time
from collections.abc import Callable, Sequence
from types import SimpleNamespace

from ..errors import BreastError
from ..output import is_stream, write_text, written_by_us
from .declaration import Declaration, help_completion, help_text
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


class Tool(Declaration):
    """A declaration that can be run. The methods declare arguments in the order in which the help lists them."""

    def __init__(self, name: str, summary: str) -> None:
        super().__init__(name, summary)
        self._rules: list[Callable[[], None]] = []
        self.output_file("--report", "FILE.json", "write a machine-readable report, also in case of failure")
        self.integer("--threads", "number of threads", len(os.sched_getaffinity(0)), 1, 1024).default_text = "all cores"
        self.flag("--quiet", "print no progress and no warnings on stderr")
        self.flag("--help", "print a short help")
        self.flag("--help-all", "print the whole description and all options")
        self.flag("--version", "print the name and version")
        self.common, self.options = self.options, []

    def check(self, rule: Callable[[], None]) -> None:
        """A rule about several arguments, which raises BreastError."""
        self._rules.append(rule)

    # ---- the run ----

    def main(self, body: Callable[[Run], None], words: Sequence[str] | None = None) -> int:
        """Answers questions such as --help, or checks the words (sys.argv), runs `body` and reports. Returns the exit code."""
        words = list(sys.argv[1:] if words is None else words)
        answer = self._answer(words)
        if answer is not None:
            return self._complain(_outcome(lambda: _write_stdout(answer)))
        tokens = tokenize(self, words)
        run = Run(self.name, _history_command(self, words), self.args)
        run.report["inputs"] = [os.path.basename(value.rstrip("/")) for argument, value in
                                named_values(self, tokens) if argument.kind == "input"]
        outcome = _outcome(lambda: self._check(tokens))
        reportable = outcome[0] == 0 or _safe_report(self.args.report, tokens)
        if outcome[0] == 0:
            outcome = _outcome(lambda: (body(run), _write_stdout("".join(run.printed))))
        if outcome[0] == 0 and not self.args.quiet:
            for note in run.notes:
                print(f"{self.name}: {note}", file=sys.stderr)
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
        return next((page(self) for name, page in pages.items() if name in asked), None)

    def _check(self, tokens: Tokens) -> None:
        assign(self, tokens)
        check_paths(self, tokens)
        for rule in self._rules:
            rule()

    def _complain(self, outcome: tuple[int, str, str]) -> int:
        if outcome[0] != 0:
            sys.stdout = open(os.devnull, "w")  # what could not be written is not tried again at the end
            if outcome[2]:
                os.write(2, f"{self.name}: {outcome[2]}\n".encode("utf-8", "surrogateescape"))
        return outcome[0]


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
