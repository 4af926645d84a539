# SPDX-License-Identifier: GPL-3.0-or-later
"""Reading an HDF5 file of the toolkit into a Document; the only module that speaks HDF5.

A file whose seal holds is as a program wrote it, and is read as it is. Any other was edited: the program `pairs` reads it first, with all
checks of the tools, in a process of its own, since HDF5 can crash on damaged bytes.
"""
from __future__ import annotations

import io
import os
from pathlib import Path

import h5py
import numpy as np

from .document import Document
from .errors import BreastError
from .programs import done_on
from .seal import check_seal

_MAKERS = {"mesh/1": "hexmesh, backward, forward or compress", "labels/1": "segment", "geometry/1": "fit-hermite",
           "lookup/1": "match-lookup"}
SCHEMAS = tuple(_MAKERS)
"""The schemas that are read."""


def file_schema(file: str | os.PathLike[str]) -> str:
    """Schema of a file by its bytes, which HDF5 may not read before they are checked; whoever reads the file checks it, and that it has
    this schema. "" where it states none of those that are read. Raises BreastError for a damaged file in which none is found."""
    path = _existing(file)
    content = path.read_bytes()
    found = next((schema for schema in SCHEMAS if schema.encode() in content), "")
    if not found:
        check_seal(path, content, "make it again")
    return found


def read_document(file: str | os.PathLike[str], schema: str, only: tuple[str, ...] = ("",)) -> Document:
    """Everything in a file of this schema, or `only` what begins with one of these paths.

    Raises BreastError, one line naming the file, for one that is missing, truncated, damaged, not HDF5 or of another schema, and for an
    edited one that the programs refuse.
    """
    path = _existing(file)
    document = Document(path, {}, {}, f"make it with {_MAKERS[schema]}")
    content = path.read_bytes()
    if not check_seal(path, content, document.advice):
        if schema == "lookup/1":  # no program reads it
            raise document.refuse("was changed after match-lookup wrote it")
        done_on(path, "pairs", ["all", f"--check={schema.partition('/')[0]}={path}"])

    def keep(name: str, member: h5py.Group | h5py.Dataset) -> None:
        at = "/" + name
        if any(at.startswith(wanted) or wanted.startswith(at) for wanted in only):
            document.attributes.update((f"{at}@{key}", _values(value)) for key, value in member.attrs.items())
            if isinstance(member, h5py.Dataset):
                document.datasets[at] = _values(member[()])

    with h5py.File(io.BytesIO(content), "r") as h5:
        h5.visititems(keep)
    if document.text("/breast@schema") != schema:
        raise document.refuse(f"has schema '{document.text('/breast@schema')}', must be '{schema}'")
    return document


def _values(stored: object) -> np.ndarray:
    """Numbers in the type of the file, texts as objects."""
    array = np.asarray(stored)
    if array.dtype.kind not in "SO":
        return array
    texts = np.empty(array.shape, object)
    texts.flat = [text.decode("utf-8") if isinstance(text, bytes) else text for text in array.flat]
    return texts


def _existing(file: str | os.PathLike[str]) -> Path:
    path = Path(file)
    if not path.is_file():
        raise BreastError("is not a file", path, "give the path of a run folder or of one of its files")
    return path
