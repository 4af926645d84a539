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
class Friction:
    """The n nodes that friction of a plate holds.

    Attributes:
        node: (n) node numbers.
        plate: (n) 0 paddle or 1 detector.
        anchor: (n, 3) where the node is anchored, LPS mm.
        bound: (n) the largest tangential force, µN.
        stick: (n) stiffness of the hold, µN/mm.
    """

    node: np.ndarray
    plate: np.ndarray
    anchor: np.ndarray
    bound: np.ndarray
    stick: np.ndarray


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
        friction: what friction holds, or None.
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
    friction: Friction | None
    path: dict[str, np.ndarray]


def read_model(document: Document) -> Model | None:
    """The model with which the state was solved; None for a file that does not state it."""
    group = "/breast/model"
    if not document.has_group(group):
        return None
    texts = {part.name: document.text(f"{group}@{part.name}") for part in fields(Model)}
    for name, text in texts.items():
        if not text:
            raise document.refuse(f"attribute {group}@{name} is empty, must state this part of the model")
    return Model(**texts)


def read_solve(document: Document) -> Solve | None:
    """The record of the solve; None for a mesh that nothing has solved yet."""
    group = "/breast/solve"
    if not document.has_group(group):
        return None
    status = document.text(f"{group}@status", ("converged", "stopped_early", "not_gripped", "unstable", "not_converged"))
    rows = len(document.integers(f"{group}/step", (None,)))
    iterations = {name: document.integers(f"{group}/{name}", (rows,)) for name in ("step", "iteration")}
    for name in ("residual", "min_det_F", "max_det_F", "step_length", "seconds"):
        iterations[name] = document.numbers(f"{group}/{name}", (rows,))
    return Solve(status, document.text(f"{group}@reason"), iterations)


def read_contact(document: Document, nodes: int) -> Contact | None:
    """The record of the compression of a mesh of that many nodes; None for a state without plates."""
    group = "/breast/contact"
    if not document.has_group(group):
        return None

    def number(name: str) -> float:
        return document.number(f"{group}@{name}")

    share = number("paddle_share")
    if not 0 <= share <= 1:
        raise document.refuse(f"attribute {group}@paddle_share is {share}, must be 0 to 1")
    stiffness = number("surface_stiffness")
    if stiffness < 0:
        raise document.refuse(f"attribute {group}@surface_stiffness is {stiffness} Pa/mm, must be 0 or more")
    return Contact(
        document.text(f"{group}@view", ("CC", "MLO", "ML")), number("angle_deg"), number("turn_deg"), number("lean_deg"),
        number("bend_deg"), number("thickness_mm"), number("initial_thickness_mm"), number("reduction_percent"), number("standoff_mm"),
        number("ends_image") != 0, share, stiffness, _plates(document), _friction(document, nodes), _path(document))


def _plates(document: Document) -> dict[str, Plate]:
    group = "/breast/contact/plates"
    names = document.names(f"{group}/name")
    axes = {name: document.places(f"{group}/{name}", len(names)) for name in ("normal", "anterior", "origin")}
    for name in ("normal", "anterior"):
        for i, length in enumerate(np.linalg.norm(axes[name], axis=1)):
            if abs(length - 1) >= 1e-6:
                raise document.refuse(f"dataset {group}/{name}[{i}] has length {length}, must be 1")
    columns = ("edge_radius", "force_N", "area_cm2", "mean_kPa", "peak_kPa", "worst_gap_mm")
    values = {name: document.numbers(f"{group}/{name}", (len(names),)) for name in columns}
    return {name: Plate(name, *(axes[a][i] for a in ("normal", "anterior", "origin")),
                        *(float(values[c][i]) for c in columns)) for i, name in enumerate(names)}


def _friction(document: Document, nodes: int) -> Friction | None:
    group = "/breast/contact/friction"
    node = document.integers(f"{group}/node", (None,), 0, nodes)
    friction = Friction(node, document.integers(f"{group}/plate", (len(node),), 0, 2),
                    document.places(f"{group}/anchor", len(node)), document.numbers(f"{group}/bound", (len(node),)),
                    document.numbers(f"{group}/stick", (len(node),)))
    return friction if len(node) else None


def _path(document: Document) -> dict[str, np.ndarray]:
    group = "/breast/contact/path_"
    thickness = document.numbers(group + "thickness_mm", (None,))
    return {"thickness_mm": thickness, "force_N": document.numbers(group + "force_N", thickness.shape),
            "detector_N": document.numbers(group + "detector_N", thickness.shape)}
