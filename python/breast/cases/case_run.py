# SPDX-License-Identifier: GPL-3.0-or-later
"""A case of a cohort, run as a process: its status during and after the run, and the reason if it fails."""
from __future__ import annotations

import contextlib
import fcntl
import os
import re
import signal
from collections.abc import Iterator, Sequence
from pathlib import Path

from ..command.child import run_child
from ..output import write_text
from ..text_table import read_text
from .cohort import CohortEntry

_LONGEST_REASON = 2000  # a longer line of a log is not a sentence
_ENDING = (signal.SIGTERM, signal.SIGHUP, signal.SIGXCPU, signal.SIGINT)


def _telling_line(log: str) -> str:
    """The file for which make has no rule; otherwise the last message of a program, which begins with its name and a colon; otherwise
    the last line."""
    program = last = ""
    for line in log.splitlines():
        if line.startswith("make") and "No rule to make target" in line:
            return line
        if re.match(r"[a-z0-9-]+: ", line) and not line.startswith(("make", "set-up")):
            program = line
        last = line
    return program or last


def reason_of(log: str, runs: str) -> str:
    """The reason why a make failed, found in its output; without folders, among them `runs`, so that it does not depend on the place
    where the case was run."""
    reason = os.fsdecode(os.fsencode(_telling_line(log))[:_LONGEST_REASON]).replace("\t", " ")
    reason = re.sub(r"^make(\[[0-9]+\])?: \*\*\* ", "", reason).removesuffix(".  Stop.").replace(runs + "/", "")
    reason = re.sub(r"(^|[\] '\",=:(])\.{0,2}/[^ '\",=:)]*/", r"\1", reason)
    return re.sub(r"^No rule to make target '(.*)', needed by .*", r"'\1', which a setting names, does not exist", reason)


@contextlib.contextmanager
def _locked(file: Path, says: str = "") -> Iterator[None]:
    """An exclusive lock on a file. If another process holds it, `says` is printed, and the lock is waited for."""
    with open(file, "a", encoding="utf-8") as stream:
        try:
            fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            if says:
                os.write(2, (says + "\n").encode())
            fcntl.flock(stream, fcntl.LOCK_EX)
        yield


def run_case(runs: Path, case: CohortEntry, command: Sequence[str]) -> bool:
    """Runs a case and writes its outcome to RUNS/CASE.status: "running", then "done" or "failed" with the reason.

    Only one process at a time works on a case: a second one waits for the first, because a cluster may start a task again before its
    first run has ended. Cases of one phantom share its scan, which only one of them may make.

    Args:
        runs: of the cohort; RUNS/CASE.log has the output of the commands.
        command: make command of the case; its last word is the target.

    Returns:
        False if a signal stopped the case; true otherwise, also if the case failed.
    """
    status, log = case.status(runs), runs / (case.name + ".log")

    def say(what: str, reason: str = "") -> None:
        write_text(status, f"{what}\t{reason}\n")

    def run(words: Sequence[str]) -> int:
        with open(log, "ab") as output:
            return run_child(words, output, output)

    stopped = []
    with _locked(status.with_name(f".{status.stem}.lock"), f"cohort: {status.stem}: another process works on it; waiting for it"):
        for number in _ENDING:
            signal.signal(number, lambda *_: stopped.append(True))
        say("running")
        log.unlink(missing_ok=True)
        code = 0
        if case.kind == "phantom":
            with _locked(status.with_name(".phantoms.lock")):
                code = run([*command[:-1], "phantom-scan"])
        code = code or run(command)
        if stopped or code - 128 in _ENDING:
            say("failed", "stopped by a signal: cancelled, out of its time, or interrupted")
            return False
        if code == 0:
            say("done")
        else:
            say("failed", reason_of(read_text(log), str(runs)) or "nothing was said; see the log")
        return True


def is_done(status: Path) -> bool:
    """Whether the status file exists and says that the case is done."""
    return status.is_file() and read_text(status).startswith("done")
