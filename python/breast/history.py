# SPDX-License-Identifier: GPL-3.0-or-later
"""What every file says of itself: the breast's side, and every command that led to the file."""
from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .document import Document


@dataclass(frozen=True)
class Input:
    """A file that a command read.

    Attributes:
        name: file name, without folders.
        sha256: SHA-256 of its content (docs/file-formats.md says over what).
    """

    name: str
    sha256: str


@dataclass(frozen=True)
class Command:
    """One entry of a history.

    Attributes:
        tool: program.
        version: its version.
        command: arguments as given, paths reduced to file names.
        inputs: the files it read.
    """

    tool: str
    version: str
    command: str
    inputs: tuple[Input, ...]


def read_side(document: Document) -> str:
    """'left' or 'right'."""
    return document.text("/breast@side")


def read_history(document: Document) -> tuple[Command, ...]:
    """Every command that led to the file, oldest first."""
    group = "/breast/history/"
    tools, versions, commands, names, digests = (
        document.texts(group + name) for name in ("tool", "version", "command", "input_name", "input_sha256"))
    inputs = [Input(*stated) for stated in zip(names, digests)]
    entries = document.integers(group + "input_entry")
    return tuple(Command(*stated, tuple(inputs[k] for k in np.flatnonzero(entries == i)))
                 for i, stated in enumerate(zip(tools, versions, commands)))
