# SPDX-License-Identifier: GPL-3.0-or-later
"""The curves of a grid of points of one view in another: the file lookup.h5."""
from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .hdf5 import read_document
from .history import Command, read_history, read_side

STATUS = ("air", "matched", "leaves through the chest wall", "part of the curve behind the image")
"""What the codes 0 to 3 of a lookup's status mean."""


@dataclass(frozen=True)
class Lookup:
    """Node (i, j) of the grid is the point (i, j) * pitch_mm of the first image. Arrays begin with (nv, nu).

    Attributes:
        file: where it was read from.
        from_view, to_view: CC, MLO or ML.
        pitch_mm: distance of the grid's points.
        status: codes, see STATUS.
        depth_mm: tissue along the column.
        length_mm: of the curve in the second image.
        curve_mm: (nv, nu, samples, 2) u, v in the second image, equally far apart in the column.
        deviation_mm: (nv, nu, samples) one standard deviation across the curve; 0 without a band.
        imaged_mm: (nv, nu, samples, 3) the column in the scan, LPS mm.
        band_without: parameters that the deviation does not count.
        side: 'left' or 'right'.
        history: every command that led to the file.
    """

    file: Path
    from_view: str
    to_view: str
    pitch_mm: float
    status: np.ndarray
    depth_mm: np.ndarray
    length_mm: np.ndarray
    curve_mm: np.ndarray
    deviation_mm: np.ndarray
    imaged_mm: np.ndarray
    band_without: list[str]
    side: str
    history: tuple[Command, ...]

    def node(self, u_mm: float, v_mm: float) -> tuple[int, int]:
        """Index (j, i) into the arrays of the node nearest to a point of the first image, within its grid."""
        j, i = (int(np.clip(round(at / self.pitch_mm), 0, n - 1)) for at, n in zip((v_mm, u_mm), self.status.shape))
        return j, i


def read_lookup(file: str | os.PathLike[str], back: bool = False) -> Lookup:
    """A lookup (schema lookup/1); with `back` that of the points of the second image, which match-lookup --both-ways writes.

    Raises BreastError, one line, when the file is not what docs/file-formats.md says.
    """
    doc = read_document(file, "lookup/1")
    group = "/breast/lookup_back" if back else "/breast/lookup"
    arrays = [doc.numbers(f"{group}/{name}") for name in ("depth_mm", "length_mm", "curve_mm", "deviation_mm", "imaged_mm")]
    return Lookup(doc.file, doc.text(f"{group}@from_view"), doc.text(f"{group}@to_view"), doc.number(f"{group}@pitch_mm"),
                  doc.stored(f"{group}/status"), *arrays, doc.texts(f"{group}/band_without"), read_side(doc), read_history(doc))
