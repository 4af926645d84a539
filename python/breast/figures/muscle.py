# SPDX-License-Identifier: GPL-3.0-or-later
"""What the back of a model is called: the chest wall of the scan, or the back of a layer of muscle, which may be assumed."""
from __future__ import annotations

import re

import numpy as np

from ..elements import face_corners
from ..state import TISSUES, State
from .body import inner_faces


def back_words(state: State) -> str:
    """ "chest wall", or "back of the muscle (...)" with its thickness and whether that is an assumption.

    A scan seldom shows where the muscle ends: `hexmesh --muscle measured` then takes 8 mm, and a number is taken as it is given.
    """
    if not (state.tissue == TISSUES.index("muscle")).any():
        return "chest wall"
    thickness = _thickness(state)
    measured = any(re.search(r"--muscle[ =]measured", c.command) for c in state.history if c.tool == "hexmesh")
    assumed = "assumed where the scan does not show it" if measured else "assumed"
    return f"back of the muscle ({thickness:.0f} mm, {assumed})"


def _thickness(state: State) -> float:
    """Median distance in the scan, mm, of the front of the layer from its back: the mean edge of an element across the layer."""
    own = state.hexahedra[state.tissue == TISSUES.index("muscle")][:, :8]
    behind = np.zeros(len(state.imaged), bool)
    behind[state.node_sets["pectoral"]] = True
    nodes, back = state.imaged[own], behind[own]
    whole = back.sum(1) == 4  # one face of the element is the back
    if not whole.any():
        return 0.0
    rear, front = (nodes[whole][mask[whole]].reshape(-1, 4, 3).mean(1) for mask in (back, ~back))
    return float(np.median(np.linalg.norm(front - rear, axis=1)))


def front_of_muscle(state: State) -> np.ndarray:
    """The faces (F, 2) between the layer of muscle and the breast before it: the chest wall of the scan."""
    faces = inner_faces(state, "muscle")
    return faces[~np.isin(face_corners(state.hexahedra, faces), state.node_sets["pectoral"]).any(1)]
