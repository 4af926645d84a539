# SPDX-License-Identifier: GPL-3.0-or-later
"""Reading an HDF5 file of the toolkit into a Document; the only module that speaks HDF5."""
from __future__ import annotations

import io
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from .document import Document
from .errors import BreastError
from .guarded import guarded
from .seal import check_seal

_MOST_BYTES = 1 << 30
"""What all values of a file may take in memory."""
_MOST_INFLATION = 1100
"""Deflate reaches at most 1032:1, by zlib's own statement."""
_FILTERS = (h5py.h5z.FILTER_DEFLATE, h5py.h5z.FILTER_SHUFFLE, h5py.h5z.FILTER_FLETCHER32)
_MAKERS = {"mesh/1": "hexmesh, backward, forward or compress", "labels/1": "segment", "geometry/1": "fit-hermite",
           "lookup/1": "match-lookup"}
SCHEMAS = tuple(_MAKERS)
"""The schemas that are read."""


def file_schema(file: str | os.PathLike[str]) -> str:
    """Schema of a file, read without its arrays; empty when it states none. Raises BreastError when it is damaged."""
    def stated(h5: h5py.File) -> str:
        schema = h5["breast"].attrs.get("schema", b"") if "breast" in h5 else b""
        return schema.decode("utf-8", "replace") if isinstance(schema, bytes) else str(schema)

    return _with_file(_existing(file), "make it again", stated)


def read_document(file: str | os.PathLike[str], schema: str, only: tuple[str, ...] = ("",)) -> Document:
    """Everything under /breast and /VTKHDF of a file of this schema, or `only` what begins with one of these paths.

    The seal is checked before HDF5 sees the file; one without a seal (edited with h5py) is parsed in a child process, since
    HDF5 can crash on damaged bytes. Raises BreastError, one line naming file and dataset, for a file that is missing,
    truncated, altered since it was written, not HDF5 or of another schema, or that holds a link, data in another file, more
    than 1 GB, or a value that is not finite.
    """
    path = _existing(file)
    advice = f"make it with {_MAKERS[schema]}"

    def parsed(h5: h5py.File) -> Document:
        loader = _Loader(Document(path, {}, {}, advice), path.stat().st_size, only)
        loader.check_schema(h5, schema)
        for group in ("/breast", "/VTKHDF"):
            if h5.get(group, getlink=True) is not None:
                loader.load_group(h5, group, 0)
        return loader.document

    return _with_file(path, advice, parsed)


def _with_file(path: Path, advice: str, use: Callable[[h5py.File], Any]) -> Any:
    """What `use` makes of the opened file; whatever HDF5 raises on damage becomes a BreastError."""
    content = path.read_bytes()

    def work() -> Any:
        try:
            with h5py.File(io.BytesIO(content), "r") as h5:
                return use(h5)
        except BreastError:
            raise
        except Exception as error:  # h5py has no class of its own for damage
            raise BreastError(f"HDF5 cannot read it ({_first_line(error)})", path, advice) from error

    return work() if check_seal(path, content, advice) else guarded(path, advice, work)


def _first_line(error: Exception) -> str:
    return (str(error).splitlines() or ["no reason given"])[0]


def _existing(file: str | os.PathLike[str]) -> Path:
    path = Path(file)
    if not path.is_file():
        raise BreastError("is not a file", path, "give the path of a run folder or of one of its files")
    return path


class _Loader:
    def __init__(self, document: Document, file_bytes: int, only: tuple[str, ...]) -> None:
        self.document = document
        self._only = only
        self._file_bytes = file_bytes
        self._spent = 0
        self._visited: set[int] = set()

    def check_schema(self, h5: h5py.File, schema: str) -> None:
        if h5.get("/breast", getclass=True) is not h5py.Group:
            raise self.document.refuse("group /breast is missing: not a file of libbreast")
        stated = h5["/breast"].attrs.get("schema")
        text = stated.decode("utf-8", "replace") if isinstance(stated, bytes) else stated
        if not isinstance(text, str):
            raise self.document.refuse(f"attribute schema of group /breast is missing, must be '{schema}'")
        if text != schema:
            raise self.document.refuse(f"has schema '{text}', must be '{schema}'")

    def load_group(self, h5: h5py.File, path: str, depth: int) -> None:
        refuse = self.document.refuse
        if depth > 8:
            raise refuse(f"group {path} is nested too deeply")
        if not isinstance(h5.get(path, getlink=True), h5py.HardLink):
            raise refuse(f"{path} is a link, must be a group or dataset")
        member = h5[path]
        address = h5py.h5o.get_info(member.id).addr
        if address in self._visited:
            raise refuse(f"{path} is a second link to something that has another name already")
        self._visited.add(address)
        if isinstance(member, h5py.Dataset):
            self.document.datasets[path] = self._dataset(path, member)
            return
        if not isinstance(member, h5py.Group):
            raise refuse(f"{path} is neither a group nor a dataset")
        for name, value in member.attrs.items():
            self.document.attributes[f"{path}@{name}"] = self._checked(f"{path}@{name}", np.asarray(value))
        if len(member) > 1000:
            raise refuse(f"group {path} holds {len(member)} members")
        for name in member:
            below = f"{path}/{name}"
            if any(below.startswith(wanted) or wanted.startswith(below + "/") for wanted in self._only):
                self.load_group(h5, below, depth + 1)

    def _dataset(self, path: str, dataset: h5py.Dataset) -> np.ndarray:
        refuse = self.document.refuse
        if dataset.is_virtual or dataset.external:
            raise refuse(f"dataset {path} keeps its values in another file, which is not read")
        layout = dataset.id.get_create_plist()
        for n in range(layout.get_nfilters()):
            code = layout.get_filter(n)[0]
            if code not in _FILTERS:
                raise refuse(f"dataset {path} is compressed by filter {code}; deflate, shuffle and fletcher32 are read")
        if dataset.ndim > 4:
            raise refuse(f"dataset {path} has {dataset.ndim} dimensions")
        if dataset.size > 0 and dataset.id.get_storage_size() == 0:
            raise refuse(f"dataset {path} was declared but never written")
        width = max(dataset.dtype.itemsize, 8 if dataset.dtype.kind in "iu" and dataset.dtype.itemsize > 1 else 1)
        self._spent += dataset.size * width
        if dataset.size > _MOST_INFLATION * self._file_bytes or self._spent > _MOST_BYTES:
            raise refuse(f"dataset {path} states {dataset.size} values, more than the file can hold or 1 GB in all")
        return self._checked(path, np.asarray(dataset[()]))

    def _checked(self, path: str, array: np.ndarray) -> np.ndarray:
        """float32, float64, uint8, int64, or texts as objects; finite."""
        refuse = self.document.refuse
        kind = array.dtype.kind
        if kind in "iu":
            return array if array.dtype == np.uint8 else array.astype(np.int64)
        if kind == "f":
            bad = ~np.isfinite(array)
            if bad.any():
                index = np.unravel_index(int(np.argmax(bad)), array.shape)
                shown = f"[{','.join(map(str, index))}]" if array.ndim else ""
                raise refuse(f"dataset {path}{shown} is {array[index]}, must be finite")
            return array.astype(np.float32 if array.dtype.itemsize <= 4 else np.float64)
        if kind in "SOU":
            texts = np.empty(array.shape, dtype=object)
            for index in np.ndindex(array.shape):
                texts[index] = self._text(path, array[index])
            return texts
        raise refuse(f"dataset {path} has a type that is neither number nor text")

    def _text(self, path: str, stored: object) -> str:
        if isinstance(stored, bytes):
            try:
                stored = stored.split(b"\0")[0].rstrip(b" ").decode("utf-8")
            except UnicodeDecodeError:
                raise self.document.refuse(f"dataset {path} holds text that is not UTF-8") from None
        if not isinstance(stored, str):
            raise self.document.refuse(f"dataset {path} has a type that is neither number nor text")
        return stored
