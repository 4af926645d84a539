# SPDX-License-Identifier: GPL-3.0-or-later
"""Tissue per voxel: the file labels.vtkhdf."""
from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .document import FARTHEST_MM, Document
from .grid import Grid
from .hdf5 import read_document
from .history import Command, read_history, read_side
from .state import TISSUES


@dataclass(frozen=True)
class Labels:
    """A label volume. Arrays of voxels have shape (nk, nj, ni).

    Attributes:
        file: where it was read from.
        grid: where the voxels are; index <-> LPS mm.
        tissue: codes, see TISSUES.
        fibroglandular_fraction: 0 to 1.
        chest_wall_confidence: 0 to 1, constant along each column.
        landmarks: points (3) by name, LPS mm: nipple, perhaps tumour.
        side: 'left' or 'right'.
        skin_thickness_mm: as measured; 0 when it was not.
        midline_mm: x of the body's midline, or None.
        history: every command that led to the file.
    """

    file: Path
    grid: Grid
    tissue: np.ndarray
    fibroglandular_fraction: np.ndarray
    chest_wall_confidence: np.ndarray
    landmarks: dict[str, np.ndarray]
    side: str
    skin_thickness_mm: float
    midline_mm: float | None
    history: tuple[Command, ...]

    def __repr__(self) -> str:
        return f"<Labels {self.file.name}: {self.side} breast, {'x'.join(map(str, self.grid.size))} voxels>"

    def volume_ml(self, tissue: str) -> float:
        """Volume of a tissue by name, ml."""
        return int(np.count_nonzero(self.tissue == TISSUES.index(tissue))) * self.grid.voxel_ml()

    def centres(self, tissue: str) -> np.ndarray:
        """Centres (n, 3), LPS mm, of the voxels of a tissue by name."""
        k, j, i = np.nonzero(self.tissue == TISSUES.index(tissue))
        return self.grid.to_patient(np.stack([i, j, k], -1))


def read_labels(file: str | os.PathLike[str]) -> Labels:
    """A label volume (schema labels/1). Raises BreastError, one line, for whatever the programs refuse."""
    doc = read_document(file, "labels/1")
    side, grid = read_side(doc), _grid(doc)
    shape = grid.size[::-1]
    names = doc.names("/breast/landmarks/name")
    places = doc.places("/breast/landmarks/imaged", len(names))
    thickness = doc.number("/breast/skin@measured_thickness")
    if thickness < 0:
        raise doc.refuse(f"attribute /breast/skin@measured_thickness is {thickness}, must be 0 or more")
    known = int(doc.integer_list("/breast@midline_known", 1)[0])
    if known not in (0, 1):
        raise doc.refuse(f"attribute /breast@midline_known is {known}, must be 0 or 1")
    midline = doc.number("/breast@midline")
    if abs(midline) > FARTHEST_MM:
        raise doc.refuse(f"attribute /breast@midline is {midline} mm, must be within {FARTHEST_MM:g}")
    data = "/VTKHDF/PointData/"
    return Labels(doc.file, grid, doc.codes(data + "tissue", shape, len(TISSUES)),
                  doc.fractions(data + "fibroglandular_fraction", shape),
                  doc.fractions(data + "chest_wall_confidence", shape), dict(zip(names, places)), side, thickness,
                  midline if known else None, read_history(doc))


def _grid(doc: Document) -> Grid:
    doc.text("/VTKHDF@Type", ("ImageData",))
    extent = doc.integer_list("/VTKHDF@WholeExtent", 6)
    for axis in range(3):
        if extent[2 * axis] != 0 or not 1 <= extent[2 * axis + 1] < 16384:
            raise doc.refuse(f"attribute /VTKHDF@WholeExtent is {extent[2 * axis]} to {extent[2 * axis + 1]} along axis "
                             f"{axis}, must be 0 to at least 1 and at most 16383")
    spacing = doc.number_list("/VTKHDF@Spacing", 3)
    if not ((spacing >= 0.01) & (spacing <= 50)).all():
        raise doc.refuse(f"attribute /VTKHDF@Spacing is {spacing}, must be 0.01 to 50 mm")
    direction = doc.number_list("/VTKHDF@Direction", 9).reshape(3, 3)
    error = np.abs(direction.T @ direction - np.eye(3)).max()
    if not error < 1e-3:
        raise doc.refuse(f"attribute /VTKHDF@Direction is not orthonormal (off by {error:g}, must be below 0.001)")
    size = (extent[1] + 1, extent[3] + 1, extent[5] + 1)
    return Grid(size, spacing, doc.place("/VTKHDF@Origin"), direction)
