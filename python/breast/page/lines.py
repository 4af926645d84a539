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
_ROUND = np.radians(10)  # between the points about the outside of a corner


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
        first, _, length = self._pieces()
        if not len(first):
            return 0.0
        deviation = 0.5 * (self.deviation[first] + self.deviation[first + 1])
        order = np.argsort(deviation)
        reached = np.cumsum(length[order]) >= 0.9 * length.sum()
        return SIDES_90 * float(deviation[order][reached.argmax()])

    def band(self) -> list[np.ndarray]:
        """Polygons (4, 2) that together cover the 90 % band: beside each piece of the line, and round the outside of its corners, as
        cc2mlo has its edges. All turn the same way, so that they add up."""
        first, normals, _ = self._pieces()
        polygons = []
        for k, normal, before, joined in zip(first, normals, np.roll(normals, 1, 0), np.diff(first, prepend=-2) == 1):
            polygons.append([self._edge(k, normal), self._edge(k + 1, normal), self._edge(k + 1, -normal), self._edge(k, -normal)])
            turn = np.arctan2(before[0] * normal[1] - before[1] * normal[0], before @ normal) if joined else 0.0
            directions = np.arctan2(before[1], before[0]) + np.linspace(0, turn, 2 + int(abs(turn) / _ROUND)) + (np.pi if turn > 0 else 0)
            about = [self._edge(k, np.array([np.cos(a), np.sin(a)])) for a in directions]
            polygons += [[self.points[k], one, other, other] for one, other in zip(about, about[1:])]
        return [_turning(np.array(polygon)) for polygon in polygons]

    def with_more(self, deviation: float) -> MatchedLine:
        """The same line with one more, independent deviation across it, mm, where its own is known."""
        return replace(self, deviation=np.where(self.deviation > 0, np.hypot(self.deviation, deviation), 0))

    def _pieces(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Between neighbours of a stretch: index of the first, unit vector across, length in mm."""
        along, joined = np.diff(self.points, axis=0), np.diff(self.stretch) == 0
        length = np.linalg.norm(along, axis=1)
        first = np.flatnonzero(joined & (length > 1e-6))
        along, length = along[first], length[first]
        return first, np.stack([-along[:, 1], along[:, 0]], -1) / length[:, None], length

    def _edge(self, k: int, normal: np.ndarray) -> np.ndarray:
        return self.points[k] + SIDES_90 * self.deviation[k] * normal

    def remark(self) -> str:
        """What limits the line, in words; "" if nothing does."""
        return {"through_chest_wall": "The line ends where its tissue meets the chest wall.",
                "behind_image": "Part of the line lies behind the back edge of the image."}.get(self.status, "")


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


def _turning(corners: np.ndarray) -> np.ndarray:
    """Corners (n, 2) in the order of their directions from their middle."""
    x, y = (corners - corners.mean(0)).T
    return corners[np.argsort(np.arctan2(y, x))]
