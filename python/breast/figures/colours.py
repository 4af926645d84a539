# SPDX-License-Identifier: GPL-3.0-or-later
"""The colours of all figures.

Lines that are told apart differ in dashes or width too, so that they survive print in grey; their hues are those of Okabe and Ito
(2008), which people without a sense of red or green tell apart.
"""
from __future__ import annotations

from dataclasses import dataclass

from matplotlib.colors import LinearSegmentedColormap

Colour = tuple[float, float, float]

INK: Colour = (0.0, 0.0, 0.0)
WHITE: Colour = (1.0, 1.0, 1.0)
SKIN: Colour = (0.93, 0.74, 0.63)
MUSCLE: Colour = (0.42, 0.15, 0.13)
CUT: Colour = (0.72, 0.52, 0.45)
GLAND: Colour = (0.62, 0.36, 0.56)
TUMOUR: Colour = (1.0, 0.82, 0.05)
COLUMN: Colour = (0.0, 0.62, 0.35)
PLATE: Colour = (0.55, 0.68, 0.80)
PLATE_RIM: Colour = (0.35, 0.45, 0.55)
IMAGE_BORDER: Colour = (0.95, 0.50, 0.05)
RIM: Colour = (0.1, 0.3, 0.8)
BAD: Colour = (0.75, 0.1, 0.1)

HEAT = LinearSegmentedColormap.from_list("heat", [
    (0.97, 0.93, 0.86), (0.99, 0.83, 0.52), (0.98, 0.64, 0.30), (0.90, 0.42, 0.22), (0.74, 0.20, 0.26), (0.47, 0.08, 0.32),
    (0.18, 0.04, 0.24)])
"""From 0, pale, to the highest value, dark: the order stays in grey."""


@dataclass(frozen=True)
class Stroke:
    """How a line is drawn: its width is in pixels, its dashes are on and off in widths."""

    colour: Colour
    width: float = 2.0
    dashes: tuple[float, ...] = ()


SHAPES = (Stroke((0.10, 0.10, 0.10), 2.0), Stroke((0.84, 0.37, 0.0), 2.4, (4, 1.6)), Stroke((0.20, 0.58, 0.85), 3.2),
          Stroke((0.80, 0.47, 0.65), 2.4, (1, 1.2)))
"""The outlines of postures: as scanned, then in the order given."""
WALL = Stroke((0.45, 0.30, 0.20), 1.4, (6, 1.5, 1, 1.5))
SKIN_LINE, WALL_LINE = Stroke((0.40, 0.85, 1.0), 2.0), Stroke((0.25, 0.95, 0.45), 2.4, (5, 1.6))
GLAND_LINE, MODEL_LINE = Stroke((1.0, 0.50, 0.82), 1.5), Stroke((1.0, 0.66, 0.20), 2.4, (1.5, 1.1))
