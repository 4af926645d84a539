# SPDX-License-Identifier: GPL-3.0-or-later
"""The edges of a mesh's elements, from the front and from behind (Figs 4 and 5)."""
from __future__ import annotations

import numpy as np

from .body import add_body, oblique_view
from .inputs import Inputs, need
from .layout import Picture
from .scene import Camera, Scene


def draw(inputs: Inputs) -> Picture:
    need(inputs.states, "mesh", "a mesh .vtkhdf")
    state, picture, scene = inputs.states[0], Picture(1600, 800), Scene()
    add_body(scene, state, state.points, edges=True)
    front = oblique_view(state.side)
    views = front, Camera(front.direction * np.array([1, -1, 1]), front.up)
    captions = (f"(a) {len(state.hexahedra)} hexahedra, {len(state.points)} nodes ({state.template[0]})",
                "(b) from behind: back of the model (dark) and cut surface, where it ends")
    for k in range(2):
        panel = picture.panel(0.5 * k, 0, 0.5 * (k + 1), 1)
        panel.caption(captions[k])
        panel.scene(scene, views[k])
    return picture
