# SPDX-License-Identifier: GPL-3.0-or-later
"""A stage of the pipeline as the terminal shows it: one line with its name, view, what it found, and seconds.

Everything the program says is appended to log.txt in the folder of the stage's record, each line with the name of its stage, because two
stages may run at once.
"""
from __future__ import annotations

import contextlib
import json
import os
import re
import sys
import time
from collections.abc import Mapping, Sequence
from pathlib import Path

from ..command.child import follow_child
from ..errors import Failed
from ..output import write_text

# What a program found, from its report: a text in which {key/key:format} is replaced.
_FOUND = {
    "phantom": "",
    "segment": "{breast_ml:.0f} ml, {density_percent:.0f} % fibroglandular",
    "fit-hermite": "skin within {fit/p95_mm:.1f} mm, chest wall within {wall/p95_mm:.1f} mm (95 %)",
    "hexmesh": "{elements} elements, least scaled Jacobian {min_scaled_jacobian:.2f}",
    "backward": "{newton_iterations} iterations, mesh error about {error_estimate_mm:.2f} mm",
    "forward": "{newton_iterations} iterations, mesh error about {error_estimate_mm:.2f} mm",
    "compress": "{initial_thickness_mm:.0f} to {thickness_mm:.0f} mm, {force_N:.0f} N",
    "cc2mlo": "curve of {curve_mm:.0f} mm",
}


def _view_of(words: Sequence[str], stage: str) -> str:
    if "--view" in words[:-1]:
        return words[words.index("--view") + 1]
    part = re.match(r"(?:truth-)?(cc|mlo)\b", stage)
    return part[1].upper() if part else ""


def label_of(stage: str, folder: str, words: Sequence[str]) -> str:
    """The name of a stage for people: its program and view, after the variant of a study, as "softer: compress CC"."""
    variant = re.search(r"/studies/(.+)$", folder)
    program = words[words.index("--") + 1] if "--" in words[:-1] else words[0]
    label = " ".join(filter(None, [os.path.basename(program), _view_of(words, stage)]))
    return f"{variant[1]}: {label}" if variant else label


def found_in(report: Mapping[str, object]) -> str:
    """What a report says of the result, and the number of its warnings; "" if nothing is known of its program."""
    def value(match: re.Match[str]) -> str:
        at: object = report
        for key in match[1].split("/"):
            at = at[key]  # type: ignore[index]
        return format(at, match[2] or "")
    parts = []
    try:
        parts.append(re.sub(r"\{([^:}]+):?([^}]*)\}", value, _FOUND.get(str(report.get("tool")), "")))
    except (KeyError, TypeError, ValueError):
        pass  # a program of the user's, or a solve that ended early: its reason is what it found
    if report.get("status") not in ("ok", "converged") and report.get("reason"):
        parts.append(str(report["reason"]))
    warnings = len(report.get("warnings") or ())  # type: ignore[arg-type]
    if warnings:
        parts.append(f"{warnings} warning{'s' if warnings > 1 else ''}")
    return ", ".join(filter(None, parts))


def _report_of(words: Sequence[str]) -> dict[str, object]:
    file = words[words.index("--report") + 1] if "--report" in words[:-1] else ""
    try:
        with open(file, encoding="utf-8", errors="replace") as stream:
            report = json.load(stream)
    except (OSError, ValueError):
        return {}
    return report if isinstance(report, dict) else {}


class _Screen:
    """The stage's line on stderr; while the stage runs, and nothing else writes there, the seconds that have passed."""

    def __init__(self, label: str) -> None:
        self.label, self.start = label, time.monotonic()
        self.alive = sys.stderr.isatty() and not re.search(r"-j ?([2-9]|1[0-9])", os.environ.get("MAKEFLAGS", ""))

    def tick(self) -> None:
        if self.alive:
            os.write(2, f"\r\033[K{self.label:28} {self.seconds()} s".encode())

    def end(self, text: str) -> None:
        clear = "\r\033[K" if self.alive else ""
        os.write(2, f"{clear}{text}\n".encode("utf-8", "surrogateescape"))

    def seconds(self) -> int:
        return round(time.monotonic() - self.start)


def run_stage(record: Path, settings: str, words: Sequence[str], prints: Path | None = None) -> None:
    """Runs the program of a stage and records its settings when it has succeeded.

    The record goes before the program starts: a stage that is stopped has none and is run again, whatever the settings then are.

    Args:
        record: FOLDER/.STAGE.settings. settings: the text that make compares with it.
        words: the program with its arguments.
        prints: file of what the program prints to stdout, complete or absent; its messages alone are then in the log.

    Raises:
        Failed: the program failed; how it ended and where to look has been said, and the exit code is that of the program.
    """
    stage, folder = record.name.removeprefix(".").removesuffix(".settings"), str(record.parent)
    label = label_of(stage, folder, words) + (f" {prints.name}" if prints else "")
    record.parent.mkdir(parents=True, exist_ok=True)
    record.unlink(missing_ok=True)
    log, screen, said = record.parent / "log.txt", _Screen(label), [""]
    with open(log, "a", encoding="utf-8", errors="surrogateescape", buffering=1) as file:
        file.write(f"{time.strftime('%H:%M:%S')} {label}: {' '.join(words)}\n")

        def say(line: str) -> None:
            said.append(line)
            file.write(f"{label}: {line}\n")
        with contextlib.ExitStack() as stack:
            part = prints and prints.with_name(prints.name + ".part")
            code = follow_child(words, say, screen.tick, stack.enter_context(open(part, "wb")) if part else None)
        if prints and part and code == 0:
            part.replace(prints)
    if code != 0:
        screen.end(next(filter(None, reversed(said)), label))
        screen.end(f"{label} ended with exit code {code} after {screen.seconds()} s: see {log}")
        failed = Failed("")  # nothing more to say
        failed.exit_code = code
        raise failed
    screen.end(f"{label:28} " + ", ".join(filter(None, [found_in(_report_of(words)), f"{screen.seconds()} s"])))
    write_text(record, settings + "\n")
