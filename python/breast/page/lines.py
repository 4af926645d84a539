# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a point of one view may lie in the other, between the points of a lookup."""
from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..lookup import Lookup

SIDES_90 = 1.6449
"""Standard deviations to either side of a normal distribution that hold 90 %."""
_THROUGH_WALL, _BEHIND_IMAGE = 2, 3


@dataclass(frozen=True)
class MatchedLine:
    """The line in the other view on which a point of one view lies, front (paddle) to back (detector) of its column.

    Attributes:
        points: (n, 2) u, v in the other image, mm.
        deviation: (n) one standard deviation across the line, mm; 0 where the lookup has none.
        across: (n, 2) unit vectors across it.
        status: code of the nearest point of the lookup, see lookup.STATUS.
    """

    points: np.ndarray
    deviation: np.ndarray
    across: np.ndarray
    status: int

    @property
    def length_mm(self) -> float:
        return float(np.linalg.norm(np.diff(self.points, axis=0), axis=1).sum())

    @property
    def to_either_side_mm(self) -> float:
        """Half the width of the 90 % band where it is widest; 0 if it is not known."""
        return SIDES_90 * float(self.deviation.max())

    def band(self) -> list[np.ndarray]:
        """The 90 % band as quadrilaterals (4, 2), one for each piece of the line, which all turn the same way, so that they add up
        also where the line bends sharply."""
        shift = SIDES_90 * self.deviation[:, None] * self.across
        low, high = self.points - shift, self.points + shift
        return [_turning(np.array([low[k], low[k + 1], high[k + 1], high[k]])) for k in range(len(low) - 1)]

    def with_more(self, deviation: float) -> MatchedLine:
        """The same line with one more, independent deviation across it, mm, where its own is known."""
        return replace(self, deviation=np.where(self.deviation > 0, np.hypot(self.deviation, deviation), 0))

    def remark(self) -> str:
        """What limits the line, in words; "" if nothing does."""
        return {_THROUGH_WALL: "The line ends where its tissue meets the chest wall.",
                _BEHIND_IMAGE: "Part of the line lies behind the back edge of the image."}.get(self.status, "")


def line_at(lookup: Lookup, uv: np.ndarray) -> MatchedLine | None:
    """The line of a point (2), mm, of the lookup's first image; None in air or outside.

    Between four points of the grid in tissue by bilinear weights; where one of them is in air, that of the nearest point.
    """
    x, y = np.asarray(uv, float) / lookup.pitch_mm
    nv, nu = lookup.status.shape
    if not (0 <= x <= nu - 1 and 0 <= y <= nv - 1):
        return None
    i, j = min(int(x), max(nu - 2, 0)), min(int(y), max(nv - 2, 0))
    f, g = x - i, y - j
    corners = [((min(j + b, nv - 1), min(i + a, nu - 1)), (f if a else 1 - f) * (g if b else 1 - g)) for b in (0, 1) for a in (0, 1)]
    nearest = max(corners, key=lambda corner: corner[1])[0]
    status = int(lookup.status[nearest])
    if status == 0:
        return None
    used = corners if all(lookup.status[node] for node, _ in corners) else [(nearest, 1.0)]

    def mean(values: np.ndarray) -> np.ndarray:
        return sum(weight * values[node].astype(float) for node, weight in used)
    return MatchedLine(mean(lookup.curve_mm), mean(lookup.deviation_mm), mean(lookup.across), status)


def _turning(corners: np.ndarray) -> np.ndarray:
    """Corners (n, 2) in the order of their directions from their middle."""
    x, y = (corners - corners.mean(0)).T
    return corners[np.argsort(np.arctan2(y, x))]
