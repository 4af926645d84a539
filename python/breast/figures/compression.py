# SPDX-License-Identifier: GPL-3.0-or-later
"""The shapes between the plates (Fig. 5): stress-free, compressed, and from the front."""
from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..records import Plate
from ..state import State
from ..views import image_frame
from .body import add_body, add_image_border, add_plates, compression_words, plate_view, two_plates
from .inputs import Inputs, need
from .layout import Panel, Picture
from .scene import Camera, Scene


def edge_recession(radius: float, beyond: np.ndarray) -> np.ndarray:
    """By how many mm a rounded edge lies behind the plate's flat, at so many mm beyond its start; infinite where it ends."""
    within = np.sqrt(np.maximum(radius**2 - np.maximum(beyond, 0) ** 2, 0))
    return np.where(beyond > 0, np.where(beyond < radius, radius - within, np.inf), 0.0)


def drawn_back(plate: Plate, nodal: np.ndarray) -> Plate:
    """The plate where it just touches a shape (N, 3)."""
    offset = nodal - plate.origin
    depth = -offset @ plate.normal - edge_recession(plate.edge_radius, -offset @ plate.anterior)
    return replace(plate, origin=plate.origin - max(0.0, float(depth.max())) * plate.normal)


def show(panels: list[tuple[Panel, Scene, Camera, str]]) -> None:
    """Draws scenes at one scale, that of the largest."""
    for panel, _, _, words in panels:
        panel.caption(words)
    scale = max(panel.needed(camera.flat(scene.shown())) for panel, scene, camera, _ in panels)
    for panel, scene, camera, _ in panels:
        panel.scene(scene, camera, scale)


def _row(picture: Picture, state: State, bottom: float, top: float, letter: str) -> list[tuple[Panel, Scene, Camera, str]]:
    before, after, front = Scene(), Scene(), Scene()
    stress_free = state.imaged if state.reference is None else state.reference
    plates = two_plates(state)
    add_body(before, state, stress_free)
    add_plates(before, state, stress_free, [drawn_back(plate, stress_free) for plate in plates], 0.45)
    add_body(after, state, state.points)
    add_plates(after, state, state.points, plates, 0.45)
    add_body(front, state, state.points, edges=True)
    add_plates(front, state, state.points, plates, 0.25)
    add_image_border(after, state)
    add_image_border(front, state)
    view, pose = plate_view(state), image_frame(state).pose
    ahead = Camera(-pose.e_u + 0.35 * view.direction + 0.3 * pose.n, -pose.n)
    words = "stress-free, plates touching", compression_words(state), "from the front; orange: border of the image"
    return [(picture.panel(k / 3, bottom, (k + 1) / 3, top), scene, camera, f"({chr(ord(letter) + k)}) {words[k]}")
            for k, (scene, camera) in enumerate(((before, view), (after, view), (front, ahead)))]


def draw(inputs: Inputs) -> Picture:
    states = inputs.compressed()[:2]
    need(states, "compression", "a compressed .vtkhdf")
    picture, rows = Picture(1600, 560 * len(states)), len(states)
    for r, state in enumerate(states):
        show(_row(picture, state, 1 - (r + 1) / rows, 1 - r / rows, "ad"[r]))
    return picture
