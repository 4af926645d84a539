# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks of the files that a command line names, before any of them is opened."""
from __future__ import annotations

import os
import stat

from ..errors import BreastError
from ..output import check_replaceable, is_stream
from .declaration import Argument, Declaration
from .parse import Tokens


def named_values(tool: Declaration, tokens: Tokens) -> list[tuple[Argument, str]]:
    """Every value of the command line with its argument."""
    found = []
    for i, value in enumerate(tokens.positionals):
        if tool.positionals:
            found.append((tool.positionals[min(i, len(tool.positionals) - 1)], value))
    for argument in tool.options + tool.common:
        found += [(argument, value) for value in tokens.options.get(argument.label, [])]
    return found


# The programs that make the files of the chain, which are known by their names.
_MAKERS = {"labels.vtkhdf": "segment", "points.vtp": "segment", "geometry.vtkhdf": "fit-hermite", "mesh.vtkhdf": "hexmesh",
           "reference.vtkhdf": "backward", "supine.vtkhdf": "forward", "cc.vtkhdf": "compress", "mlo.vtkhdf": "compress",
           "cc.vti": "project-mammogram", "mlo.vti": "project-mammogram", "curve.vtp": "cc2mlo", "lookup.h5": "match-lookup"}


def _check_input(path: str, label: str) -> None:
    try:
        mode = os.stat(path).st_mode
    except OSError:
        tool = _MAKERS.get(os.path.basename(path))
        hint = f"; `{tool}` makes it" if tool else ""
        raise BreastError(f"{label}: {path} does not exist{hint}") from None
    if not stat.S_ISREG(mode) and not stat.S_ISDIR(mode):
        raise BreastError(f"{label}: {path} is a device or pipe; copy its content to a file first")
    if not os.access(path, os.R_OK):
        raise BreastError(f"{label}: {path} cannot be read (no permission)")


def _check_ending(path: str, argument: Argument) -> None:
    name = os.path.basename(path).lower()
    if argument.endings and not any(name.endswith(e.lower()) and len(name) > len(e) for e in argument.endings):
        raise BreastError(f"{argument.label}: {path}: the name must end with {', '.join(argument.endings)}, which states its format")


def _check_output(path: str, argument: Argument) -> None:
    if is_stream(path):
        return
    folder, label = argument.kind == "folder", argument.label
    bare = path.rstrip("/") if folder else path
    parent = os.path.dirname(bare) or "."
    if not os.path.basename(bare):
        raise BreastError(f"{label}: {path} names no file")
    if not os.path.isdir(parent):
        raise BreastError(f"{label}: folder {parent} does not exist; make it first")
    if not os.access(parent, os.W_OK | os.X_OK):
        raise BreastError(f"{label}: folder {parent} is not writable")
    if not folder and os.path.isdir(bare):
        raise BreastError(f"{label}: {path} is a folder")
    if folder and os.path.exists(bare) and not os.path.isdir(bare):
        raise BreastError(f"{label}: {path} exists and is not a folder")
    if not folder:
        _check_ending(path, argument)
        check_replaceable(path, label)


def _check_against_input(output: tuple[Argument, str], argument: Argument, value: str) -> None:
    label, path = output[0].label, output[1]
    whole, other = os.path.realpath(path.rstrip("/") or path), os.path.realpath(value.rstrip("/") or value)
    if whole == other:
        raise BreastError(f"{label}: {os.path.basename(path)} is also the input {argument.label}; give another output")
    if os.path.isdir(other) and argument.kind == "input" and whole.startswith(other.rstrip("/") + "/"):
        raise BreastError(f"{label}: {path} lies in the input folder {argument.label}; give an output elsewhere")


def check_paths(tool: Declaration, tokens: Tokens) -> None:
    """Raises BreastError for an input that cannot be read, an output that cannot be written, or one that would replace an input."""
    named = named_values(tool, tokens)
    for argument, value in named:
        if argument.kind == "input":
            _check_input(value, argument.label)
    outputs: list[tuple[Argument, str]] = []
    for argument, value in named:
        if argument.kind not in ("output", "folder"):
            continue
        for other, path in named:  # a text may be the name of a file, such as a table of materials
            if other.kind == "input" or (other.kind == "text" and os.path.exists(path)):
                _check_against_input((argument, value), other, path)
        for other, path in outputs:
            if os.path.realpath(path) == os.path.realpath(value) and not is_stream(value):
                raise BreastError(f"{argument.label}: {value} is also given as {other.label}")
        outputs.append((argument, value))
        _check_output(value, argument)
