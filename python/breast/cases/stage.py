# SPDX-License-Identifier: GPL-3.0-or-later
"""A stage of the pipeline as the terminal shows it: one line with its name, view, what it found, and seconds.

Everything the program says is appended to log.txt in the folder of the stage's record, each line with the name of its stage, because two
stages may run at once.
"""
from __future__ import annotations

import contextlib
import os
import re
import sys
import time
from collections.abc import Mapping, Sequence
from pathlib import Path

from ..command.child import follow_child
from ..errors import Failed
from ..output import write_text
from .compression import report_of, why_not_made

NOT_CONVERGED = 3
"""Exit code of a program whose solve has no result."""
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
# Stages of the chain, each of which has a program or a view of its own.
_OF_CHAIN = frozenset(("labels", "geometry", "mesh", "reference", "supine", "cc", "mlo", "cc-mammogram", "mlo-mammogram", "curve"))


def _view_of(words: Sequence[str], stage: str) -> str:
    if "--view" in words[:-1]:
        return words[words.index("--view") + 1]
    part = re.match(r"(?:truth-)?(cc|mlo)\b", stage)
    return part[1].upper() if part else ""


def label_of(stage: str, folder: str, words: Sequence[str], prints: Path | None = None) -> str:
    """The name of a stage for people: its program and view, after the variant of a study, as "softer: compress CC".

    Several stages of a run may have one program. Those beside the chain add the file that the program prints, or their own name unless
    the label contains it already: "forward (supine-cut-fixed)".
    """
    variant = re.search(r"/studies/(.+)$", folder)
    program = words[words.index("--") + 1] if "--" in words[:-1] else words[0]
    label = " ".join(filter(None, [os.path.basename(program), _view_of(words, stage)]))
    if prints:
        label += f" {prints.name}"
    elif stage not in _OF_CHAIN and not set(stage.split("-")) <= set(re.split("[ -]", label.lower())):
        label += f" ({stage})"
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


def in_red(text: str) -> str:
    """Text for stderr, red on a terminal."""
    return f"\033[31m{text}\033[0m" if sys.stderr.isatty() else text


class _Screen:
    """The stage's line on stderr; while the stage runs, and nothing else writes there, the seconds that have passed."""

    def __init__(self, label: str) -> None:
        self.label, self.start = label, time.monotonic()
        self.alive = sys.stderr.isatty() and not re.search(r"-j ?([2-9]|1[0-9])", os.environ.get("MAKEFLAGS", ""))

    def tick(self) -> None:
        if self.alive:
            os.write(2, f"\r\033[K{self.label:28} {self.seconds()} s".encode())

    def end(self, text: str, bad: bool = False) -> None:
        clear = "\r\033[K" if self.alive else ""
        os.write(2, f"{clear}{in_red(text) if bad else text}\n".encode("utf-8", "surrogateescape"))

    def seconds(self) -> int:
        return round(time.monotonic() - self.start)


def run_stage(record: Path, settings: str, words: Sequence[str], prints: Path | None = None, keep: Path | None = None,
              compressions: Sequence[Path] = (), spared: Path | None = None) -> None:
    """Runs the program of a stage and records its settings when it has succeeded.

    The record goes before the program starts: a stage that is stopped has none and is run again, whatever the settings then are.

    Args:
        record: FOLDER/.STAGE.settings. settings: the text that make compares with it.
        words: the program with its arguments.
        prints: file of what the program prints to stdout, complete or absent; its messages alone are then in the log.
        keep: the shape that `compress` writes, which is kept even if the plates do not grip the breast.
        compressions: files made of compressed shapes, or these themselves. If one is not there, or is no compression, the program is not
            run, which is said and is no failure.
        spared: a file that the program writes and that what follows can do without: a failure is said, and leaves neither file nor record.

    Raises:
        Failed: the program failed; how it ended and where to look has been said, and the exit code is that of the program.
    """
    stage, folder = record.name.removeprefix(".").removesuffix(".settings"), str(record.parent)
    label = label_of(stage, folder, words, prints)
    record.parent.mkdir(parents=True, exist_ok=True)
    record.unlink(missing_ok=True)
    if why := why_not_made(compressions):
        return _Screen(label).end(f"{label:28} not made: {why}", bad=True)
    if keep:
        words = [*words, "--keep-unconverged"]
    log, screen, said = record.parent / "log.txt", _Screen(label), [""]
    part = prints and prints.with_name(prints.name + ".part")
    try:
        with open(log, "a", encoding="utf-8", errors="surrogateescape", buffering=1) as file:
            file.write(f"{time.strftime('%H:%M:%S')} {label}: {' '.join(words)}\n")

            def say(line: str) -> None:
                said.append(line)
                file.write(f"{label}: {line}\n")
            with contextlib.ExitStack() as stack:
                code = follow_child(words, say, screen.tick, stack.enter_context(open(part, "wb")) if part else None)
            if prints and part and code == 0:
                part.replace(prints)
    except OSError as error:
        raise Failed(f"could not be written: {error.strerror}", error.filename or log) from None
    kept = keep is not None and code == NOT_CONVERGED and keep.exists()
    if code != 0 and spared is not None:
        spared.unlink(missing_ok=True)
        reason = next(filter(None, reversed(said)), f"exit code {code}").removeprefix(f"{Path(words[0]).name}: ")
        return screen.end(f"{label:28} left out: {reason}", bad=True)
    if code != 0 and not kept:
        screen.end(next(filter(None, reversed(said)), label))
        screen.end(f"{label} ended with exit code {code} after {screen.seconds()} s: see {log}")
        failed = Failed("")  # nothing more to say
        failed.exit_code = code
        raise failed
    report = report_of(Path(words[words.index("--report") + 1])) if "--report" in words[:-1] else {}
    screen.end(f"{label:28} " + ", ".join(filter(None, [found_in(report), f"{screen.seconds()} s"])), bad=kept)
    write_text(record, settings + "\n")
