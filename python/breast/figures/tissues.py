# SPDX-License-Identifier: GPL-3.0-or-later
"""The fibroglandular region and the tumour through a translucent skin (Fig. 4)."""
from __future__ import annotations

from .body import add_body, anterior_view, lateral_view, tumour_words
from .inputs import Inputs, need
from .layout import Picture
from .muscle import back_words
from .scene import Scene


def draw(inputs: Inputs) -> Picture:
    need(inputs.states, "tissues", "a mesh .vtkhdf")
    state, picture, scene = inputs.states[0], Picture(1600, 800), Scene()
    add_body(scene, state, state.points, skin_opacity=0.28, gland_opacity=0.85)
    tumour = tumour_words(state)
    words = f"(a) fibroglandular (violet){f', {tumour} drawn through' if tumour else ''}; dark red: {back_words(state)}"
    for k, (view, caption) in enumerate(((lateral_view(state.side), words),
                                         (anterior_view(), f"(b) {state.side} breast from the front"))):
        panel = picture.panel(0.5 * k, 0, 0.5 * (k + 1), 1)
        panel.caption(caption)
        panel.scene(scene, view)
    return picture
