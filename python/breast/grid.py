# SPDX-License-Identifier: GPL-3.0-or-later
"""A regular grid of voxels in the patient's frame."""
from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


@dataclass(frozen=True)
class Grid:
    """Voxel (i, j, k) has its centre at origin + direction @ (spacing * (i, j, k)), LPS mm.

    Arrays of voxels have shape (nk, nj, ni): array[k, j, i].

    Attributes:
        size: (ni, nj, nk).
        spacing: (3) mm.
        origin: (3) centre of voxel (0, 0, 0), LPS mm.
        direction: (3, 3) columns are the directions of i, j and k.
    """

    size: tuple[int, int, int]
    spacing: np.ndarray
    origin: np.ndarray
    direction: np.ndarray

    def to_patient(self, index: ArrayLike) -> np.ndarray:
        """LPS mm (..., 3) of voxel coordinates (..., 3) in the order i, j, k, which need not be whole."""
        return self.origin + (np.asarray(index, float) * self.spacing) @ self.direction.T

    def to_index(self, points: ArrayLike) -> np.ndarray:
        """Voxel coordinates (..., 3), in the order i, j, k and not rounded, of points (..., 3), LPS mm."""
        return (np.asarray(points, float) - self.origin) @ np.linalg.inv(self.direction).T / self.spacing

    def voxel_ml(self) -> float:
        """Volume of a voxel, ml."""
        return float(np.prod(self.spacing)) / 1000

    def sample(self, voxels: np.ndarray, points: ArrayLike, outside: float) -> np.ndarray:
        """Values at points (n, 3), LPS mm, by trilinear interpolation of voxels (nk, nj, ni).

        Within half a voxel beyond the outermost centres the border's value holds; farther away it is `outside`.
        """
        at = self.to_index(points)
        inside = ((at >= -0.5) & (at <= np.array(self.size) - 0.5)).all(1)
        result = np.full(len(inside), float(outside))
        result[inside] = self._interpolated([voxels], at[inside])[0]
        return result

    def clamped(self, fields: Sequence[np.ndarray], points: np.ndarray) -> list[np.ndarray]:
        """The same (...) of several fields at points (..., 3); beyond the border the border's value."""
        values = self._interpolated(fields, self.to_index(points.reshape(-1, 3)))
        return [field.reshape(points.shape[:-1]) for field in values]

    def _interpolated(self, fields: Sequence[np.ndarray], at: np.ndarray) -> list[np.ndarray]:
        last = np.array(self.size) - 1
        at = np.clip(at, 0, last)
        low = np.minimum(at.astype(np.int64), np.maximum(last - 1, 0))
        t, sums = at - low, [np.zeros(len(at)) for _ in fields]
        for corner in np.ndindex(2, 2, 2):
            weight = np.where(corner, t, 1 - t).prod(1)
            i, j, k = np.minimum(low + corner, last).T
            for total, field in zip(sums, fields):
                total += weight * field[k, j, i]
        return sums

    def nearest(self, voxels: np.ndarray, points: ArrayLike, outside: int) -> np.ndarray:
        """Values of the voxels that hold points (n, 3), LPS mm; `outside` beyond the grid. For labels."""
        at = np.floor(self.to_index(points) + 0.5).astype(np.int64)
        inside = ((at >= 0) & (at < self.size)).all(1)
        i, j, k = at[inside].T
        result = np.full(len(inside), outside, voxels.dtype)
        result[inside] = voxels[k, j, i]
        return result
