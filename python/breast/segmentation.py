# SPDX-License-Identifier: GPL-3.0-or-later
"""A segmentation of 3D Slicer (.seg.nrrd)."""
from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .errors import BreastError
from .grid import Grid


@dataclass(frozen=True)
class Segmentation:
    """Label values on a grid, with names.

    Attributes:
        file: where it was read from.
        grid: where the voxels are; index <-> LPS mm.
        labels: (nk, nj, ni) label values as integers.
        values: label value by segment name.
        colours: (3) red, green and blue, 0 to 1, by segment name, where stated.
    """

    file: Path
    grid: Grid
    labels: np.ndarray
    values: dict[str, int]
    colours: dict[str, np.ndarray]

    def __repr__(self) -> str:
        return f"<Segmentation {self.file.name}: {', '.join(self.values)}>"

    def mask(self, name: str) -> np.ndarray:
        """Which voxels (nk, nj, ni) belong to a segment. Raises BreastError naming those there are."""
        if name not in self.values:
            raise BreastError(f"has no segment '{name}'", self.file, f"it has: {', '.join(self.values)}")
        return self.labels == self.values[name]


def made_segmentation(file: Path, grid: Grid, grey: np.ndarray, notes: dict[str, str]) -> Segmentation:
    """A segmentation from voxels and the header's notes (Segment0_Name, Segment0_LabelValue, ...)."""
    values: dict[str, int] = {}
    colours: dict[str, np.ndarray] = {}
    for n in range(10000):
        if f"Segment{n}_ID" not in notes:
            break
        if f"Segment{n}_LabelValue" not in notes and (n > 0 or "Segment1_ID" in notes):
            raise BreastError(f"Segment{n}_LabelValue is missing: which voxels are its own is unknown", file)
        name = notes.get(f"Segment{n}_Name", notes[f"Segment{n}_ID"])
        try:
            value = int(notes.get(f"Segment{n}_LabelValue", "1"))
            colour = np.array([float(c) for c in notes.get(f"Segment{n}_Color", "").split()])
        except ValueError:
            raise BreastError(f"segment {n} states a label value or colour that is no number", file) from None
        if name in values:
            raise BreastError(f"has two segments '{name}'", file)
        values[name] = value
        if colour.shape == (3,):
            colours[name] = colour
    return Segmentation(file, grid, np.rint(grey).astype(np.int64), values, colours)
