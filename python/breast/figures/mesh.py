# SPDX-License-Identifier: GPL-3.0-or-later
"""The edges of a mesh's elements, from the front and from behind (Figs 4 and 5)."""
from __future__ import annotations

import numpy as np

from .body import add_body, oblique_view
from .inputs import Inputs, need
from .layout import Picture, from_two_sides
from .scene import Camera, Scene


def draw(inputs: Inputs) -> Picture:
    need(inputs.states, "mesh", "a mesh .vtkhdf")
    state, scene = inputs.states[0], Scene()
    add_body(scene, state, state.points, edges=True)
    front = oblique_view(state.side)
    return from_two_sides(scene, (
        (front, f"{len(state.hexahedra)} hexahedra, {len(state.points)} nodes ({state.template[0]})"),
        (Camera(front.direction * np.array([1, -1, 1]), front.up), "from behind: back of the model (dark) and cut surface, where it ends")))
