# SPDX-License-Identifier: GPL-3.0-or-later
"""A displacement field on a grid of voxels, as 3D Slicer has it."""
from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from .grid import Grid
from .points import checked_points

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


@dataclass(frozen=True)
class Field:
    """A field that moves the point x to x + vector(x).

    Attributes:
        file: where it was read from.
        grid: where the vectors are; index <-> LPS mm.
        vectors: (nk, nj, ni, 3) float32, LPS mm.
        notes: what the header says of itself, by key (takes_points_of, to, ...).
    """

    file: Path
    grid: Grid
    vectors: np.ndarray
    notes: dict[str, str]

    def __repr__(self) -> str:
        return f"<Field {self.file.name}: {'x'.join(map(str, self.grid.size))} vectors>"

    def move(self, points: ArrayLike) -> np.ndarray:
        """Where points (n, 3), LPS mm, are moved, by trilinear interpolation; NaN for points outside the grid."""
        points = checked_points(points)
        return points + np.stack([self.grid.sample(self.vectors[..., d], points, np.nan) for d in range(3)], -1)
