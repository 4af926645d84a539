# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a point of one view may lie in the other, as cc2mlo says it."""
from __future__ import annotations

import tempfile
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ..errors import BreastError
from ..programs import printed_by
from ..state import State
from ..state_file import read_state
from ..study.table import NO_VALUE, read_table

SIDES_90 = 1.644854
"""Standard deviations to either side of a normal distribution that hold 90 %."""
_HOOK_MM = 6
"""A line that turns back within this length looks like a hook."""
_SEEN_MM = 5
"""A shorter end behind the hook is not seen on the page."""
_END_MM = 30
"""With a longer end behind it, the turn is no hook at the line's end."""
_NEAR_MM = 0.5  # between the places of a line from which a band is measured


@dataclass(frozen=True)
class MatchedLine:
    """The line in the other view on which a point of one view lies, front (paddle) to back (detector) of its column.

    Attributes:
        points: (n, 2) u, v in the other image, mm.
        deviation: (n) one standard deviation across the line, mm; 0 without a band.
        stretch: (n) number of the piece without gaps to which a point belongs.
        status: of cc2mlo's table.
        length_mm: of the line.
    """

    points: np.ndarray
    deviation: np.ndarray
    stretch: np.ndarray
    status: str
    length_mm: float

    @property
    def stretches(self) -> list[np.ndarray]:
        """The pieces without gaps, (n, 2)."""
        return np.split(self.points, 1 + np.flatnonzero(np.diff(self.stretch)))

    @property
    def to_either_side_mm(self) -> float:
        """Half the width of the 90 % band, which at most a tenth of the line exceeds. 0 if it is not known."""
        length = np.linalg.norm(np.diff(self.points, axis=0), axis=1) * (np.diff(self.stretch) == 0)
        if not length.sum() > 0:
            return 0.0
        deviation = 0.5 * (self.deviation[1:] + self.deviation[:-1])
        order = np.argsort(deviation)
        reached = np.cumsum(length[order]) >= 0.9 * length.sum()
        return SIDES_90 * float(deviation[order][reached.argmax()])

    def inside_band(self, places: np.ndarray) -> np.ndarray:
        """How far places (n, 2) lie inside the 90 % band, mm; negative outside. It ends round, and so goes round corners."""
        inside = np.full(len(places), -np.inf)
        for k, along in enumerate(np.diff(self.points, axis=0)):
            parts = 1 + int(np.linalg.norm(along) / _NEAR_MM)
            for f in np.linspace(0, 1, parts + 1) if self.stretch[k] == self.stretch[k + 1] else ():
                deviation = self.deviation[k] + f * (self.deviation[k + 1] - self.deviation[k])
                np.maximum(inside, SIDES_90 * deviation - np.hypot(*(places - self.points[k] - f * along).T), out=inside)
        return inside

    def with_more(self, deviation: float) -> MatchedLine:
        """The same line with one more, independent deviation across it, mm, where its own is known."""
        return replace(self, deviation=np.where(self.deviation > 0, np.hypot(self.deviation, deviation), 0))

    def remark(self) -> str:
        """What limits the line or looks odd in it, in words; "" if nothing does."""
        limit = {"through_chest_wall": "The line ends where its tissue meets the chest wall. ",
                 "behind_image": "Part of the line lies behind the back edge of the image. "}.get(self.status, "")
        hook = "The hook in the line is probably tissue near the skin, which a plate has dragged along."
        return (limit + (hook if self._turns_back() else "")).strip()

    def _turns_back(self) -> bool:
        """Whether the line goes the opposite way within a few mm, not far from its ends, which lie in the skin."""
        along = np.diff(self.points, axis=0)
        length = np.linalg.norm(along, axis=1) * (np.diff(self.stretch) == 0)
        place, used = np.cumsum(length) - 0.5 * length, length > 1e-6
        place, stretch, along = place[used], self.stretch[:-1][used], along[used] / length[used, None]
        near = (np.abs(place[:, None] - place) < _HOOK_MM) & (stretch[:, None] == stretch)
        to_end = np.minimum(place, length.sum() - place)
        hook = (to_end > _SEEN_MM) & (to_end < _END_MM)
        return bool((near & hook & hook[:, None] & (along @ along.T < 0)).any())


def line_at(states: tuple[State, State], place: np.ndarray) -> MatchedLine | None:
    """The line in the second of two compressions of a point (2), mm, of the first one's image, as cc2mlo computes it; None in air.

    With a band where both compressions have their derivatives beside them. Raises BreastError where these are of other compressions.
    """
    files = [state.file.with_name(f"{state.file.stem}-sensitivity.vtkhdf") for state in states]
    banded = all(file.exists() for file in files)
    for state, file in zip(states, files) if banded else ():
        if not {*state.history} <= {*read_state(file).history}:
            raise BreastError(f"was made of another compression than {state.file.name}", file, "run sensitivity again")
    with tempfile.TemporaryDirectory(prefix="breast-line-") as folder:
        drawn, table, along = (str(Path(folder) / name) for name in ("curve.vtp", "curve.tsv", "along.tsv"))
        printed_by("cc2mlo", [*map(str, files if banded else [state.file for state in states]), drawn, "--point", f"{place[0]},{place[1]}",
                              "--table", table, "--curve-table", along, *(["--band"] if banded else [])])
        row = read_table(table)
        if row.cell(0, "status") == "air":
            return None
        places = read_table(along)
    numbers = {name: np.array([places.number(k, name) if cell != NO_VALUE else 0.0 for k, cell in enumerate(cells)])
               for name, cells in zip(places.columns, zip(*places.rows))}
    u, v = (numbers[name] for name in places.columns if name.endswith(("_u_mm", "_v_mm")))
    return MatchedLine(np.stack([u, v], -1), numbers["deviation_mm"], numbers["stretch"], row.cell(0, "status"), row.number(0, "curve_mm"))
