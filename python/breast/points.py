# SPDX-License-Identifier: GPL-3.0-or-later
"""Points that a caller gives."""
from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .errors import BreastError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


def checked_points(points: ArrayLike) -> np.ndarray:
    """Points as float64 (n, 3). Raises BreastError for another shape or a coordinate that is not finite."""
    array = np.asarray(points, dtype=np.float64)
    if array.ndim != 2 or array.shape[1] != 3:
        raise BreastError(f"points have shape {array.shape}, must be (n, 3)", None, "one row x, y, z (LPS mm) a point")
    if not np.isfinite(array).all():
        row = int(np.argmax(~np.isfinite(array).all(1)))
        raise BreastError(f"point {row} is {array[row]}, must be finite")
    return array
