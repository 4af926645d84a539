# SPDX-License-Identifier: GPL-3.0-or-later
"""The pose of a mammographic view, and the image that a compressed breast gives (libbreast/views, libbreast/projection/framing)."""
from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .errors import BreastError
from .state import State

_AIR_MARGIN = 4  # mm of air shown around the breast


def lateral_sign(side: str) -> int:
    """1 for the left breast, whose outer side is at greater x; -1 for the right."""
    return 1 if side == "left" else -1


@dataclass(frozen=True)
class ViewPose:
    """Beam and image axes as unit vectors (3): n from paddle to detector, e_u away from the chest wall, e_v = n × e_u.

    origin (3), LPS mm, is where (u, v) = (0, 0).
    """

    n: np.ndarray
    e_u: np.ndarray
    e_v: np.ndarray
    origin: np.ndarray


@dataclass(frozen=True)
class ImageFrame:
    """Pose and extent in mm of the image, for parallel rays."""

    pose: ViewPose
    width: float
    height: float


def view_axes(side: str, angle_deg: float, turn_deg: float, lean_deg: float,
              bend_deg: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """n, e_u and e_v: the beam at an angle from cranio-caudal, both turned about the patient's long axis, and e_u leaning about
    the beam with its upper end backwards; finally both turned about e_v, of a patient who bends forwards."""
    sign = lateral_sign(side)
    theta, lean, bend, turn = (np.deg2rad(a) for a in (angle_deg, lean_deg, bend_deg, sign * turn_deg))
    turned = np.array([[np.cos(turn), -np.sin(turn), 0], [np.sin(turn), np.cos(turn), 0], [0, 0, 1]])
    n = turned @ [sign * np.sin(theta), 0, -np.cos(theta)]
    axis = turned @ [0, -1, 0]
    upwards = sign * np.cross(axis, n)
    e_u = np.cos(lean) * axis + np.sin(lean) * upwards
    e_v = np.cross(n, e_u)
    return np.cos(bend) * n + np.sin(bend) * e_u, np.cos(bend) * e_u - np.sin(bend) * n, e_v


def image_frame(state: State) -> ImageFrame:
    """Where the image of a compressed breast lies, as project-mammogram frames it. Raises BreastError without plates."""
    contact = state.contact
    if contact is None:
        raise BreastError("has no compression record", state.file, "run compress first")
    n, e_u, e_v = view_axes(state.side, contact.angle_deg, contact.turn_deg, contact.lean_deg, contact.bend_deg)
    plates = list(contact.plates.values())
    along, across = state.points @ e_u, state.points @ e_v
    if contact.ends_image:
        u0 = float(plates[-1].origin @ e_u)
    else:
        back = np.concatenate([state.node_sets[name] for name in ("pectoral", "cut")])
        u0 = float(along[back].max(initial=along.min()))
    seen = state.hexahedra[(along[state.hexahedra] > u0).any(1)]
    if not len(seen) or not np.ptp(across[seen]) > 0:
        raise BreastError("there is no tissue in front of its chest-wall and cut surfaces to be imaged", state.file)
    lower, upper = across[seen].min(), across[seen].max()

    heights = [float(plate.origin @ n) for plate in plates if plate.name == "detector"]
    depth = max([float((state.points @ n).max()), *heights[:1]])
    middle = 0.5 * (lower + upper)
    front = along >= u0
    low = min(float((across[front] - middle).min()), 0.5 * (lower - upper)) - _AIR_MARGIN
    high = max(float((across[front] - middle).max()), 0.5 * (upper - lower)) + _AIR_MARGIN
    origin = u0 * e_u + (middle + low) * e_v + depth * n
    return ImageFrame(ViewPose(n, e_u, e_v, origin), float(along[front].max()) - u0 + _AIR_MARGIN, high - low)
