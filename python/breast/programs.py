# SPDX-License-Identifier: GPL-3.0-or-later
"""The programs of libbreast, for what is done in C++ alone."""
from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from .errors import BreastError, Failed


_ONLY_OURS = "fit-hermite"
"""By this program a folder is known as ours: other packages have a `scan`, too."""


def program(name: str) -> Path:
    """A program: beside the running one, or that of the installation or of the build to which this package belongs. Raises Failed."""
    here = Path(__file__).resolve()
    folders = [*(above / "libexec/breast" for above in here.parents), here.parents[2] / "build/release/bin"]
    beside = Path(sys.argv[0]).resolve().parent
    if sys.argv[0] and os.access(beside / _ONLY_OURS, os.X_OK):
        folders.insert(0, beside)
    found = next((folder / name for folder in folders if os.access(folder / name, os.X_OK)), None)
    if found is None:
        raise Failed(f"the program {name} is not installed", here.parent, "install the programs with the package, or build them: make -f "
                     "Makefile.pipeline build")
    return found


def started(name: str, words: Sequence[str]) -> subprocess.Popen[bytes]:
    """A program that runs until `ended` waits for it; it may print up to 64 kB before that."""
    file = program(name)
    try:
        return subprocess.Popen([file, *words], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    except OSError as error:
        raise Failed(f"cannot be started ({error.strerror})", file) from None


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


def done_on(file: Path, name: str, words: Sequence[str]) -> None:
    """A program that reads one file. Raises BreastError about that file."""
    try:
        printed_by(name, words)
    except Failed:
        raise
    except BreastError as error:
        raise BreastError(str(error).removeprefix(f"{file}: "), file) from None
