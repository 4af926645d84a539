# SPDX-License-Identifier: GPL-3.0-or-later
"""Point location: which element of a shape holds a point, and where in the element it is."""
from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .bins import Bins
from .elements import evaluate, hulls, order_of, LATTICE
from .nearest import nearest_on_faces

_LOCAL_TOLERANCE = 1e-10
_BLOCK = 8000
"""Points located at a time: their elements fit in the cache."""


@dataclass(frozen=True)
class Located:
    """Material points of n queries.

    Attributes:
        element: (n) number of the element that holds the point; -1 outside.
        local: (n, 3) its (ξ, η, ζ) in [-1, 1]; NaN outside.
        inside: (n) whether an element holds the point.
    """

    element: np.ndarray
    local: np.ndarray
    inside: np.ndarray


def _solve(jacobian: np.ndarray, right: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Solutions (m, 3) of 3x3 systems, and the determinants; not finite where singular."""
    a, b, c = (jacobian[:, :, d] for d in range(3))
    bc, ca, ab = np.cross(b, c), np.cross(c, a), np.cross(a, b)
    det = np.einsum("md,md->m", a, bc)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        return np.stack([np.einsum("md,md->m", n, right) for n in (bc, ca, ab)], -1) / det[:, None], det


class ElementMap:
    """The isoparametric map of all elements of one shape.

    Candidates are the elements whose exact bounding box holds the point; in them Newton's method inverts the map. Where it
    fails or ends where the element's map is folded, it starts again from eight places, so that strongly distorted
    elements are searched too.

    Args:
        hexahedra: (E, 8) or (E, 27) rows of `nodal`, VTK order.
        nodal: (N, 3) node positions of this shape, mm.
        numbers: (E) ascending numbers by which the elements are called; 0 to E - 1 unless given.
    """

    def __init__(self, hexahedra: np.ndarray, nodal: np.ndarray, numbers: np.ndarray | None = None) -> None:
        self._numbers = np.arange(len(hexahedra)) if numbers is None else numbers
        self.order = order_of(hexahedra.shape[1])
        self._nodes = nodal[hexahedra]
        hull = hulls(self.order, self._nodes)
        lower, upper = hull.min(1), hull.max(1)
        slack = 1e-9 * np.linalg.norm(upper.max(0) - lower.min(0))
        self._bins = Bins(lower - slack, upper + slack)
        self._centre, middle = evaluate(self.order, self._nodes, np.zeros((len(hexahedra), 3)))
        with np.errstate(divide="ignore", invalid="ignore"):
            self._inverse = np.stack([_solve(middle, np.broadcast_to(e, self._centre.shape))[0] for e in np.eye(3)], -1)

    def positions(self, element: np.ndarray, local: np.ndarray) -> np.ndarray:
        """Places (n, 3) in this shape, mm, of local points (n, 3) of elements (n); NaN where the shape has no such element."""
        places = np.full((len(element), 3), np.nan)
        row = np.minimum(np.searchsorted(self._numbers, element), len(self._numbers) - 1)
        known = np.flatnonzero(self._numbers[row] == element)
        for block in np.array_split(known, max(1, len(known) // _BLOCK)):
            places[block] = evaluate(self.order, self._nodes[row[block]], local[block])[0]
        return places

    def locate(self, points: np.ndarray) -> Located:
        """The element and local coordinates of points (n, 3), mm.

        A point on a shared face belongs to one of the elements that share it. Points that are not finite are outside.
        """
        element = np.full(len(points), -1, np.int64)
        local = np.full((len(points), 3), np.nan)
        finite = np.flatnonzero(np.isfinite(points).all(1))
        for block in np.array_split(finite, max(1, len(finite) // _BLOCK)):
            element[block], local[block] = self._locate(points[block])
        inside = element >= 0
        element[inside] = self._numbers[element[inside]]
        return Located(element, local, inside)

    def _locate(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The likeliest candidate of every point first, then the next of those not found yet."""
        found = np.full(len(points), -1, np.int64)
        local = np.full((len(points), 3), np.nan)
        point, element = self._bins.pairs(points)
        guess = np.einsum("mde,me->md", self._inverse[element], points[point] - self._centre[element])
        guess = np.nan_to_num(guess, nan=9.0, posinf=9.0, neginf=-9.0)
        rank = np.lexsort([np.abs(guess).max(1), point])
        point, element, guess = point[rank], element[rank], guess[rank]
        first = np.searchsorted(point, np.arange(len(points)))
        turn = np.arange(len(point)) - first[point]
        for t in range(int(turn.max(initial=-1)) + 1):
            try_now = np.flatnonzero(turn == t)
            try_now = try_now[found[point[try_now]] < 0]
            at = self._invert(element[try_now], points[point[try_now]], np.clip(guess[try_now], -1, 1))
            good = np.isfinite(at[:, 0])
            found[point[try_now[good]]] = element[try_now[good]]
            local[point[try_now[good]]] = at[good]
        return found, local

    def _invert(self, element: np.ndarray, points: np.ndarray, start: np.ndarray) -> np.ndarray:
        """Local coordinates of each point in its element; NaN when it is not in it."""
        nodes = self._nodes[element]
        local, settled = self._newton(nodes, points, start)
        for corner in 0.5 * LATTICE[:8]:
            again = np.flatnonzero(~settled)
            if len(again) == 0:
                break
            local[again], settled[again] = self._newton(nodes[again], points[again],
                                                        np.broadcast_to(corner, (len(again), 3)))
        outside = ~settled | ~(np.abs(local).max(1) <= 1 + _LOCAL_TOLERANCE)
        local = np.clip(local, -1, 1)
        local[outside] = np.nan
        return local

    def _newton(self, nodes: np.ndarray, points: np.ndarray, start: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Where Newton's method ends, and whether that settles the question: it converged in the element, or to a point
        outside where the map is not folded."""
        local = np.array(start, float)
        settled = np.zeros(len(local), bool)
        active = np.arange(len(local))
        for _ in range(40):
            if len(active) == 0:
                break
            x, jacobian = evaluate(self.order, nodes[active], local[active])
            step, det = _solve(jacobian, points[active] - x)
            length = np.abs(step).max(1)
            usable = length < 1e6  # not singular
            step[usable] /= np.maximum(length[usable], 1)[:, None]
            local[active[usable]] += step[usable]
            reach = np.abs(local[active]).max(1)
            # Newton's error after a step is of the order of its square.
            done = usable & (length < 1e-9)
            settled[active[done]] = (reach[done] <= 1 + _LOCAL_TOLERANCE) | (det[done] > 0)
            active = active[usable & ~done & (reach <= 4)]
        return local, settled

    def nearest(self, faces: np.ndarray, points: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Of boundary faces (F, 2) the points nearest to points (n, 3): distance (n) mm, element (n), local (n, 3)."""
        rows = np.column_stack([np.searchsorted(self._numbers, faces[:, 0]), faces[:, 1]])
        distance, row, local = nearest_on_faces(self.order, self._nodes, rows, points)
        return distance, self._numbers[row], local
