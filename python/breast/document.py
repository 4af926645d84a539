# SPDX-License-Identifier: GPL-3.0-or-later
"""An HDF5 file of the toolkit in memory, and typed, checked access to it."""
from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from .errors import BreastError

FARTHEST_MM = 1e6
"""Places farther from the origin than this are refused, as the programs do."""

Shape = tuple[int | None, ...]


def _shown(shape: Shape) -> str:
    return "(" + ",".join("n" if n is None else str(n) for n in shape) + ")"


@dataclass
class Document:
    """Datasets by path (``/VTKHDF/Points``) and attributes by path of their group and name (``/breast@schema``).

    Every getter raises BreastError naming file, dataset, index, value and bound. In shapes, None leaves an extent open.
    Arrays that are handed out are read-only.
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

    # ---- datasets ---------------------------------------------------------------------------------------------------

    def _dataset(self, path: str, shape: Shape, kinds: str, type_name: str) -> np.ndarray:
        if path not in self.datasets:
            raise self.refuse(f"dataset {path} is missing")
        array = self.datasets[path]
        fits = array.ndim == len(shape) and all(w is None or w == n for w, n in zip(shape, array.shape))
        if not fits:
            raise self.refuse(f"dataset {path} has shape {_shown(array.shape)}, must be {_shown(shape)}")
        if array.dtype.kind not in kinds:
            raise self.refuse(f"dataset {path} must hold {type_name}")
        return array

    def numbers(self, path: str, shape: Shape) -> np.ndarray:
        """Floating-point numbers as float64."""
        return read_only(self._dataset(path, shape, "f", "floating-point numbers").astype(np.float64))

    def integers(self, path: str, shape: Shape, low: int | None = None, high: int | None = None) -> np.ndarray:
        """Integers as int64, each at least `low` and below `high`."""
        array = self._dataset(path, shape, "iu", "integers").astype(np.int64)
        self._check_range(path, array, low, None if high is None else high - 1)
        return read_only(array)

    def codes(self, path: str, shape: Shape, high: int) -> np.ndarray:
        """Unsigned bytes below `high`."""
        array = self._dataset(path, shape, "u", "unsigned 8-bit integers").astype(np.uint8)
        self._check_range(path, array, None, high - 1)
        return read_only(array)

    def fractions(self, path: str, shape: Shape) -> np.ndarray:
        """Numbers from 0 to 1 as float32."""
        array = self._dataset(path, shape, "f", "floating-point numbers").astype(np.float32)
        self._check_range(path, array, 0, 1)
        return read_only(array)

    def places(self, path: str, count: int | None = None) -> np.ndarray:
        """Points (count, 3) in mm, each coordinate within FARTHEST_MM."""
        array = self.numbers(path, (count, 3))
        self._check_range(path, array, -FARTHEST_MM, FARTHEST_MM, " mm")
        return array

    def texts(self, path: str, shape: Shape) -> list[str]:
        return list(self._dataset(path, shape, "O", "texts"))

    def names(self, path: str) -> list[str]:
        """Names that tables can hold: not empty, without control characters and '/', each once."""
        names = self.texts(path, (None,))
        for i, name in enumerate(names):
            if not name or any(c < " " or c in "\x7f/" for c in name):
                raise self.refuse(f"dataset {path}[{i}] is {name!r}, must be a name without '/' and control characters")
            if name in names[:i]:
                raise self.refuse(f"dataset {path}[{i}] repeats '{name}'")
        return names

    def _check_range(self, path: str, array: np.ndarray, low: float | None, high: float | None, unit: str = "") -> None:
        bad = np.zeros(array.shape, bool)
        if low is not None:
            bad |= array < low
        if high is not None:
            bad |= array > high
        if not bad.any():
            return
        index = np.unravel_index(int(np.argmax(bad)), array.shape)
        bound = f"at most {high}" if low is None else f"{low} or more" if high is None else f"{low} to {high}"
        raise self.refuse(f"dataset {path}[{','.join(map(str, index))}] is {array[index]}{unit}, must be {bound}{unit}")

    # ---- attributes -------------------------------------------------------------------------------------------------

    def _attribute(self, path: str, kinds: str, type_name: str, count: int | None) -> np.ndarray:
        if path not in self.attributes:
            raise self.refuse(f"attribute {path} is missing")
        array = self.attributes[path]
        if array.dtype.kind not in kinds:
            raise self.refuse(f"attribute {path} must hold {type_name}")
        if array.size != (1 if count is None else count):
            raise self.refuse(f"attribute {path} has {array.size} values, must have {1 if count is None else count}")
        return array.reshape(-1)

    def text(self, path: str, allowed: tuple[str, ...] = ()) -> str:
        text = str(self._attribute(path, "O", "a text", None)[0])
        if allowed and text not in allowed:
            raise self.refuse(f"attribute {path} is '{text}', must be " + " or ".join(f"'{a}'" for a in allowed))
        return text

    def number(self, path: str) -> float:
        return float(self._attribute(path, "f", "a floating-point number", None)[0])

    def number_list(self, path: str, count: int) -> np.ndarray:
        return read_only(self._attribute(path, "f", "floating-point numbers", count).astype(np.float64))

    def integer_list(self, path: str, count: int) -> tuple[int, ...]:
        return tuple(int(n) for n in self._attribute(path, "iu", "integers", count))

    def place(self, path: str) -> np.ndarray:
        """A point (3) in mm, each coordinate within FARTHEST_MM."""
        place = self.number_list(path, 3)
        if np.abs(place).max() > FARTHEST_MM:
            raise self.refuse(f"attribute {path} is {place} mm, must be within {FARTHEST_MM:g}")
        return place


def read_only(array: Any) -> np.ndarray:
    """The same values in an array that refuses to be changed: element maps are built from them."""
    array = np.ascontiguousarray(array)
    array.setflags(write=False)
    return array
