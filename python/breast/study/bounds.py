# SPDX-License-Identifier: GPL-3.0-or-later
"""What a quantity of a table has to lie within."""
from __future__ import annotations

from dataclasses import dataclass

ANY = float("inf")
LEAST_CONTACT_PERCENT, MOST_EDGE_PERCENT = 40, 40
"""Plates that grip touch at least this part of the projection, and less than this part of a plate's force lies on its rounded edge."""


@dataclass(frozen=True)
class Bound:
    """A column, with the entry of a report or the row of a table that it shows, its decimals, and its least and greatest value."""

    name: str
    key: str
    decimals: int
    low: float = -ANY
    high: float = ANY

    def missed_by(self, value: float | None, rounding: float = 0) -> bool:
        """Whether there is no value, or one outside by more than the fraction `rounding`; False where everything is inside."""
        if self.low == -ANY and self.high == ANY:
            return False
        return value is None or not self.low * (1 - rounding) <= value <= self.high * (1 + rounding)
