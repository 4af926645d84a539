# SPDX-License-Identifier: GPL-3.0-or-later
"""One slice of a breast in the prone scan, as predicted in a second posture, and as seen there (identify)."""
from __future__ import annotations

import numpy as np

from .colours import SHAPES, Stroke
from .inputs import Inputs, need
from .layout import Picture
from .outlines import Shape, add_landmarks, add_sections, back_legend, height_of_nipple, posture_of
from .points import on_wall

_THINNEST = 1.3  # mm to either side of the slice
_SEEN_SKIN, _SEEN_WALL = Stroke((0.0, 0.50, 0.38), 3), Stroke((0.80, 0.30, 0.55), 3)


def draw(inputs: Inputs) -> Picture:
    need(len(inputs.states) == 1 and len(inputs.clouds) == 1, "postures",
         "a deformed .vtkhdf and the .vtp of what was seen (identify --second and --seen)")
    state, seen = inputs.states[0], inputs.clouds[0]
    shapes = [Shape(state, state.imaged, "as scanned", SHAPES[0]),
              Shape(state, state.points, f"{posture_of(state.gravity)} as predicted", SHAPES[1])]
    height = height_of_nipple(state, state.points)
    picture = Picture(1100, 940)
    panel = picture.panel(0, 0, 1, 1)
    panel.caption("transverse section through the nipple as predicted, seen from below")
    panel.legend([*((shape.name, shape.stroke) for shape in shapes), ("skin as seen in the second scan", _SEEN_SKIN),
                  ("front of the muscle as seen in the second scan", _SEEN_WALL), *back_legend(state)])
    add_sections(panel, shapes, height)
    away = np.abs(seen.points[:, 2] - height)  # a slab as thick as the slices of the second scan are apart
    near, wall = away <= max(_THINNEST, 1.5 * away.min()), on_wall(seen)
    for which, stroke, marker in ((near & ~wall, _SEEN_SKIN, "o"), (near & wall, _SEEN_WALL, "D")):
        panel.axes.scatter(*panel.camera.flat(seen.points[which]).T, s=7, marker=marker, color=[stroke.colour], linewidths=0)
    panel.frame(panel.centre, panel.mm_per_pixel)
    add_landmarks(panel, shapes)
    panel.scale_bar()
    panel.compass()
    return picture
