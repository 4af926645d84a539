# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that a run may have or lack."""
from __future__ import annotations

import stat
from pathlib import Path


def exists(file: Path) -> bool:
    """True for a regular file that is not empty: a result that was written."""
    try:
        status = file.stat()
    except (OSError, ValueError):
        return False
    return stat.S_ISREG(status.st_mode) and status.st_size > 0


def with_ending(name: Path, ending: str) -> Path:
    """NAME.json of the stage NAME."""
    return name.with_name(name.name + ending)


def valid(text: str) -> str:
    """The text with U+FFFD for bytes that are not UTF-8 (read_text keeps them as surrogates)."""
    return text.encode("utf-8", "surrogateescape").decode("utf-8", "replace")
