# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a plane cuts element faces."""
from __future__ import annotations

import numpy as np

from .elements import face_corners


def faces_in_plane(nodes: np.ndarray, faces: np.ndarray, origin: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """Line segments (S, 2, 3) in which a plane cuts faces, each taken as two triangles of its corners.

    Args:
        nodes: (E, n, 3) node positions of every element, mm.
        faces: (F, 2) element and local face.
        origin: (3) a point of the plane, mm.
        normal: (3) its normal, of any length.
    """
    return quads_in_plane(face_corners(nodes, faces), origin, normal)


def quads_in_plane(corners: np.ndarray, origin: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """The same for quadrilaterals (Q, 4, 3) in space."""
    triangles = np.concatenate([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]])
    height = (triangles - origin) @ (normal / np.linalg.norm(normal))
    # A corner in the plane counts as above it, so that every triangle is cut in no or in two edges.
    above = height >= 0
    cut = np.flatnonzero((above.any(1)) & (~above.all(1)))
    segments = np.empty((len(cut), 2, 3))
    filled = np.zeros(len(cut), int)
    for a, b in ((0, 1), (1, 2), (2, 0)):
        crossed = np.flatnonzero(above[cut, a] != above[cut, b])
        row = cut[crossed]
        t = height[row, a] / (height[row, a] - height[row, b])
        segments[crossed, filled[crossed]] = triangles[row, a] + t[:, None] * (triangles[row, b] - triangles[row, a])
        filled[crossed] += 1
    return segments
