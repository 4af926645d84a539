# SPDX-License-Identifier: GPL-3.0-or-later
"""The data points of skin and chest wall that segment found (Fig. 4)."""
from __future__ import annotations

import numpy as np

from ..xml_mesh import XmlMesh
from .body import lateral_view, oblique_view
from .colours import MUSCLE, SKIN
from .inputs import Inputs, need
from .layout import Picture, from_two_sides
from .scene import Scene

DOT_MM = 0.7
_MOST = 10000  # as many as the eye can tell apart


def on_wall(cloud: XmlMesh) -> np.ndarray:
    """Which points (P) lie on the chest wall; the others lie on the skin."""
    return np.asarray(cloud.point_arrays.get("surface", np.zeros(len(cloud.points)))) > 0.5


def add_points(scene: Scene, cloud: XmlMesh) -> None:
    wall = on_wall(cloud)
    for which, colour in ((~wall, SKIN), (wall, MUSCLE)):
        some = cloud.points[which]
        if len(some):
            scene.balls(some[:: 1 + len(some) // _MOST], DOT_MM, colour)


def draw(inputs: Inputs) -> Picture:
    need(inputs.clouds, "points", "a .vtp of data points")
    cloud, scene = inputs.clouds[0], Scene()
    add_points(scene, cloud)
    # No mesh states the side; it follows from the centre of the points in x.
    side = "left" if cloud.points[:, 0].mean() >= 0 else "right"
    return from_two_sides(scene, ((oblique_view(side), "data points: skin (light), chest wall (dark)"),
                                  (lateral_view(side), "from the outer side")))
