# SPDX-License-Identifier: GPL-3.0-or-later
"""What a figure is drawn from, and what it refuses."""
from __future__ import annotations

from dataclasses import dataclass, field

from ..curves import Line
from ..errors import BreastError
from ..geometry import Geometry
from ..labels import Labels
from ..mammogram import Mammogram
from ..state import State
from ..text_table import Table
from ..volume import Volume
from ..xml_mesh import XmlMesh


@dataclass
class Inputs:
    """Files in the order given. scan and labels are of one breast."""

    states: list[State] = field(default_factory=list)
    mammograms: list[Mammogram] = field(default_factory=list)
    geometry: Geometry | None = None
    clouds: list[XmlMesh] = field(default_factory=list)
    curves: dict[str, list[Line]] = field(default_factory=dict)
    scan: Volume | None = None
    labels: Labels | None = None
    tables: list[Table] = field(default_factory=list)

    def compressed(self) -> list[State]:
        return [state for state in self.states if state.contact is not None]


def need(given: object, figure: str, what: str) -> None:
    """Raises BreastError naming the figure and what it is drawn from unless that was given."""
    if not given:
        from . import FIGURES
        raise BreastError(f"figure {figure} needs {what}: {FIGURES[figure].summary}")
