# SPDX-License-Identifier: GPL-3.0-or-later
"""Programs that stand beside the running one, for what is done in C++ alone."""
from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from ..errors import BreastError, Failed


def started(name: str, words: Sequence[str]) -> subprocess.Popen[bytes]:
    """A program that runs until `ended` waits for it; it may print up to 64 kB before that."""
    program = Path(sys.argv[0]).resolve().with_name(name)
    try:
        return subprocess.Popen([program, *words], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    except OSError as error:
        raise Failed(f"cannot be started ({error.strerror})", program) from None


def ended(name: str, child: subprocess.Popen[bytes]) -> tuple[str, list[str]]:
    """What a program printed and, line by line, said on stderr when it has succeeded. Raises the error with which it ended."""
    printed, said = map(os.fsdecode, child.communicate())
    lines = [line.removeprefix(f"{name}: ") for line in said.splitlines()]
    if child.returncode == 2 and lines:
        raise BreastError(lines[-1])
    if child.returncode != 0:
        raise Failed(lines[-1] if lines else f"{name} ended with {child.returncode}")
    return printed, lines


def printed_by(name: str, words: Sequence[str]) -> str:
    """What a program printed. Raises the error with which it ended."""
    return ended(name, started(name, [*words, "--quiet"]))[0]


def readable_scan(file: Path, series: int, folder: Path) -> Path:
    """The file, or for what is read in C++ alone, a DICOM folder, its copy in `folder` by the tool scan."""
    from ..loading import SCAN_ENDINGS

    if not file.is_dir() and file.name.lower().endswith(SCAN_ENDINGS):
        return file
    copy = folder / "scan.nrrd"
    printed_by("scan", [str(file), str(copy), "--series", str(series)])
    return copy
