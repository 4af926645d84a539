# SPDX-License-Identifier: GPL-3.0-or-later
"""What every file says of itself: the breast's side, and every command that led to the file."""
from __future__ import annotations

from dataclasses import dataclass

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
    """'left' or 'right'; checks units and orientation too."""
    document.text("/breast@units", ("mm-g-s",))
    document.text("/breast@orientation", ("LPS",))
    return document.text("/breast@side", ("left", "right"))


def read_history(document: Document) -> tuple[Command, ...]:
    """Every command that led to the file, oldest first."""
    group = "/breast/history/"
    tools = document.texts(group + "tool", (None,))
    count = len(tools)
    versions = document.texts(group + "version", (count,))
    commands = document.texts(group + "command", (count,))
    entries = document.integers(group + "input_entry", (None,), 0, max(count, 1))
    names = document.texts(group + "input_name", (len(entries),))
    digests = document.texts(group + "input_sha256", (len(entries),))
    return tuple(
        Command(tools[i], versions[i], commands[i],
                tuple(Input(names[k], digests[k]) for k in range(len(entries)) if entries[k] == i))
        for i in range(count))
