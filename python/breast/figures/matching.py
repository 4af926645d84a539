# SPDX-License-Identifier: GPL-3.0-or-later
"""The column of tissue that a point of the CC image is, in the CC, stress-free and MLO shapes (Fig. 7)."""
from __future__ import annotations

import numpy as np

from ..curves import Line
from ..state import State
from .body import UP, add_body, plate_view, tumour_words
from .colours import COLUMN
from .compression import show
from .inputs import Inputs, need
from .layout import Picture
from .scene import Camera, Scene
from ..views import lateral_sign


def moved_columns(state: State, curves: dict[str, list[Line]], shape: str = "points") -> list[np.ndarray]:
    """The tissue above each point asked for in CC, lines (n, 3) LPS mm in a shape of a state; what lies in no element is left out.

    Between the plates of the other view it is the curve, seen along the beam.
    """
    lines = (state.transport(line.points, "imaged", shape, within=1.0) for line in curves.get("column in imaged", []))
    return [line.points[line.inside] for line in lines]


def add_columns(scene: Scene, state: State, curves: dict[str, list[Line]], shape: str = "points") -> None:
    """The same as tubes, seen through the body."""
    for column in moved_columns(state, curves, shape):
        scene.tube(column, 1.0, COLUMN, through=True)


def _scene(state: State, shape: str, curves: dict[str, list[Line]]) -> Scene:
    scene = Scene()
    add_columns(scene, state, curves, shape)  # first, so that the tumour in it is not hidden
    add_body(scene, state, state.shape(shape), skin_opacity=0.22, gland_opacity=0.7)
    return scene


def draw(inputs: Inputs) -> Picture:
    need(inputs.curves, "matching", "a curve .vtp")
    cc = next((s for s in inputs.compressed() if s.contact.view == "CC"), None)
    other = next((s for s in inputs.compressed() if s.contact.view != "CC"), None)
    need(cc or other, "matching", "a compressed .vtkhdf")
    any_state = cc or other
    shown: list[tuple[State, str, str, Camera]] = []
    if cc:
        tumour = tumour_words(cc)
        shown.append((cc, "points", "CC: tissue above the pixel (green)" + (f", {tumour}" if tumour else ""),
                      plate_view(cc)))
    stress_free = "imaged" if any_state.reference is None else "reference"
    # The same body turned as between the plates.
    side = Camera(np.array([-lateral_sign(any_state.side), 0.35, -0.22]), UP)
    shown.append((any_state, stress_free, "the same tissue, stress-free", side))
    if other:
        shown.append((other, "points", f"the same tissue in {other.contact.view}", plate_view(other)))
    picture, n = Picture(600 * len(shown), 680), len(shown)
    show([(picture.panel(k / n, 0, (k + 1) / n, 1), _scene(state, shape, inputs.curves), view, f"({'abc'[k]}) {words}")
          for k, (state, shape, words, view) in enumerate(shown)])
    return picture
