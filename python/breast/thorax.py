# SPDX-License-Identifier: GPL-3.0-or-later
"""The surface on which a breast slides: /breast/thorax of geometries and meshes (libbreast/surface/thorax)."""
from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .document import Document


@dataclass(frozen=True)
class Thorax:
    """Radius about a nearly vertical axis as a uniform bicubic B-spline of angle and height.

    Attributes:
        origin: (3) a point of the axis, LPS mm; heights count from its z.
        slope: dy/dz of the axis.
        angles: first and last angle about the axis, radians, 0 to the front, positive to the patient's left.
        heights: lowest and highest height, mm.
        radius: (heights + 3, angles + 3) coefficients, mm.
    """

    origin: np.ndarray
    slope: float
    angles: np.ndarray
    heights: np.ndarray
    radius: np.ndarray

    def at_height(self, z: float, steps: int = 120) -> np.ndarray:
        """The line (steps + 1, 3) of the surface at a z, LPS mm; (0, 3) above and below its ends."""
        height = z - self.origin[2]
        if not self.heights[0] <= height <= self.heights[1]:
            return np.zeros((0, 3))
        angle = np.linspace(*self.angles, steps + 1)
        up = _weights(np.array([height]), self.heights, self.radius.shape[0] - 3)
        radius = _weights(angle, self.angles, self.radius.shape[1] - 3) @ (up @ self.radius)[0]
        return self.origin + np.stack([radius * np.sin(angle), self.slope * height - radius * np.cos(angle),
                                       np.full_like(angle, height)], -1)


def _weights(at: np.ndarray, ends: np.ndarray, intervals: int) -> np.ndarray:
    """Weights (n, intervals + 3) of the cubic B-splines."""
    scaled = (at - ends[0]) / (ends[1] - ends[0]) * intervals
    interval = np.clip(np.floor(scaled).astype(int), 0, intervals - 1)
    t, weights = scaled - interval, np.zeros((len(at), intervals + 3))
    values = ((1 - t) ** 3, 3 * t**3 - 6 * t**2 + 4, 3 * (1 - t) ** 3 - 6 * (1 - t) ** 2 + 4, t**3)
    for k, value in enumerate(values):
        weights[np.arange(len(at)), interval + k] = value / 6
    return weights


def read_thorax(doc: Document) -> Thorax | None:
    """The surface of a geometry or mesh; None for a file without it."""
    group = "/breast/thorax"
    if not doc.has_group(group):
        return None
    return Thorax(doc.numbers(f"{group}@origin"), doc.number(f"{group}@slope"), doc.numbers(f"{group}@angles"),
                  doc.numbers(f"{group}@heights"), doc.numbers(f"{group}/radius"))
