# SPDX-License-Identifier: GPL-3.0-or-later
"""The one exception of this package."""
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

    def __init__(self, what: str, file: str | os.PathLike[str] | None = None, advice: str = "") -> None:
        self.file = None if file is None else os.fspath(file)
        self.what = what
        self.advice = advice
        where = "" if self.file is None else f"{self.file}: "
        super().__init__(where + what + (f"; {advice}" if advice else ""))
