# SPDX-License-Identifier: GPL-3.0-or-later
"""The point of a set of element faces that is nearest to a given point."""
from __future__ import annotations

import numpy as np

from .elements import HULL_LATTICE, evaluate, hulls

_BLOCK = 2000
_STARTS = np.array([[0.0, 0.0], [0.8, 0.8], [-0.8, 0.8], [0.8, -0.8], [-0.8, -0.8]])


def nearest_on_faces(order: int, nodes: np.ndarray, faces: np.ndarray,
                     points: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Nearest points on curved faces.

    Args:
        order: 1 or 2, of the elements.
        nodes: (E, n, 3) node positions of every element, mm.
        faces: (F, 2) element and local face.
        points: (m, 3), mm, finite.

    Returns:
        distance (m) mm, element (m), local (m, 3).
    """
    search = _Faces(order, nodes, faces)
    distance, face, local = np.empty(len(points)), np.empty(len(points), np.int64), np.empty((len(points), 3))
    for block in np.array_split(np.arange(len(points)), max(1, len(points) // _BLOCK)):
        if len(block):
            distance[block], face[block], local[block] = search.nearest(points[block])
    return distance, faces[face, 0], local


class _Faces:
    def __init__(self, order: int, nodes: np.ndarray, faces: np.ndarray) -> None:
        self._order, self._nodes = order, nodes[faces[:, 0]]
        self._axis, side = np.divmod(faces[:, 1], 2)
        self._value = 2.0 * side - 1
        centre = np.zeros((len(faces), 3))
        centre[np.arange(len(faces)), self._axis] = self._value
        self._centre = evaluate(order, self._nodes, centre)[0]
        # A sphere that holds the face: its points are averages of those control points that lie on it.
        control = hulls(order, self._nodes)
        on_face = HULL_LATTICE[order][:, self._axis].T == self._value[:, None]
        reach = np.linalg.norm(control - self._centre[:, None], axis=2)
        self._radius = np.where(on_face, reach, 0).max(1)

    def nearest(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        to_centre = np.linalg.norm(points[:, None] - self._centre, axis=2)
        first = (to_centre + self._radius).argmin(1)
        best, local = self._closest(first, points)
        face = first
        # Every other face that could be nearer.
        could = to_centre - self._radius < best[:, None] + 1e-12
        could[np.arange(len(points)), first] = False
        point, other = np.nonzero(could)
        distance, at = self._closest(other, points[point])
        rank = np.lexsort([distance, point])
        point, other, distance, at = point[rank], other[rank], distance[rank], at[rank]
        leads = np.concatenate([[True], point[1:] != point[:-1]]) if len(point) else np.zeros(0, bool)
        better = np.flatnonzero(leads & (distance < best[point]))
        best[point[better]], face[point[better]], local[point[better]] = distance[better], other[better], at[better]
        return best, face, local

    def _closest(self, face: np.ndarray, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Nearest point of one face to each point: the best over several starts."""
        best = np.full(len(points), np.inf)
        local = np.zeros((len(points), 3))
        if len(points) == 0:
            return best, local
        starts = [_embedded(s, self._axis[face], self._value[face]) for s in _STARTS]
        distances = np.stack([np.linalg.norm(evaluate(self._order, self._nodes[face], s)[0] - points, axis=1)
                              for s in starts])
        start = np.stack(starts)[distances.argmin(0), np.arange(len(points))]
        return self._descend(face, points, start)

    def _descend(self, face: np.ndarray, points: np.ndarray, local: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Levenberg-Marquardt on the two free coordinates, projected onto the face."""
        nodes, axis = self._nodes[face], self._axis[face]
        free = np.ones((len(points), 3), bool)
        free[np.arange(len(points)), axis] = False
        x, jacobian = evaluate(self._order, nodes, local)
        best = np.sum((x - points) ** 2, 1)
        damping = np.full(len(points), 1e-6)
        active = np.arange(len(points))
        for _ in range(60):
            if len(active) == 0:
                break
            j, at = jacobian[active], local[active]
            gradient = np.einsum("mdk,md->mk", j, x[active] - points[active])
            moves = free[active] & ~((at >= 1) & (gradient < 0)) & ~((at <= -1) & (gradient > 0))
            hessian = np.einsum("mdk,mdl->mkl", j, j)
            diagonal = np.einsum("mkk->mk", hessian) * (1 + damping[active])[:, None]
            hessian *= moves[:, :, None] & moves[:, None, :]
            hessian[:, range(3), range(3)] = np.where(moves & (diagonal > 0), diagonal, 1)
            step = np.linalg.solve(hessian, -np.where(moves, gradient, 0)[:, :, None])[:, :, 0]
            trial = np.clip(at + step, -1, 1)
            trial_x, trial_j = evaluate(self._order, nodes[active], trial)
            square = np.sum((trial_x - points[active]) ** 2, 1)
            moved = np.abs(trial - at).max(1) > 1e-12
            better = square <= best[active]
            settled = better & (best[active] - square <= 1e-15 * best[active])
            taken = active[better]
            local[taken], x[taken], jacobian[taken] = trial[better], trial_x[better], trial_j[better]
            best[taken] = square[better]
            damping[active] = np.where(better, np.maximum(1e-9, damping[active] / 10), damping[active] * 10)
            active = active[moved & ~settled & (damping[active] < 1e12)]
        return np.sqrt(best), local


def _embedded(point: np.ndarray, axis: np.ndarray, value: np.ndarray) -> np.ndarray:
    """Local coordinates (m, 3) of a face's point (2) where coordinate `axis` (m) has the given value (m)."""
    local = np.empty((len(axis), 3))
    for a, free in ((0, (1, 2)), (1, (0, 2)), (2, (0, 1))):
        own = axis == a
        local[own, a] = value[own]
        local[np.ix_(own, free)] = point
    return local
