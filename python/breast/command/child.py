# SPDX-License-Identifier: GPL-3.0-or-later
"""Execution of other programs: make runs as a child."""
from __future__ import annotations

import ctypes
import os
import select
import signal
import subprocess
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import IO, NamedTuple

from ..errors import Failed

_PR_SET_PDEATHSIG = 1


class Captured(NamedTuple):
    exit_code: int
    out: str
    err: str


def beginning() -> Callable[[], None]:
    """What a child does first (preexec_fn): it ends with its parent, and receives the interrupts of the terminal."""
    parent, libc = os.getpid(), ctypes.CDLL(None)

    def begin() -> None:
        libc.prctl(_PR_SET_PDEATHSIG, signal.SIGTERM)
        if os.getppid() != parent:
            os._exit(127)
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        signal.signal(signal.SIGQUIT, signal.SIG_DFL)
    return begin


def _start(words: Sequence[str], out: int | IO | None, err: int | IO | None) -> subprocess.Popen:
    try:
        return subprocess.Popen(words, stdout=out, stderr=err, preexec_fn=beginning())
    except OSError:
        raise Failed(f"the program {words[0]} could not be started; is it installed?") from None


def _code(status: int) -> int:
    return status if status >= 0 else 128 - status


@contextmanager
def _interrupts_ignored() -> Iterator[None]:
    before = [(number, signal.signal(number, signal.SIG_IGN)) for number in (signal.SIGINT, signal.SIGQUIT)]
    try:
        yield
    finally:
        for number, handler in before:
            signal.signal(number, handler)


def run_child(words: Sequence[str], out: int | IO | None = None, err: int | IO | None = None) -> int:
    """Runs the program words[0], which is searched for in PATH, with its output to the files out and err (None: those of this process).

    The child shares this process's terminal and alone receives its interrupts, and ends when this process does. Returns its exit
    code, or 128 plus the number of the signal that ended it. Raises Failed if it cannot be started.
    """
    with _interrupts_ignored():
        return _code(_start(words, out, err).wait())


def capture_child(words: Sequence[str]) -> Captured:
    """The same without showing the output, which is returned."""
    child = _start(words, subprocess.PIPE, subprocess.PIPE)
    out, err = child.communicate()
    return Captured(_code(child.returncode), os.fsdecode(out), os.fsdecode(err))


def follow_child(words: Sequence[str], say: Callable[[str], None], tick: Callable[[], None], out: IO | None = None) -> int:
    """The same, with every line of the messages, and of the output if it does not go to the file `out`, given to `say`; `tick` is called
    about once a second meanwhile."""
    with _interrupts_ignored():
        child = _start(words, out or subprocess.PIPE, subprocess.PIPE if out else subprocess.STDOUT)
        said, rest = child.stderr if out else child.stdout, b""
        while True:
            tick()
            if not select.select([said], [], [], 1.0)[0]:
                continue
            piece = os.read(said.fileno(), 1 << 16)
            *lines, rest = (rest + piece).replace(b"\r", b"\n").split(b"\n")
            for line in lines if piece else filter(None, [rest]):
                say(os.fsdecode(line))
            if not piece:
                return _code(child.wait())
