# SPDX-License-Identifier: GPL-3.0-or-later
"""The states on the way to a shape, one after the other: the breast as gravity turns, or as the plates close on it."""
from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ..curves import Line
from ..state import State
from ..text_table import number_in, read_table
from ..views import image_frame
from .animation import Animation
from .body import (add_body, add_plates, compression_words, from_below, has_tumour, lateral_view, place_of, plate_view, tumour_words,
                   two_plates)
from .colours import COLUMN, INK, SHAPES, TUMOUR, Colour, Stroke
from .inputs import Inputs, need
from .layout import RING, SMALL, Panel, Picture
from .matching import add_columns
from .scene import Camera, Scene

_SIZE = (1120, 560)
_SKIN, _GLAND, _PLATES = 0.5, 0.6, 0.35
"""Opacities."""
_ARROW, _ARROW_AT = 60, np.array([190.0, 60.0])
"""Length and middle of the arrow of gravity, pixels."""


@dataclass(frozen=True)
class _View:
    """A camera, and the frame (middle and mm in a pixel) in which it shows every state."""

    camera: Camera
    words: str
    flat: np.ndarray


def _scene(state: State, curves: dict[str, list[Line]]) -> Scene:
    scene = Scene()
    add_columns(scene, state, curves)  # first, as in the figure matching
    add_body(scene, state, state.points, _SKIN, gland_opacity=_GLAND)
    if state.contact:
        add_plates(scene, state, state.points, two_plates(state), _PLATES)
    return scene


def _cameras(last: State) -> list[tuple[Camera, str]]:
    if last.contact is None:
        return [(from_below(), "seen from below"), (lateral_view(last.side), "seen from the outer side")]
    view, pose = plate_view(last), image_frame(last).pose
    return [(view, "seen along the plates"), (Camera(-pose.e_u + 0.35 * view.direction + 0.3 * pose.n, -pose.n), "seen from the front")]


def _turned(first: State, state: State) -> float:
    """The angle between the gravities of two states, degrees; 0 without one."""
    sizes = np.linalg.norm(first.gravity) * np.linalg.norm(state.gravity)
    return float(np.degrees(np.arccos(np.clip(first.gravity @ state.gravity / sizes, -1, 1)))) if sizes > 0 else 0.0


def _hands(states: list[State]) -> list[str]:
    """What a hand does at each state, by the table beside them. When it lets go, the breast may slip back, which looks like a leap."""
    table = states[0].file.parent / "states.tsv"
    rows = {row["file"]: row for row in read_table(table).records()} if table.exists() else {}
    held = [any((number_in(rows.get(state.file.name, {}).get(name, "")) or 0) > 0 for name in ("hand_carries_percent", "hand_pulls_N"))
            for state in states]
    return [", held by a hand" if holds else ", the hand has let go" if any(held[:k]) else "" for k, holds in enumerate(held)]


def _words(states: list[State], k: int, hand: str) -> str:
    state = states[k]
    words = compression_words(state) + hand if state.contact else f"gravity turned by {_turned(states[0], state):.0f} degrees"
    for name in ("tumour", "nipple"):
        if name == "nipple" and name in state.landmarks or name == "tumour" and has_tumour(state):
            away = np.linalg.norm(place_of(state, name, state.points) - place_of(states[0], name, states[0].points))
            words += f", {name} moved {away:.0f} mm"
    return f"{words} (equilibrium {k + 1} of {len(states)})"


def _add_trail(panel: Panel, states: list[State], k: int, name: str, colour: Colour, stroke: Stroke) -> None:
    """The way of a landmark up to a state, and a ring where it is."""
    places = np.array([place_of(state, name, state.points) for state in states[:k + 1]])
    flat = panel.camera.flat(places)
    panel.lines([flat] if k else [], stroke, halo=True)
    panel.ring(flat[-1], RING, colour)


def _add_gravity(panel: Panel, state: State) -> None:
    """An arrow as long as the part of gravity that lies in the picture's plane; where hardly any does, words say where it points."""
    size = np.linalg.norm(state.gravity)
    if state.contact or not size > 0:
        return
    along = panel.camera.flat(state.gravity[None])[0] / size
    start, tip = (panel.centre + (_ARROW_AT + half * _ARROW * along - 0.5 * panel.size) * panel.mm_per_pixel for half in (-0.5, 0.5))
    panel.arrow(start, tip)
    away = float(panel.camera.axes()[2] @ state.gravity) / size
    words = "gravity" if abs(away) < 0.9 else f"gravity {'into' if away > 0 else 'out of'} the picture"
    panel.text(_ARROW_AT + [0.5 * _ARROW + 8, 0], words, SMALL, INK)


def _pictures(states: list[State], curves: dict[str, list[Line]]) -> Iterator[Picture]:
    scenes = [_scene(state, curves) for state in states]
    column = "; green: the tissue above its CC pixel" if curves.get("column in imaged") else ""
    everything = np.concatenate([scene.shown() for scene in scenes])
    views = [_View(camera, words, camera.flat(everything)) for camera, words in _cameras(states[-1])]
    for k, (state, scene, hand) in enumerate(zip(states, scenes, _hands(states))):
        picture = Picture(*_SIZE)
        head = picture.panel(0, 0.92, 1, 1)
        head.caption(_words(states, k, hand))
        panels = [picture.panel(n / len(views), 0, (n + 1) / len(views), 0.93) for n in range(len(views))]
        for panel, view in zip(panels, views):
            panel.caption(f"{view.words}{'; ' + tumour_words(state) if tumour_words(state) else ''}{column}")
        scale = max(panel.needed(view.flat) for panel, view in zip(panels, views))
        for panel, view in zip(panels, views):
            panel.still(scene, view.camera, view.flat, scale)
            if "nipple" in state.landmarks:
                _add_trail(panel, states, k, "nipple", SHAPES[2].colour, SHAPES[2])
            if has_tumour(state):
                _add_trail(panel, states, k, "tumour", TUMOUR, Stroke(TUMOUR, 2.4))
            _add_gravity(panel, state)
        yield picture


def draw(inputs: Inputs) -> Animation:
    need(len(inputs.states) > 1, "states", "the .vtkhdf of a folder NAME-states, in their order")
    return Animation(_pictures(inputs.states, inputs.curves), [COLUMN, TUMOUR, SHAPES[2].colour])
