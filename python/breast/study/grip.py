# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether plates grip a breast, from the shape in its file alone: what `compress` says about its own result is not used.

The plates' pressure follows from how deep the skin lies in them (docs/methods.md, Contact), the breast's projection from the pixels
that its skin covers. Lengths in mm, forces in N.
"""
from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..elements import face_corners
from ..records import Plate
from ..state import State
from .bounds import LEAST_CONTACT_PERCENT, MOST_EDGE_PERCENT

ONSET_MM = 0.02
"""To this depth the pressure of a plate grows quadratically, beyond it linearly."""
TOUCHING_MM = 0.1
_SAMPLES = 48
"""Points along each edge of a face."""
_NODAL_PART, _NEAR_EDGE_MM = 0.2, 5.0
"""Part of the area of a face that its corners represent, if it lies farther than this in front of the rounded edge."""
_PIXEL_MM = 1.0
_PA_MM2_PER_N = 1e6


@dataclass(frozen=True)
class Grip:
    """A breast between plates.

    Attributes:
        contact_percent: skin and cut that touch the paddle, as a part of the breast's projection in front of the plates' edge.
        force_N: of paddle and detector.
        edge_percent: of these, the part on the rounded edge.
    """

    contact_percent: float
    force_N: tuple[float, float]
    edge_percent: tuple[float, float]

    def grips(self) -> bool:
        return self.contact_percent >= LEAST_CONTACT_PERCENT and max(self.edge_percent) < MOST_EDGE_PERCENT


def grip(state: State) -> Grip | None:
    """The grip of a compression with contact on faces of elements with 8 nodes; None for any other state."""
    contact = state.contact
    if contact is None or not contact.surface_stiffness > 0 or state.hexahedra.shape[1] != 8:
        return None
    faces = np.concatenate([state.faces["skin"], state.faces["cut"]])
    corners = face_corners(state.hexahedra, faces)
    paddle = contact.plates["paddle"]
    points, area = _samples(state.points[corners])
    _, imaged_area = _samples(state.imaged[corners])
    flat = _ahead(state.points[corners], paddle).min(axis=1, keepdims=True) > _NEAR_EDGE_MM
    nodal = np.where(flat, _NODAL_PART, 0) * imaged_area.sum(axis=1, keepdims=True) / 4
    where = np.concatenate([points, state.points[corners]], axis=1)
    share = np.concatenate([imaged_area * np.where(flat, 1 - _NODAL_PART, 1), np.repeat(nodal, 4, axis=1)], axis=1)
    found = [_pressed(where, share, contact.plates[name], contact.surface_stiffness) for name in ("paddle", "detector")]
    touching = float(area[gap(points, paddle) < TOUCHING_MM].sum())
    projected = _projected(state.points[face_corners(state.hexahedra, state.faces["skin"])], paddle)
    return Grip(100 * touching / projected if projected > 0 else 0.0, (found[0][0], found[1][0]), (found[0][1], found[1][1]))


def gap(points: np.ndarray, plate: Plate) -> np.ndarray:
    """Signed distances (mm) of points (..., 3) from a plate: a flat, a rounded edge towards the chest wall and an upright wall behind it.

    A point that entered through the flat has its depth below it, however far it lies from the edge. Shape (...).
    """
    height = (points - plate.origin) @ plate.normal
    ahead = _ahead(points, plate)
    radius = plate.edge_radius
    rounded = np.hypot(height + radius, ahead) - radius
    upright = -ahead - radius
    return np.where(ahead >= 0, height, np.where(height > -radius, rounded, upright))


def _ahead(points: np.ndarray, plate: Plate) -> np.ndarray:
    """How far points (..., 3) lie in front of the start of the rounded edge, mm."""
    return (points - plate.origin) @ plate.anterior


def _samples(corners: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Of faces (F, 4, 3): the middles of equal squares in each, (F, S, 3), and their areas, (F, S)."""
    at = (np.arange(_SAMPLES) + 0.5) / _SAMPLES
    s, t = (grid.ravel() for grid in np.meshgrid(at, at))
    shapes = np.stack([(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t])
    along = np.stack([t - 1, 1 - t, t, -t])
    across = np.stack([s - 1, -s, s, 1 - s])
    place, first, second = (np.einsum("fcx,cs->fsx", corners, weights) for weights in (shapes, along, across))
    return place, np.linalg.norm(np.cross(first, second), axis=2) / _SAMPLES**2


def _pressed(points: np.ndarray, imaged_area: np.ndarray, plate: Plate, stiffness: float) -> tuple[float, float]:
    """Force of a plate along its normal, N, and the percentage of it on the rounded edge."""
    depth = np.maximum(0, -gap(points, plate))
    pressure = stiffness * np.where(depth < ONSET_MM, depth**2 / (2 * ONSET_MM), depth - ONSET_MM / 2)
    ahead = _ahead(points, plate)
    height = (points - plate.origin) @ plate.normal
    radius = plate.edge_radius
    upright = np.where(ahead >= 0, 1, np.where(height > -radius, (height + radius) / np.maximum(np.hypot(height + radius, ahead), 1e-9), 0))
    force = pressure * imaged_area * upright / _PA_MM2_PER_N
    whole = float(force.sum())
    return whole, 100 * float(force[ahead < 0].sum()) / whole if whole > 0 else 0.0


def _projected(corners: np.ndarray, plate: Plate) -> float:
    """Area (mm2) of the pixels in front of the plate's edge that faces (F, 4, 3) cover along its normal."""
    across = np.cross(plate.normal, plate.anterior)
    flat = np.stack([(corners - plate.origin) @ plate.anterior, (corners - plate.origin) @ across], axis=2) / _PIXEL_MM
    low = np.floor(flat.min(axis=(0, 1))).astype(int) - 1
    covered = np.zeros(np.ceil(flat.max(axis=(0, 1))).astype(int) - low + 2, bool)
    for face in flat - low:
        for triangle in (face[[0, 1, 2]], face[[0, 2, 3]]):
            _cover(covered, triangle)
    ahead = low[0] + np.arange(covered.shape[0]) + 0.5
    return float(covered[ahead > 0].sum()) * _PIXEL_MM**2


def _cover(covered: np.ndarray, triangle: np.ndarray) -> None:
    """Marks the pixels whose middles lie in a triangle (3, 2), whichever way round it is."""
    first, last = np.floor(triangle.min(axis=0)).astype(int), np.ceil(triangle.max(axis=0)).astype(int)
    i, j = np.meshgrid(np.arange(first[0], last[0]) + 0.5, np.arange(first[1], last[1]) + 0.5, indexing="ij")
    edges = triangle[[1, 2, 0]] - triangle
    sides = [edge[0] * (j - corner[1]) - edge[1] * (i - corner[0]) for corner, edge in zip(triangle, edges)]
    inside = (np.minimum.reduce(sides) >= 0) | (np.maximum.reduce(sides) <= 0)
    covered[first[0]:last[0], first[1]:last[1]] |= inside
