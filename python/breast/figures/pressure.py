# SPDX-License-Identifier: GPL-3.0-or-later
"""Contact pressure of paddle and detector on the skin, seen through each plate along the beam."""
from __future__ import annotations

import numpy as np

from ..records import Plate
from ..state import State
from .body import face_facets, two_plates
from .colours import CUT, HEAT, MUSCLE
from .inputs import Inputs, need
from .layout import Panel, Picture
from .scene import Camera, Look, Scene

_BAR = 90  # pixels


def round_up(value: float, steps: tuple[float, ...] = (1, 2, 5)) -> float:
    """The next of these multiples of a power of ten."""
    decade = 10 ** np.floor(np.log10(value))
    return next((step * decade for step in steps if step * decade >= value * (1 - 1e-12)), 10 * decade)


def _add_side(panel: Panel, state: State, plate: Plate, high: float, letter: str) -> None:
    scene, contact = Scene(), state.contact
    skin = face_facets(state, state.points, state.faces["skin"])
    used, place = np.unique(skin.quads, return_inverse=True)
    skin.points, skin.quads = skin.points[used], place.reshape(-1, 4)
    scene.values(skin, state.point_arrays["contact_pressure"][used], high)
    scene.surface(face_facets(state, state.points, state.faces["cut"]), Look(CUT))
    scene.surface(face_facets(state, state.points, state.faces["pectoral"]), Look(MUSCLE))
    lateral = np.cross(plate.normal, plate.anterior)
    half = np.abs((state.points - plate.origin) @ lateral).max()
    before = plate.origin - 30 * plate.normal  # before the skin, for the viewer
    scene.tube(np.array([before - half * lateral, before + half * lateral]), 0.4, (0.1, 0.35, 0.65))
    panel.caption(f"{letter} {plate.name}, {contact.view}: {plate.force_N:.0f} N on {plate.area_cm2:.0f} cm2, "
                  f"mean {plate.mean_kPa:.1f} kPa, peak {plate.peak_kPa:.0f} kPa; blue: here the plate's rounded edge begins")
    panel.scene(scene, Camera(plate.normal, plate.anterior), right=_BAR)
    panel.colour_bar(HEAT, high, "kPa")


def draw(inputs: Inputs) -> Picture:
    states = [s for s in inputs.compressed() if "contact_pressure" in s.point_arrays]
    need(states, "pressure", "a compressed .vtkhdf")
    peak = max(float(s.point_arrays["contact_pressure"].max()) for s in states)
    high = round_up(max(peak, 1e-3), (1, 1.2, 1.6, 2, 2.4, 3.2, 4, 6, 8))
    rows = min(len(states), 2)
    picture = Picture(1600, 650 * rows)
    for r, state in enumerate(states[:2]):
        for k, plate in enumerate(two_plates(state)):
            panel = picture.panel(0.5 * k, 1 - (r + 1) / rows, 0.5 * (k + 1), 1 - r / rows)
            _add_side(panel, state, plate, high, f"({'abcd'[2 * r + k]})")
    return picture
