# SPDX-License-Identifier: GPL-3.0-or-later
"""The exceptions of this package, each with the exit code of a program that ends by it."""
from __future__ import annotations

import os


class BreastError(Exception):
    """A file, array or request that cannot be used.

    The text is one line: the file (where there is one), what is wrong with the value and the bound, and what to try.

    Attributes:
        file: the file as it was named, or None.
        what: what is wrong.
        advice: what to try; empty when there is nothing to say.
    """

    exit_code, status = 2, "bad_input"

    def __init__(self, what: str, file: str | os.PathLike[str] | None = None, advice: str = "") -> None:
        self.file = None if file is None else os.fspath(file)
        self.what = what
        self.advice = advice
        where = "" if self.file is None else f"{self.file}: "
        super().__init__(where + what + (f"; {advice}" if advice else ""))


class Failed(BreastError):
    """Something outside the input failed: the disk, memory, another program."""

    exit_code, status = 1, "failed"


class NotConverged(BreastError):
    """The computation has no result that can be used."""

    exit_code, status = 3, "not_converged"
