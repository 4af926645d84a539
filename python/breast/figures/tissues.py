# SPDX-License-Identifier: GPL-3.0-or-later
"""The fibroglandular region and the tumour through a translucent skin (Fig. 4)."""
from __future__ import annotations

from .body import add_body, anterior_view, lateral_view, tumour_words
from .inputs import Inputs, need
from .layout import Picture, from_two_sides
from .muscle import back_words
from .scene import Scene


def draw(inputs: Inputs) -> Picture:
    need(inputs.states, "tissues", "a mesh .vtkhdf")
    state, scene = inputs.states[0], Scene()
    add_body(scene, state, state.points, skin_opacity=0.28, gland_opacity=0.85)
    tumour = tumour_words(state)
    words = f"fibroglandular (violet){f', {tumour} drawn through' if tumour else ''}; dark red: {back_words(state)}"
    return from_two_sides(scene, ((lateral_view(state.side), words), (anterior_view(), f"{state.side} breast from the front")))
