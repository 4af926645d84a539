# SPDX-License-Identifier: GPL-3.0-or-later
"""Points carried by the tissue from one shape to another."""
from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from .element_map import ElementMap, Located
from .errors import BreastError
from .points import checked_points

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


@dataclass(frozen=True)
class Transported:
    """What became of n points.

    Attributes:
        points: (n, 3) their places in the target shape, LPS mm; NaN for points that are not inside.
        inside: (n) whether the point lies in an element that both shapes have (or was moved onto one, see `within`).
        located: number of the element in the mesh, and local coordinates in the source shape.
        moved: (n) mm by which a point was moved onto the source shape before it was carried; 0 but where `within` allowed it.
    """

    points: np.ndarray
    inside: np.ndarray
    located: Located
    moved: np.ndarray
    _source: ElementMap = field(repr=False)
    _boundary: np.ndarray = field(repr=False)
    _asked: np.ndarray = field(repr=False)

    @cached_property
    def distance(self) -> np.ndarray:
        """(n) mm from each point asked for to the source shape: 0 inside, positive outside, computed when first asked for."""
        distance = self.moved.copy()
        outside = np.flatnonzero(~self.located.inside)
        distance[outside] = self._source.nearest(self._boundary, self._asked[outside])[0]
        return distance


def transported(source: ElementMap, target: ElementMap, boundary: np.ndarray, points: ArrayLike,
                within: float = 0.0) -> Transported:
    """Carries points (n, 3), LPS mm, from the source shape to the target shape by the elements that both have.

    Args:
        source, target: element maps of the two shapes.
        boundary: (F, 2) all boundary faces of the source shape.
        points: (n, 3) finite.
        within: points at most so many mm outside are moved to the nearest point of the source shape first.
    """
    asked = checked_points(points)
    if not (np.isfinite(within) and within >= 0):
        raise BreastError(f"within is {within} mm, must be 0 or more")
    located = source.locate(asked)
    moved = np.zeros(len(asked))
    if within > 0:
        outside = np.flatnonzero(~located.inside)
        distance, element, local = source.nearest(boundary, asked[outside])
        near = distance <= within
        taken = outside[near]
        located.element[taken], located.local[taken], located.inside[taken] = element[near], local[near], True
        moved[taken] = distance[near]
    there = target.positions(located.element, located.local)
    return Transported(there, np.isfinite(there).all(1), located, moved, source, boundary, asked)
