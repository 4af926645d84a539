# SPDX-License-Identifier: GPL-3.0-or-later
"""The skin and chest-wall sheets: the file geometry.vtkhdf."""
from __future__ import annotations

import os
from dataclasses import dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from .document import Document
from .errors import BreastError
from .hdf5 import read_document
from .history import Command, read_history, read_side

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


@dataclass(frozen=True)
class Sheet:
    """A cubic-Hermite sheet of nu x nv patches.

    Attributes:
        x, x_1, x_2, x_12: (nv + 1, nu + 1, 3) node positions (LPS mm), first and mixed derivatives.
        scale_1, scale_2: (nv + 1, nu + 1) scale factors; scale_1 * x_1 is the derivative in patch coordinates.
    """

    x: np.ndarray
    x_1: np.ndarray
    x_2: np.ndarray
    x_12: np.ndarray
    scale_1: np.ndarray
    scale_2: np.ndarray

    def points(self, st: ArrayLike) -> np.ndarray:
        """Places (n, 3), LPS mm, of parameters (s, t) (n, 2) in [0, 1]². Raises BreastError outside."""
        st = np.asarray(st, float)
        if st.ndim != 2 or st.shape[1] != 2 or not ((st >= 0) & (st <= 1)).all():
            raise BreastError("parameters of a sheet must be (n, 2) numbers from 0 to 1")
        nv, nu = self.x.shape[0] - 1, self.x.shape[1] - 1
        u, v = np.minimum((st * [nu, nv]).astype(int), [nu - 1, nv - 1]).T
        xi, eta = st[:, 0] * nu - u, st[:, 1] * nv - v
        result = np.zeros((len(st), 3))
        for i, j in np.ndindex(2, 2):
            value_u, slope_u = _hermite(i, xi)
            value_v, slope_v = _hermite(j, eta)
            at = (v + j, u + i)
            s1, s2 = self.scale_1[at], self.scale_2[at]
            for weight, node in ((value_u * value_v, self.x), (slope_u * s1 * value_v, self.x_1),
                                 (value_u * slope_v * s2, self.x_2), (slope_u * s1 * slope_v * s2, self.x_12)):
                result += weight[:, None] * node[at]
        return result


def _hermite(end: int, t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """H0 and H1 of the node at t = 0 or 1."""
    if end == 0:
        return 1 - 3 * t**2 + 2 * t**3, t * (t - 1) ** 2
    return t**2 * (3 - 2 * t), t**2 * (t - 1)


@dataclass(frozen=True)
class Geometry:
    """The fitted body of a breast.

    Attributes:
        file: where it was read from.
        skin, wall: the two sheets, larger than the body.
        rim_skin, rim_wall: (n, 2) the closed curve in each sheet's (s, t) where the body ends, first point not repeated.
        rim_end: (n) what the tissue is like there: 0 thin, 1 thicker, 2 margin.
        rim_border: (n) where it lies: 0 medial, 1 superior, 2 lateral, 3 inferior; empty in earlier files.
        nipple: (3) LPS mm.
        skin_thickness_mm: 0 unknown.
        fit_mm: distance of the fitted data: mean, p95, max.
        points: (P, 3) vertices of the closed boundary, LPS mm.
        quads: (Q, 4) its faces; at the two poles the last vertex is repeated.
        part: (Q) 0 skin, 1 chest wall, 2 cut.
        side: 'left' or 'right'.
        history: every command that led to the file.
    """

    file: Path
    skin: Sheet
    wall: Sheet
    rim_skin: np.ndarray
    rim_wall: np.ndarray
    rim_end: np.ndarray
    rim_border: np.ndarray
    nipple: np.ndarray
    skin_thickness_mm: float
    fit_mm: dict[str, float]
    points: np.ndarray
    quads: np.ndarray
    part: np.ndarray
    side: str
    history: tuple[Command, ...]


def read_geometry(file: str | os.PathLike[str]) -> Geometry:
    """A geometry (schema geometry/1). Raises BreastError, one line, for whatever the programs refuse."""
    doc = read_document(file, "geometry/1")
    group, border, points = "/breast/hermite", "/breast/hermite/rim/border", doc.numbers("/VTKHDF/Points")
    fit = {name: doc.number(f"{group}@fit_{name}_mm") for name in ("mean", "p95", "max")}
    return Geometry(doc.file, _sheet(doc, "skin"), _sheet(doc, "wall"), doc.numbers(f"{group}/rim/skin"), doc.numbers(f"{group}/rim/wall"),
                    doc.stored(f"{group}/rim/end"), doc.stored(border) if doc.has(border) else np.zeros(0, np.uint8),
                    doc.numbers(f"{group}@nipple"), doc.number(f"{group}@skin_thickness"), fit, points, _quads(doc, len(points)),
                    doc.stored("/VTKHDF/CellData/part"), read_side(doc), read_history(doc))


def _sheet(doc: Document, name: str) -> Sheet:
    return Sheet(*(doc.numbers(f"/breast/hermite/{name}/{part.name}") for part in fields(Sheet)))


def _quads(doc: Document, points: int) -> np.ndarray:
    # No program reads the faces, which are there to be looked at.
    ids, offsets = doc.integers("/VTKHDF/Connectivity"), doc.integers("/VTKHDF/Offsets")
    corners = np.diff(offsets)
    if not len(corners) or not np.isin(corners, (3, 4)).all() or offsets[-1] != len(ids) or ids.min() < 0 or ids.max() >= points:
        raise doc.refuse("/VTKHDF/Connectivity and Offsets do not give each face 3 or 4 of the points")
    column = np.minimum(np.arange(4), corners[:, None] - 1)
    return ids[offsets[:-1, None] + column]
