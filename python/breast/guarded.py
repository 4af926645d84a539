# SPDX-License-Identifier: GPL-3.0-or-later
"""Work on data that may crash a library, done in a child process."""
from __future__ import annotations

import os
import pickle
import select
import signal
import time
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from .errors import BreastError

Result = TypeVar("Result")
_MOST_SECONDS = 60.0


def guarded(file: Path, advice: str, work: Callable[[], Result]) -> Result:
    """What `work` returns or raises (BreastError), computed in a child process.

    Raises BreastError when the child ends by a signal or takes longer than a minute. Where processes cannot fork, the work is
    done in this one.
    """
    if not hasattr(os, "fork"):
        return work()
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        _answer(writing, reading, work)
    os.close(writing)
    answer = _received(reading, child)
    status = os.waitpid(child, 0)[1]
    if answer is None or status != 0:
        raise BreastError("HDF5 crashes on it or does not end (damaged)", file, advice)
    result, refusal = pickle.loads(answer)
    if refusal is not None:
        raise BreastError(*refusal)
    return result


def _answer(writing: int, reading: int, work: Callable[[], Result]) -> None:
    """In the child: writes the pickled answer and ends without any of the parent's clean-up."""
    code = 1
    try:
        os.close(reading)
        try:
            answer = work(), None
        except BreastError as error:
            answer = None, (error.what, error.file, error.advice)
        with os.fdopen(writing, "wb") as pipe:
            pickle.dump(answer, pipe, protocol=pickle.HIGHEST_PROTOCOL)
        code = 0
    finally:
        os._exit(code)


def _received(reading: int, child: int) -> bytes | None:
    """What the child wrote; None, and no child any more, when it took too long."""
    end, parts = time.monotonic() + _MOST_SECONDS, []
    with os.fdopen(reading, "rb", buffering=0) as pipe:
        while True:
            ready, _, _ = select.select([pipe], [], [], max(0.0, end - time.monotonic()))
            if not ready:
                os.kill(child, signal.SIGKILL)
                return None
            part = pipe.read(1 << 20)
            if not part:
                return b"".join(parts)
            parts.append(part)
