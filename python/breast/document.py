# SPDX-License-Identifier: GPL-3.0-or-later
"""An HDF5 file of the toolkit in memory, and typed access to it."""
from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from .errors import BreastError


@dataclass
class Document:
    """Datasets by path (``/VTKHDF/Points``) and attributes by path of their group and name (``/breast@schema``).

    What a file of its schema must hold, the programs have checked (hdf5.py). Every getter raises BreastError where there is nothing of
    the name; arrays that are handed out are read-only.
    """

    file: Path
    datasets: dict[str, np.ndarray]
    attributes: dict[str, np.ndarray]
    advice: str = ""

    def refuse(self, what: str) -> BreastError:
        """The error to raise about this file."""
        return BreastError(what, self.file, self.advice)

    def has(self, path: str) -> bool:
        return path in self.datasets

    def has_group(self, path: str) -> bool:
        below = (path + "/", path + "@")
        return any(name.startswith(below) for name in (*self.datasets, *self.attributes))

    def _at(self, path: str) -> np.ndarray:
        values = self.attributes if "@" in path else self.datasets
        if path not in values:
            raise self.refuse(f"{'attribute' if '@' in path else 'dataset'} {path} is missing")
        return values[path]

    def _of_type(self, path: str, kind: type) -> np.ndarray:
        try:
            return read_only(self._at(path).astype(kind))
        except ValueError:
            raise self.refuse(f"{path} holds no numbers") from None

    def numbers(self, path: str) -> np.ndarray:
        """Floating-point numbers of a dataset or an attribute as float64."""
        return self._of_type(path, np.float64)

    def integers(self, path: str) -> np.ndarray:
        """Integers of a dataset or an attribute as int64."""
        return self._of_type(path, np.int64)

    def stored(self, path: str) -> np.ndarray:
        """A dataset in the type of the file, as bytes of codes and float32 of fractions."""
        return read_only(self._at(path))

    def texts(self, path: str) -> list[str]:
        return list(self._at(path))

    def text(self, path: str) -> str:
        return str(self._at(path).item())

    def number(self, path: str) -> float:
        return float(self._at(path).item())


def read_only(array: Any) -> np.ndarray:
    """The same values in an array that refuses to be changed: element maps are built from them."""
    array = np.ascontiguousarray(array)
    array.setflags(write=False)
    return array
