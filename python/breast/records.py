# SPDX-License-Identifier: GPL-3.0-or-later
"""What a mechanics tool recorded: its model, how the solve converged, and the plates of a compression."""
from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from .document import Document


@dataclass(frozen=True)
class Model:
    """The mechanical model with which the state was solved, in the words of a tool's command line.

    Attributes:
        name: of the material set.
        materials: the set itself as a tab-separated table: laws, densities, skin, supports, uncertainty.
        element: q1p0 or q2p1.
        invariants: isochoric or plain.
        bulk_ratio: bulk to shear modulus, or 'incompressible'.
        wall, cut: the boundary conditions, as of --wall and --cut.
    """

    name: str
    materials: str
    element: str
    invariants: str
    bulk_ratio: str
    wall: str
    cut: str


@dataclass(frozen=True)
class Solve:
    """How the state was solved.

    Attributes:
        status: converged, stopped_early, not_gripped, unstable or not_converged.
        reason: why not; empty when converged.
        iterations: columns of one row a Newton iteration: step, iteration, residual, min_det_F, max_det_F, step_length,
            seconds.
    """

    status: str
    reason: str
    iterations: dict[str, np.ndarray]


@dataclass(frozen=True)
class Plate:
    """One compression plate.

    Attributes:
        name: paddle or detector.
        normal: unit vector (3) into the gap, LPS.
        anterior: unit vector (3) in the plate, away from the chest wall, LPS.
        origin: point (3) of the flat where the rounded edge starts, LPS mm.
        edge_radius: of the rounded edge, mm.
        force_N, area_cm2, mean_kPa, peak_kPa: what it does to the breast.
        worst_gap_mm: how deep the body enters it.
    """

    name: str
    normal: np.ndarray
    anterior: np.ndarray
    origin: np.ndarray
    edge_radius: float
    force_N: float
    area_cm2: float
    mean_kPa: float
    peak_kPa: float
    worst_gap_mm: float


@dataclass(frozen=True)
class Contact:
    """A compression between two plates.

    Attributes:
        view: CC, MLO or ML.
        angle_deg: beam angle from cranio-caudal, degrees.
        turn_deg: by which the plates' edge is turned about the patient's long axis, degrees.
        lean_deg: by which it is turned about the beam, with its upper end backwards, degrees.
        bend_deg: by which the patient bends forwards, degrees.
        thickness_mm, initial_thickness_mm: gap between the flats now, and extent of the breast before.
        reduction_percent, standoff_mm: see the tool compress.
        ends_image: whether the image ends at the plates' edge.
        paddle_share: fraction of any further closing that the paddle does.
        surface_stiffness: of the plates against faces, Pa/mm; 0 where nodes touch exactly.
        plates: by name.
        path: columns thickness_mm, force_N (paddle) and detector_N along the compression.
    """

    view: str
    angle_deg: float
    turn_deg: float
    lean_deg: float
    bend_deg: float
    thickness_mm: float
    initial_thickness_mm: float
    reduction_percent: float
    standoff_mm: float
    ends_image: bool
    paddle_share: float
    surface_stiffness: float
    plates: dict[str, Plate]
    path: dict[str, np.ndarray]


def read_model(document: Document) -> Model | None:
    """The model with which the state was solved; None for a file that does not state it."""
    group = "/breast/model"
    if not document.has_group(group):
        return None
    return Model(**{part.name: document.text(f"{group}@{part.name}") for part in fields(Model)})


def read_solve(document: Document) -> Solve | None:
    """The record of the solve; None for a mesh that nothing has solved yet."""
    group = "/breast/solve"
    if not document.has_group(group):
        return None
    iterations = {name: document.integers(f"{group}/{name}") for name in ("step", "iteration")}
    for name in ("residual", "min_det_F", "max_det_F", "step_length", "seconds"):
        iterations[name] = document.numbers(f"{group}/{name}")
    return Solve(document.text(f"{group}@status"), document.text(f"{group}@reason"), iterations)


def read_contact(document: Document) -> Contact | None:
    """The record of a compression; None for a state without plates."""
    group = "/breast/contact"
    if not document.has_group(group):
        return None

    def number(name: str) -> float:
        return document.number(f"{group}@{name}")

    return Contact(
        document.text(f"{group}@view"), number("angle_deg"), number("turn_deg"), number("lean_deg"), number("bend_deg"),
        number("thickness_mm"), number("initial_thickness_mm"), number("reduction_percent"), number("standoff_mm"),
        number("ends_image") != 0, number("paddle_share"), number("surface_stiffness"), _plates(document),
        {name: document.numbers(f"{group}/path_{name}") for name in ("thickness_mm", "force_N", "detector_N")})


def _plates(document: Document) -> dict[str, Plate]:
    group = "/breast/contact/plates"
    names = document.texts(f"{group}/name")
    columns = [document.numbers(f"{group}/{part.name}") for part in fields(Plate)[1:]]
    return {name: Plate(name, *(column[i] if column.ndim > 1 else float(column[i]) for column in columns)) for i, name in enumerate(names)}
