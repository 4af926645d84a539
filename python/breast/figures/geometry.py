# SPDX-License-Identifier: GPL-3.0-or-later
"""The fitted cubic-Hermite sheets with the lines of their patches and the rim of the body (Fig. 4)."""
from __future__ import annotations

import numpy as np
from matplotlib.path import Path

from ..geometry import Sheet
from .body import lateral_view, oblique_view
from .colours import MUSCLE, RIM, SKIN, Colour
from .inputs import Inputs, need
from .layout import Picture, from_two_sides
from .points import add_points
from .scene import Facets, Look, Scene

_FINENESS = 20  # cells in a patch


def _add_sheet(scene: Scene, sheet: Sheet, rim: np.ndarray, look: Look, line: Colour) -> None:
    """The part within the rim, the lines of its patches there, and the rim."""
    patches = np.array([sheet.x.shape[1] - 1, sheet.x.shape[0] - 1])
    nu, nv = _FINENESS * patches
    s, t = np.meshgrid(np.arange(nu + 1) / nu, np.arange(nv + 1) / nv)
    corner = np.arange((nu + 1) * nv).reshape(nv, nu + 1)[:, :-1].ravel()
    quads = corner[:, None] + [0, 1, nu + 2, nu + 1]
    middle = np.stack([s.ravel()[corner] + 0.5 / nu, t.ravel()[corner] + 0.5 / nv], -1)
    within = Path(rim)
    scene.surface(Facets(sheet.points(np.stack([s.ravel(), t.ravel()], -1)), quads[within.contains_points(middle)]), look)
    for along in (0, 1):
        moving = np.linspace(0, 1, 2 * _FINENESS * patches[along] + 1)
        for fixed in np.arange(patches[1 - along] + 1) / patches[1 - along]:
            st = np.insert(np.full((len(moving), 1), fixed), along, moving, axis=1)
            inside = np.flatnonzero(within.contains_points(st))
            for part in np.split(inside, np.flatnonzero(np.diff(inside) > 1) + 1):
                scene.tube(sheet.points(st[part]) if len(part) else np.zeros((0, 3)), 0.25, line)
    # Straight in (s, t), so sampled between its points.
    fine = (rim[:, None] + np.linspace(0, 1, 4, endpoint=False)[:, None] * (np.roll(rim, -1, 0) - rim)[:, None]).reshape(-1, 2)
    scene.tube(sheet.points(np.vstack([fine, fine[:1]])), 0.9, RIM)


def draw(inputs: Inputs) -> Picture:
    need(inputs.geometry, "geometry", "a geometry .vtkhdf")
    geometry, scene = inputs.geometry, Scene()
    _add_sheet(scene, geometry.skin, geometry.rim_skin, Look(SKIN, 0.75), (0.35, 0.25, 0.2))
    _add_sheet(scene, geometry.wall, geometry.rim_wall, Look(MUSCLE), (0.1, 0.03, 0.03))
    scene.balls(geometry.nipple[None], 2.5, (0.75, 0.35, 0.3))
    for cloud in inputs.clouds:
        add_points(scene, cloud)
    nv, nu = np.array(geometry.skin.x.shape[:2]) - 1
    return from_two_sides(scene, (
        (oblique_view(geometry.side), f"cubic-Hermite sheets, {nu} x {nv} patches; blue: rim of the body"),
        (lateral_view(geometry.side),
         f"{geometry.side} breast from its outer side; mean distance of the fit {geometry.fit_mm['mean']:.2f} mm")))
