# SPDX-License-Identifier: GPL-3.0-or-later
"""The 8-node and the 27-node hexahedron: node order, shape functions, faces."""
from __future__ import annotations

import numpy as np

LATTICE = np.array([
    [-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1],
    [0, -1, -1], [1, 0, -1], [0, 1, -1], [-1, 0, -1], [0, -1, 1], [1, 0, 1], [0, 1, 1], [-1, 0, 1],
    [-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0], [-1, 0, 0], [1, 0, 0], [0, -1, 0], [0, 1, 0],
    [0, 0, -1], [0, 0, 1], [0, 0, 0]])
"""Local coordinates of the nodes, in the order of VTK_TRIQUADRATIC_HEXAHEDRON; the first 8 are those of VTK_HEXAHEDRON."""

HULL_LATTICE = {1: LATTICE[:8], 2: np.stack(np.meshgrid(*[[-1, 0, 1]] * 3, indexing="ij"), -1).reshape(27, 3)}
"""Local coordinates of the points that `hulls` gives, by order of the element."""

FACE_CORNERS = np.array([[0, 4, 7, 3], [1, 2, 6, 5], [0, 1, 5, 4], [3, 7, 6, 2], [0, 3, 2, 1], [4, 5, 6, 7]])
"""Corner nodes of local face 0 (-ξ), 1 (+ξ), 2 (-η), 3 (+η), 4 (-ζ), 5 (+ζ); their right-hand normal points outwards."""


def face_corners(hexahedra: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """The nodes (F, 4) at the corners of faces (F, 2): element and local face."""
    return hexahedra[faces[:, :1], FACE_CORNERS[faces[:, 1]]]


def order_of(nodes_per_element: int) -> int:
    """1 of 8 nodes, 2 of 27."""
    return {8: 1, 27: 2}[nodes_per_element]


def _line(order: int, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Lagrange functions (m, order + 1) on [-1, 1] and their slopes."""
    if order == 1:
        half = np.full_like(x, 0.5)
        return np.stack([0.5 * (1 - x), 0.5 * (1 + x)], -1), np.stack([-half, half], -1)
    return (np.stack([0.5 * x * (x - 1), 1 - x * x, 0.5 * x * (x + 1)], -1),
            np.stack([x - 0.5, -2 * x, x + 0.5], -1))


def shape_functions(order: int, local: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Shape functions (m, n) and their derivatives (m, n, 3) by (ξ, η, ζ) at local points (m, 3); n is 8 or 27."""
    at = ((LATTICE[:8] + 1) // 2 if order == 1 else LATTICE + 1).T
    (u, du), (v, dv), (w, dw) = (_line(order, local[:, d]) for d in range(3))
    u, v, w, du, dv, dw = (f[:, at[d]] for d, f in ((0, u), (1, v), (2, w), (0, du), (1, dv), (2, dw)))
    return u * v * w, np.stack([du * v * w, u * dv * w, u * v * dw], -1)


def evaluate(order: int, nodes: np.ndarray, local: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Places (m, 3) and Jacobians ∂x/∂(ξ,η,ζ) (m, 3, 3) of local points (m, 3) in elements with nodes (m, n, 3)."""
    values, slopes = shape_functions(order, local)
    both = np.concatenate([values[:, :, None], slopes], -1)
    at = np.matmul(nodes.transpose(0, 2, 1), both)
    return at[:, :, 0], at[:, :, 1:]


def hulls(order: int, nodes: np.ndarray) -> np.ndarray:
    """Points (m, n, 3) whose convex hull holds the element: its corners, or the control points of its Bézier form."""
    if order == 1:
        return nodes
    control = np.empty((len(nodes), 3, 3, 3, 3))
    control[:, LATTICE[:, 0] + 1, LATTICE[:, 1] + 1, LATTICE[:, 2] + 1] = nodes
    for axis in (1, 2, 3):
        low, middle, high = (np.take(control, i, axis) for i in range(3))
        control[(slice(None),) * axis + (1,)] = 2 * middle - 0.5 * (low + high)
    return control.reshape(len(nodes), 27, 3)


def boundary_faces(hexahedra: np.ndarray) -> np.ndarray:
    """Faces of exactly one element, (F, 2): element and local face, ascending."""
    keys = np.sort(hexahedra[:, FACE_CORNERS], axis=2).reshape(-1, 4)
    order = np.lexsort(keys.T)
    sorted_keys = keys[order]
    same = np.all(sorted_keys[1:] == sorted_keys[:-1], axis=1)
    shared = np.concatenate([[False], same]) | np.concatenate([same, [False]])
    single = np.sort(order[~shared])
    return np.stack([single // 6, single % 6], -1)


def element_volumes(order: int, nodes: np.ndarray) -> np.ndarray:
    """Volumes (m) in mm³ of elements with nodes (m, n, 3) in mm, exact but for rounding (3x3x3 Gauss points)."""
    points, weights = np.polynomial.legendre.leggauss(order + 2)
    volumes = np.zeros(len(nodes))
    for i, j, k in np.ndindex(len(points), len(points), len(points)):
        local = np.broadcast_to([points[i], points[j], points[k]], (len(nodes), 3))
        volumes += weights[i] * weights[j] * weights[k] * np.linalg.det(evaluate(order, nodes, local)[1])
    return volumes
