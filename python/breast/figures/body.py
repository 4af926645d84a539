# SPDX-License-Identifier: GPL-3.0-or-later
"""The surfaces of a breast that figures draw, and from where they are seen."""
from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from ..elements import FACE_CORNERS, LATTICE, boundary_faces, evaluate, face_corners, order_of
from ..errors import BreastError
from ..records import Plate
from ..state import TISSUES, State
from ..views import ImageFrame, image_frame, lateral_sign
from .colours import CUT, GLAND, IMAGE_BORDER, MUSCLE, PLATE, PLATE_RIM, SKIN, TUMOUR
from .scene import Camera, Facets, Look, Scene, vtk_points

UP = np.array([0, 0, 1.0])
_WALL_SHOWN = 15  # mm of the upright wall behind a plate's rounded edge
_CELLS = 3  # along an element's edge, in which the surface of the gland is found
_QUARTERS = np.array([[0, 4, 8, 7], [4, 1, 5, 8], [8, 5, 2, 6], [7, 8, 6, 3]])


def _nine_nodes() -> np.ndarray:
    """Of each local face of the 27-node element: corners as in FACE_CORNERS, the nodes of the edges between them, the centre."""
    faces = []
    for corners in FACE_CORNERS:
        at = LATTICE[corners].astype(float)
        wanted = [*at, *((at + np.roll(at, -1, 0)) / 2), at.mean(0)]
        faces.append([int(np.argmin(np.abs(LATTICE - place).sum(1))) for place in wanted])
    return np.array(faces)


_FACE_NODES = _nine_nodes()


# ---- from where a breast is seen: the same in all figures -------------------------------------------------------------------

def lateral_view(side: str) -> Camera:
    """From the body's outer side."""
    return Camera(np.array([-lateral_sign(side), 0, 0.0]), UP)


def anterior_view() -> Camera:
    return Camera(np.array([0, 1.0, 0]), UP)


def oblique_view(side: str) -> Camera:
    """From front, outer side and above."""
    return Camera(np.array([-0.75 * lateral_sign(side), 0.75, -0.35]), UP)


def from_below() -> Camera:
    """As transverse slices are shown: anterior at the top, the patient's right on the left."""
    return Camera(np.array([0, 0, 1.0]), np.array([0, -1.0, 0]))


def plate_view(state: State) -> Camera:
    """Along the edges of the plates, paddle on top, a little from the front and above, from the patient's outer side."""
    pose = image_frame(state).pose
    along = -pose.e_v if pose.e_v[0] * lateral_sign(state.side) > 0 else pose.e_v
    return Camera(along - 0.35 * pose.e_u + 0.22 * pose.n, -pose.n)


# ---- surfaces ---------------------------------------------------------------------------------------------------------------

def face_facets(state: State, nodal: np.ndarray, faces: np.ndarray) -> Facets:
    """Faces (F, 2) in a nodal field (N, 3); one of 9 nodes becomes four quadrilaterals."""
    if state.hexahedra.shape[1] == 8:
        return Facets(nodal, face_corners(state.hexahedra, faces))
    nine = state.hexahedra[faces[:, :1], _FACE_NODES[faces[:, 1]]]
    return Facets(nodal, nine[:, _QUARTERS].reshape(-1, 4))


def inner_faces(state: State, tissue: str) -> np.ndarray:
    """The faces (F, 2) between the elements of a tissue and the rest of the body."""
    own = np.flatnonzero(state.tissue == TISSUES.index(tissue))
    if not len(own):
        return np.zeros((0, 2), int)
    faces = boundary_faces(state.hexahedra[own])
    faces[:, 0] = own[faces[:, 0]]
    outer = {tuple(face) for face in np.concatenate(list(state.faces.values())).tolist()}
    return np.array([face for face in faces.tolist() if tuple(face) not in outer], int).reshape(-1, 2)


def gland_facets(state: State, nodal: np.ndarray) -> Facets:
    """The boundary of the fibroglandular region as one smooth surface, moved to a nodal field (N, 3).

    It is the surface on which the continuous fraction (means of the elements' fractions at the nodes) has the value that encloses,
    in the scan, as much volume as the fractions sum to; so it encloses the same tissue in every shape. Empty without any.
    """
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkUnstructuredGrid
    from vtkmodules.vtkFiltersCore import vtkContourGrid

    fraction = state.cell_arrays["fibroglandular_fraction"].astype(float)
    count = np.bincount(state.hexahedra.ravel(), minlength=len(nodal))
    field = np.bincount(state.hexahedra.ravel(), np.repeat(fraction, state.hexahedra.shape[1]), len(nodal)) / np.maximum(count, 1)
    level = _enclosing_level(state, field, fraction)
    own = np.flatnonzero(np.ptp(np.sign(field[state.hexahedra] - level), axis=1) > 0)
    if not len(own):
        return Facets(nodal, np.zeros((0, 4), int))
    # A lattice of cells in each element that the surface crosses; places that elements share are one point.
    side = _CELLS + 1
    lattice = np.stack(np.meshgrid(*[np.linspace(-1, 1, side)] * 3, indexing="ij"), -1).reshape(-1, 3)
    values = _at(state, np.column_stack([nodal, state.imaged, field]), own, lattice).reshape(-1, 7)
    _, first, place = np.unique(np.rint(values[:, 3:6] * 1000).astype(np.int64), axis=0, return_index=True, return_inverse=True)
    corner = np.stack(np.meshgrid(*[range(_CELLS)] * 3, indexing="ij"), -1).reshape(-1, 1, 3) + \
        (LATTICE[:8].astype(int) + 1) // 2
    cells = corner @ [side * side, side, 1]
    cells = place.ravel()[(np.arange(len(own))[:, None, None] * side**3 + cells).reshape(-1, 8)]
    grid, connectivity = vtkUnstructuredGrid(), vtkCellArray()
    grid.SetPoints(vtk_points(values[first, :3]))
    connectivity.SetData(8, numpy_to_vtkIdTypeArray(cells.ravel().astype(np.int64), deep=True))
    grid.SetCells(12, connectivity)
    grid.GetPointData().SetScalars(numpy_to_vtk(values[first, 6].copy(), deep=True))
    contour = vtkContourGrid()
    contour.SetInputData(grid)
    contour.SetValue(0, level)
    contour.ComputeNormalsOff()
    contour.Update()
    found = contour.GetOutput()
    triangles = vtk_to_numpy(found.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    points = vtk_to_numpy(found.GetPoints().GetData()).astype(float)
    return Facets(points, triangles[:, [0, 1, 2, 2]], _smooth_normals(points, triangles))


def _at(state: State, nodal: np.ndarray, elements: np.ndarray, local: np.ndarray) -> np.ndarray:
    """Nodal values (N, c) at local places (l, 3) of elements (e): (e, l, c)."""
    from ..elements import shape_functions
    values, _ = shape_functions(order_of(state.hexahedra.shape[1]), local)
    return np.einsum("ln,enc->elc", values, nodal[state.hexahedra[elements]])


def _enclosing_level(state: State, field: np.ndarray, fraction: np.ndarray) -> float:
    """The value of the field above which lies the volume to which the fractions of the elements sum."""
    middle = (np.arange(_CELLS) + 0.5) * 2 / _CELLS - 1
    local = np.stack(np.meshgrid(middle, middle, middle, indexing="ij"), -1).reshape(-1, 3)
    everything, order = np.arange(len(fraction)), order_of(state.hexahedra.shape[1])
    value = _at(state, field[:, None], everything, local)[..., 0]
    nodes = state.imaged[state.hexahedra]
    volume = np.stack([np.abs(np.linalg.det(evaluate(order, nodes, np.tile(at, (len(nodes), 1)))[1])) for at in local], -1)
    volume *= (2 / _CELLS) ** 3
    falling = np.argsort(-value, axis=None, kind="stable")
    enclosed = np.cumsum(volume.ravel()[falling])
    wanted = float((volume.sum(1) * fraction).sum())
    at = np.searchsorted(enclosed, wanted)
    return max(float(value.ravel()[falling[min(at, len(falling) - 1)]]), 1e-3) if wanted > 0 else np.inf


def _smooth_normals(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Weighted by area and averaged over neighbours, so that thin triangles are not seen."""
    corners = points[triangles]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals = np.zeros_like(points)
    for corner in range(3):
        np.add.at(normals, triangles[:, corner], across)
    for _ in range(3):
        normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
        total, mean = normals[triangles].sum(1), normals.copy()
        for corner in range(3):
            np.add.at(mean, triangles[:, corner], total)
        normals = mean
    return normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)


# ---- a breast in a scene ----------------------------------------------------------------------------------------------------

def add_body(scene: Scene, state: State, nodal: np.ndarray, skin_opacity: float = 1, edges: bool = False,
             gland_opacity: float = 0) -> None:
    """Skin, chest wall and cut; with a gland_opacity the fibroglandular region and the tumour, which is seen through all."""
    for name, colour, opacity in (("skin", SKIN, skin_opacity), ("pectoral", MUSCLE, 1.0),
                                  ("cut", CUT, 0.6 * skin_opacity if skin_opacity < 1 else 1.0)):
        scene.surface(face_facets(state, nodal, state.faces[name]), Look(colour, opacity, smooth=not edges, edges=edges))
    if gland_opacity:
        scene.surface(gland_facets(state, nodal), Look(GLAND, gland_opacity, shine=0.25))
        scene.surface(face_facets(state, nodal, inner_faces(state, "tumour")), Look(TUMOUR), through=True)
        if has_tumour(state):
            scene.balls(place_of(state, "tumour", nodal)[None], 4, TUMOUR, through=True)


def has_tumour(state: State) -> bool:
    return not {"tumour", "artificial_tumour"}.isdisjoint(state.landmarks)


def tumour_words(state: State) -> str:
    """What the tumour is called; empty for a mesh without one."""
    if "tumour" in state.landmarks:
        return "tumour (yellow)"
    return "artificial tumour (yellow)" if has_tumour(state) else ""


def place_of(state: State, landmark: str, nodal: np.ndarray) -> np.ndarray:
    """Where a landmark is in a nodal field, (3)."""
    found = state.landmark(landmark)
    order = order_of(state.hexahedra.shape[1])
    return evaluate(order, nodal[state.hexahedra[found.element]][None], found.local[None])[0][0]


def add_plates(scene: Scene, state: State, nodal: np.ndarray, plates: Iterable[Plate], opacity: float) -> None:
    """Plates long enough for the body, clear of the facets of the skin that they press."""
    clear = 1.5
    for plate in plates:
        normal, anterior, lateral = plate.normal, plate.anterior, np.cross(plate.normal, plate.anterior)
        offset = nodal - plate.origin
        ahead = offset @ anterior
        length = max(0.0, ahead.max()) + 18
        half_width = np.abs(offset @ lateral)[ahead > 0].max(initial=0) + 15
        radius, origin = max(0.0, plate.edge_radius - clear), plate.origin - clear * normal
        angle = np.linspace(0.5 * np.pi, 0, 25)[:, None]
        profile = np.concatenate([  # down the wall, round the edge, to the front
            [origin - radius * anterior - (radius + _WALL_SHOWN) * normal],
            origin - radius * np.sin(angle) * anterior - radius * (1 - np.cos(angle)) * normal, [origin + length * anterior]])
        ends = profile - half_width * lateral, profile + half_width * lateral
        n = np.arange(len(profile) - 1)
        quads = np.stack([n, n + len(profile), n + len(profile) + 1, n + 1], -1)
        scene.surface(Facets(np.concatenate(ends), quads), Look(PLATE, opacity, shine=0.5))
        scene.tube(np.concatenate([ends[0], ends[1][::-1], ends[0][:1]]), 0.5, PLATE_RIM)


def add_image_border(scene: Scene, state: State) -> None:
    """The border of the mammogram on the detector, seen through the body; thick where the image ends at the chest."""
    frame: ImageFrame = image_frame(state)
    detector = two_plates(state)[1].origin  # the frame's own origin may lie below it, at the height of tissue behind the plate
    origin = frame.pose.origin + (detector - frame.pose.origin) @ frame.pose.n * frame.pose.n
    corners = [origin + u * frame.pose.e_u + v * frame.pose.e_v
               for u, v in ((0, 0), (frame.width, 0), (frame.width, frame.height), (0, frame.height))]
    for k in range(4):
        scene.tube(np.array([corners[k], corners[(k + 1) % 4]]), 0.9 if k == 3 else 0.4, IMAGE_BORDER, through=True)


def two_plates(state: State) -> tuple[Plate, Plate]:
    """Paddle and detector of a compressed state."""
    plates = tuple(state.contact.plates.values()) if state.contact else ()
    if len(plates) != 2:
        raise BreastError(f"has {len(plates)} plates, must have 2", state.file, "make it with compress")
    return plates


def compression_words(state: State) -> str:
    """ "MLO (left), 46.2 mm, paddle 91 N, detector 93 N"."""
    words = f"{state.contact.view} ({state.side}), {state.contact.thickness_mm:.1f} mm"
    paddle, detector = two_plates(state)
    if paddle.force_N > 0 or detector.force_N > 0:
        words += f", paddle {paddle.force_N:.0f} N, detector {detector.force_N:.0f} N"
    return words
