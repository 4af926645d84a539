# SPDX-License-Identifier: GPL-3.0-or-later
"""Which boxes may hold a point: boxes sorted into the cells of a uniform grid."""
from __future__ import annotations

import numpy as np


def ranges(starts: np.ndarray, counts: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Concatenation of starts[i] ... starts[i] + counts[i] - 1, and the i each number belongs to."""
    owner = np.repeat(np.arange(len(counts)), counts)
    first = np.cumsum(counts) - counts
    return np.repeat(starts - first, counts) + np.arange(len(owner)), owner


class Bins:
    """Boxes [lower, upper] (n, 3), found by the points they hold.

    About one cell a box, so that a query looks at a handful of boxes whatever their number.
    """

    def __init__(self, lower: np.ndarray, upper: np.ndarray) -> None:
        self._lower, self._upper = lower, upper
        self.low, self.high = lower.min(0), upper.max(0)
        extent = np.maximum(self.high - self.low, 1e-12)
        side = (np.prod(extent) / len(lower)) ** (1 / 3)
        self._cells = np.clip(np.ceil(extent / side), 1, 512).astype(np.int64)
        self._per_mm = self._cells / extent
        first, last = self._cell(lower), self._cell(upper)
        spread = last - first + 1
        offset, box = ranges(np.zeros(len(lower), np.int64), spread.prod(1))
        own = spread[box]
        k, rest = np.divmod(offset, own[:, 0] * own[:, 1])
        j, i = np.divmod(rest, own[:, 0])
        cell = self._flat(first[box] + np.stack([i, j, k], -1))
        self._boxes = box[np.argsort(cell, kind="stable")]
        self._start = np.concatenate([[0], np.cumsum(np.bincount(cell, minlength=int(self._cells.prod())))])

    def _cell(self, points: np.ndarray) -> np.ndarray:
        return np.clip(((points - self.low) * self._per_mm).astype(np.int64), 0, self._cells - 1)

    def _flat(self, cell: np.ndarray) -> np.ndarray:
        return cell[:, 0] + self._cells[0] * (cell[:, 1] + self._cells[1] * cell[:, 2])

    def pairs(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """All (point, box) of finite points (m, 3) with the point in the box: two arrays of indices."""
        inside = np.flatnonzero(((points >= self.low) & (points <= self.high)).all(1))
        cell = self._flat(self._cell(points[inside]))
        at, owner = ranges(self._start[cell], self._start[cell + 1] - self._start[cell])
        box, point = self._boxes[at], inside[owner]
        x = points[point]
        held = ((x >= self._lower[box]) & (x <= self._upper[box])).all(1)
        return point[held], box[held]
