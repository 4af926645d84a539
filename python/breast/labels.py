# SPDX-License-Identifier: GPL-3.0-or-later
"""Tissue per voxel: the file labels.vtkhdf."""
from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np

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
    tissue, fraction, confidence = (doc.stored(f"/VTKHDF/PointData/{name}")
                                    for name in ("tissue", "fibroglandular_fraction", "chest_wall_confidence"))
    grid = Grid(tissue.shape[::-1], doc.numbers("/VTKHDF@Spacing"), doc.numbers("/VTKHDF@Origin"),
                doc.numbers("/VTKHDF@Direction").reshape(3, 3))
    landmarks = dict(zip(doc.texts("/breast/landmarks/name"), doc.numbers("/breast/landmarks/imaged")))
    return Labels(doc.file, grid, tissue, fraction, confidence, landmarks, read_side(doc), doc.number("/breast/skin@measured_thickness"),
                  doc.number("/breast@midline") if doc.number("/breast@midline_known") else None, read_history(doc))
