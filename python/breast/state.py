# SPDX-License-Identifier: GPL-3.0-or-later
"""One state of the breast: a hexahedral mesh and everything its file says."""
from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .element_map import ElementMap
from .elements import element_volumes, order_of
from .errors import BreastError
from .history import Command
from .points import checked_points
from .records import Contact, Model, Solve
from .section import faces_in_plane
from .thorax import Thorax
from .transport import Transported, transported

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

TISSUES = ("air", "fat", "fibroglandular", "skin", "muscle", "tumour", "other")
"""Names of the tissue codes 0 to 6."""


@dataclass(frozen=True)
class Landmark:
    """A material point with a name.

    Attributes:
        name: nipple, tumour, artificial_tumour (made up by hexmesh), ...
        imaged: (3) the point of the scan that was asked for, LPS mm.
        element: the element that holds it, a row of the state's hexahedra.
        local: (3) its (ξ, η, ζ) there, in [-1, 1].
        moved: mm by which it was moved to reach the mesh.
    """

    name: str
    imaged: np.ndarray
    element: int
    local: np.ndarray
    moved: float


@dataclass(frozen=True)
class State:
    """A mesh file: `mesh`, `reference`, `supine`, `cc`, `mlo` of a run.

    All places are patient LPS (x to the patient's left, y to the back, z to the head) in mm. N nodes, E elements. Arrays are
    read-only: copy one to change it.

    Attributes:
        file: where it was read from.
        points: (N, 3) the shape this state is about.
        imaged: (N, 3) the shape in the scan.
        reference: (N, 3) the stress-free shape, or None before `backward`.
        hexahedra: (E, 8) or (E, 27) rows of `points`, in the order of VTK_HEXAHEDRON or VTK_TRIQUADRATIC_HEXAHEDRON.
        part: whether the file holds only a part of the mesh, as those of compress, which lack the tissue around the breast.
        element_numbers, node_numbers: (E), (N) numbers in the whole mesh, ascending.
        tissue: (E) codes, see TISSUES.
        point_arrays: arrays by name with N rows: contact_pressure (kPa), derivative_NAME (mm per unit of NAME), ...
        cell_arrays: arrays by name with E rows: pressure (Pa), det_F, scaled_jacobian, fibroglandular_fraction, ...
        faces: (F, 2) element and local face (0 -ξ, 1 +ξ, 2 -η, 3 +η, 4 -ζ, 5 +ζ) of 'skin', 'pectoral' (the chest wall) and
            'cut': together the whole boundary.
        node_sets: their nodes, ascending; and 'tumour' and 'nipple', the nearest node (0 or 1).
        landmarks: by name.
        side: 'left' or 'right'.
        gravity: (3) mm/s² acting on `points`; 0 for the stress-free shape.
        template: name and size (4) of the arrangement of the elements.
        skin_model: 'none', 'membrane' or 'layer'.
        skin_thickness: mm of each skin face in the imaged shape; empty unless 'membrane'.
        model: with which it was solved, or None.
        solve: how it was solved, or None.
        contact: the compression plates, or None.
        history: every command that led to the file.
        wall_seconds: how long the tool took.
        thorax: the surface on which the breast slides, or None.
    """

    file: Path
    points: np.ndarray
    imaged: np.ndarray
    reference: np.ndarray | None
    hexahedra: np.ndarray
    part: bool
    element_numbers: np.ndarray
    node_numbers: np.ndarray
    tissue: np.ndarray
    point_arrays: dict[str, np.ndarray]
    cell_arrays: dict[str, np.ndarray]
    faces: dict[str, np.ndarray]
    node_sets: dict[str, np.ndarray]
    landmarks: dict[str, Landmark]
    side: str
    gravity: np.ndarray
    template: tuple[str, tuple[int, ...]]
    skin_model: str
    skin_thickness: np.ndarray
    model: Model | None
    solve: Solve | None
    contact: Contact | None
    history: tuple[Command, ...]
    wall_seconds: float
    thorax: Thorax | None = None
    _maps: dict[str, ElementMap] = field(default_factory=dict, repr=False, compare=False)

    def __repr__(self) -> str:
        return (f"<State {self.file.name}: {self.side} breast, {len(self.points)} nodes, {len(self.hexahedra)} "
                f"elements, landmarks {', '.join(self.landmarks) or 'none'}>")

    # ---- shapes -----------------------------------------------------------------------------------------------------

    def shape(self, name: str = "points") -> np.ndarray:
        """Node positions (N, 3), LPS mm, of 'points', 'imaged' or 'reference'."""
        if name not in ("points", "imaged", "reference"):
            raise BreastError(f"has no shape '{name}'", self.file, "'points', 'imaged' or 'reference'")
        nodal = getattr(self, name)
        if nodal is None:
            raise BreastError("has no stress-free shape", self.file, "make it with backward")
        return nodal

    @property
    def displacement_from_scan(self) -> np.ndarray:
        """points - imaged, (N, 3) mm."""
        return self.points - self.imaged

    @property
    def displacement_from_stress_free(self) -> np.ndarray:
        """points - reference, (N, 3) mm. Raises BreastError without a reference."""
        return self.points - self.shape("reference")

    def element_map(self, shape: str = "points") -> ElementMap:
        """The element map of a shape, made once."""
        if shape not in self._maps:
            self._maps[shape] = ElementMap(self.hexahedra, self.shape(shape))
        return self._maps[shape]

    def volumes(self, shape: str = "points") -> np.ndarray:
        """Volume of each element, (E) mm³."""
        return element_volumes(order_of(self.hexahedra.shape[1]), self.shape(shape)[self.hexahedra])

    def centres(self, shape: str = "points") -> np.ndarray:
        """Place of each element's centre, ξ = η = ζ = 0, (E, 3) LPS mm."""
        elements = np.arange(len(self.hexahedra))
        return self.element_map(shape).positions(elements, np.zeros((len(elements), 3)))

    # ---- material points --------------------------------------------------------------------------------------------

    def landmark(self, name: str) -> Landmark:
        """A landmark; 'tumour' also finds an artificial one. Raises BreastError naming those there are."""
        if name == "tumour" and name not in self.landmarks:
            name = "artificial_tumour" if "artificial_tumour" in self.landmarks else name
        if name not in self.landmarks:
            raise BreastError(f"has no landmark '{name}'", self.file, f"it has: {', '.join(self.landmarks) or 'none'}")
        return self.landmarks[name]

    def landmark_position(self, name: str, shape: str = "points") -> np.ndarray:
        """Where a landmark is in a shape, (3) LPS mm."""
        landmark = self.landmark(name)
        return self.element_map(shape).positions(np.array([landmark.element]), landmark.local[None])[0]

    def transport(self, points: ArrayLike, source: str, target: str, within: float = 0.0) -> Transported:
        """Material points carried from one shape of this file to another; see Run.transport."""
        return transported(self.element_map(source), self.element_map(target), self._boundary(), points, within)

    def distance_to(self, faces: str, points: ArrayLike, shape: str = "imaged") -> np.ndarray:
        """Distance in mm of points (n, 3), LPS mm, from 'skin', 'pectoral' (the chest wall) or 'cut' in a shape, (n)."""
        if faces not in self.faces:
            raise BreastError(f"has no faces '{faces}'", self.file, f"it has: {', '.join(self.faces)}")
        if len(self.faces[faces]) == 0:
            raise BreastError(f"has an empty set of faces '{faces}'", self.file)
        return self.element_map(shape).nearest(self.faces[faces], checked_points(points))[0]

    def section(self, shape: str, origin: ArrayLike, normal: ArrayLike) -> dict[str, np.ndarray]:
        """The outline of a shape in a plane: for each face set, line segments (S, 2, 3), LPS mm.

        Args:
            shape: 'points', 'imaged' or 'reference'.
            origin: (3) a point of the plane, LPS mm.
            normal: (3) its normal, of any length.
        """
        nodal = self.shape(shape)
        return {name: faces_in_plane(nodal[self.hexahedra], faces, np.asarray(origin, float), np.asarray(normal, float))
                for name, faces in self.faces.items()}

    def _boundary(self) -> np.ndarray:
        return np.concatenate(list(self.faces.values()))

    def vtk(self) -> Any:
        """A vtkUnstructuredGrid of `points` with all arrays; needs the Debian package python3-vtk9."""
        from .vtk_grid import vtk_grid
        return vtk_grid(self)
