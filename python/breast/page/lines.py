# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a point of one view may lie in the other, as cc2mlo says it."""
from __future__ import annotations

import tempfile
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ..command.beside import printed_by
from ..curves import read_curves
from ..errors import BreastError
from ..state import State
from ..state_file import read_state
from ..study.table import read_table

SIDES_90, _SIDES_95 = 1.644854, 1.959964
"""Standard deviations to either side of a normal distribution that hold 90 and 95 %."""


@dataclass(frozen=True)
class MatchedLine:
    """The line in the other view on which a point of one view lies, front (paddle) to back (detector) of its column.

    Attributes:
        points: (n, 2) u, v in the other image, mm.
        deviation: (n) one standard deviation across the line, mm; 0 without a band.
        across: (n, 2) unit vectors across it.
        status: of cc2mlo's table.
        length_mm: of the line.
    """

    points: np.ndarray
    deviation: np.ndarray
    across: np.ndarray
    status: str
    length_mm: float

    @property
    def to_either_side_mm(self) -> float:
        """Half the width of the 90 % band, which at most a tenth of the line exceeds: where a line has a sharp corner, across it is partly
        along it, and the band is wider there. 0 if it is not known."""
        length = np.linalg.norm(np.diff(self.points, axis=0), axis=1)
        deviation = 0.5 * (self.deviation[1:] + self.deviation[:-1])
        order = np.argsort(deviation)
        reached = np.cumsum(length[order]) >= 0.9 * length.sum()
        return SIDES_90 * float(deviation[order][reached.argmax()])

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
        return {"through_chest_wall": "The line ends where its tissue meets the chest wall.",
                "behind_image": "Part of the line lies behind the back edge of the image."}.get(self.status, "")


def line_at(states: tuple[State, State], uv: np.ndarray) -> MatchedLine | None:
    """The line in the second of two compressions of a point (2), mm, of the first one's image, as cc2mlo computes it; None in air.

    With a band where both compressions have their derivatives beside them. Raises BreastError where these are of other compressions.
    """
    files = [state.file.with_name(f"{state.file.stem}-sensitivity.vtkhdf") for state in states]
    banded = all(file.exists() for file in files)
    for state, file in zip(states, files) if banded else ():
        if not {*state.history} <= {*read_state(file).history}:
            raise BreastError(f"was made of another compression than {state.file.name}", file, "run sensitivity again")
    with tempfile.TemporaryDirectory(prefix="breast-line-") as folder:
        drawn, table = (str(Path(folder) / name) for name in ("curve.vtp", "curve.tsv"))
        printed_by("cc2mlo", [*map(str, files if banded else [state.file for state in states]), drawn, "--point", f"{uv[0]},{uv[1]}",
                              "--table", table, *(["--band"] if banded else [])])
        row = read_table(table)
        if row.cell(0, "status") == "air":
            return None
        lines = read_curves(drawn)
    points = lines["curve"][0].uv_mm
    low, high = (line.uv_mm for line in lines["band 95"]) if banded else (points, points)
    width = np.linalg.norm(high - low, axis=1)
    across = np.divide(high - low, width[:, None], out=np.zeros_like(points), where=width[:, None] > 0)
    return MatchedLine(points, width / (2 * _SIDES_95), across, row.cell(0, "status"), row.number(0, "curve_mm"))


def _turning(corners: np.ndarray) -> np.ndarray:
    """Corners (n, 2) in the order of their directions from their middle."""
    x, y = (corners - corners.mean(0)).T
    return corners[np.argsort(np.arctan2(y, x))]
