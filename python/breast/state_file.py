# SPDX-License-Identifier: GPL-3.0-or-later
"""Reading a mesh file (schema mesh/1) with the checks of the programs."""
from __future__ import annotations

import os

import numpy as np

from .document import Document
from .elements import FACE_CORNERS, LATTICE, boundary_faces, order_of, shape_functions
from .hdf5 import read_document
from .history import read_history, read_side
from .records import read_contact, read_model, read_solve
from .state import TISSUES, Landmark, State
from .thorax import read_thorax

_POINT, _CELL = "/VTKHDF/PointData/", "/VTKHDF/CellData/"
_ELEMENT_NUMBER, _NODE_NUMBER = _CELL + "element_number", _POINT + "node_number"
_NODES_OF_TYPE = {12: 8, 29: 27}
_FACE_SETS = ("skin", "pectoral", "cut")
_FACE_NODES = [np.flatnonzero(LATTICE[:, f // 2] == 2 * (f % 2) - 1) for f in range(6)]
"""The 9 nodes of each local face of the 27-node element."""


def read_state(file: str | os.PathLike[str]) -> State:
    """A state from its file. Raises BreastError, one line, for whatever the programs refuse."""
    doc = read_document(file, "mesh/1")
    side, history = read_side(doc), read_history(doc)
    points = doc.places("/VTKHDF/Points")
    hexahedra = _hexahedra(doc, len(points))
    n, e = len(points), len(hexahedra)
    imaged, reference = doc.places(_POINT + "imaged", n), _reference(doc, points)
    _check_displacement(doc, "displacement_from_scan", points, imaged)
    faces, node_sets = _sets(doc, hexahedra, n)
    skin_model = doc.text("/breast/skin@model", ("none", "membrane", "layer"))
    thickness = doc.numbers("/breast/skin/thickness", (None,))
    if len(thickness) not in ((len(faces["skin"]),) if skin_model == "membrane" else (0, len(faces["skin"]))):
        raise doc.refuse(f"dataset /breast/skin/thickness has {len(thickness)} entries, must be {len(faces['skin'])}")
    if len(thickness) and thickness.min() < 0:
        raise doc.refuse(f"dataset /breast/skin/thickness[{thickness.argmin()}] is {thickness.min()}, must be 0 or more")
    contact = read_contact(doc, n)
    if contact is not None:
        doc.numbers(_POINT + "contact_pressure", (n,))
    return State(
        doc.file, points, imaged, reference, hexahedra, doc.has(_ELEMENT_NUMBER), _numbers(doc, _ELEMENT_NUMBER, e),
        _numbers(doc, _NODE_NUMBER, n), doc.codes(_CELL + "tissue", (e,), len(TISSUES)),
        _arrays(doc, _POINT, n, ("imaged", "reference", "displacement_from_scan", "displacement_from_stress_free")),
        _cell_arrays(doc, e), faces, node_sets, _landmarks(doc, e), side, doc.number_list("/breast@gravity", 3),
        (doc.text("/breast/template@name"), doc.integer_list("/breast/template@size", 4)), skin_model, thickness,
        read_model(doc), read_solve(doc), contact, history,
        float(doc.numbers("/VTKHDF/FieldData/wall_seconds", (1,))[0]), read_thorax(doc))


def read_landmark_places(file: str | os.PathLike[str]) -> dict[str, tuple[tuple[float, ...], tuple[float, ...]]]:
    """Where every landmark of a mesh file is in the scan and in the shape, LPS mm; reads nothing else of the file."""
    doc = read_document(file, "mesh/1", ("/breast/landmarks/", "/VTKHDF/Points", "/VTKHDF/Connectivity", "/VTKHDF/Offsets",
                                         "/VTKHDF/Types", "/VTKHDF/NumberOf", _POINT + "imaged"))
    points = doc.places("/VTKHDF/Points")
    hexahedra, imaged = _hexahedra(doc, len(points)), doc.places(_POINT + "imaged", len(points))
    order = order_of(hexahedra.shape[1])
    places = {}
    for landmark in _landmarks(doc, len(hexahedra)).values():
        weights, nodes = shape_functions(order, landmark.local[None])[0][0], hexahedra[landmark.element]
        places[landmark.name] = (tuple(weights @ imaged[nodes]), tuple(weights @ points[nodes]))
    return places


def _numbers(doc: Document, path: str, count: int) -> np.ndarray:
    """Numbers in the whole mesh, ascending; a file without them is a whole mesh."""
    if not (doc.has(_ELEMENT_NUMBER) or doc.has(_NODE_NUMBER)):
        return np.arange(count)
    numbers = doc.integers(path, (count,), 0)
    wrong = np.flatnonzero(np.diff(numbers) <= 0)
    if len(wrong):
        at = int(wrong[0]) + 1
        raise doc.refuse(f"dataset {path}[{at}] is {numbers[at]}, must be at least {numbers[at - 1] + 1}")
    return numbers


def _hexahedra(doc: Document, nodes: int) -> np.ndarray:
    doc.text("/VTKHDF@Type", ("UnstructuredGrid",))
    types = doc.codes("/VTKHDF/Types", (None,), 256)
    if len(types) == 0 or int(types[0]) not in _NODES_OF_TYPE or (types != types[0]).any():
        odd = int(np.argmax(types != types[0])) if len(types) and (types != types[0]).any() else 0
        raise doc.refuse(f"dataset /VTKHDF/Types[{odd}] must be 12 or 29, the same for all elements")
    per_element = _NODES_OF_TYPE[int(types[0])]
    counts = {"Points": nodes, "Cells": len(types), "ConnectivityIds": len(types) * per_element}
    for what, count in counts.items():
        stated = int(doc.integers(f"/VTKHDF/NumberOf{what}", (1,))[0])
        if stated != count:
            raise doc.refuse(f"dataset /VTKHDF/NumberOf{what} is {stated}, must be {count}")
    offsets = doc.integers("/VTKHDF/Offsets", (len(types) + 1,))
    if (offsets != np.arange(len(types) + 1) * per_element).any():
        raise doc.refuse(f"dataset /VTKHDF/Offsets must rise by {per_element} from 0")
    hexahedra = doc.integers("/VTKHDF/Connectivity", (len(types) * per_element,), 0, nodes).reshape(-1, per_element)
    twice = (np.diff(np.sort(hexahedra, axis=1), axis=1) == 0).any(1)
    if twice.any():
        raise doc.refuse(f"dataset /VTKHDF/Connectivity element {int(np.argmax(twice))} uses a node twice")
    used = np.zeros(nodes, bool)
    used[hexahedra] = True
    if not used.all():
        raise doc.refuse(f"dataset /VTKHDF/Points[{int(np.argmin(used))}] belongs to no element")
    return hexahedra


def _reference(doc: Document, points: np.ndarray) -> np.ndarray | None:
    parts = (_POINT + "reference", _POINT + "displacement_from_stress_free")
    if not any(map(doc.has, parts)) and not doc.has_group("/breast/solve"):
        return None
    reference = doc.places(_POINT + "reference", len(points))
    _check_displacement(doc, "displacement_from_stress_free", points, reference)
    return reference


def _check_displacement(doc: Document, name: str, points: np.ndarray, start: np.ndarray) -> None:
    """Displacements are there for viewing; one that contradicts its two shapes means an edited file."""
    if not doc.has(_POINT + name):
        return
    off = np.linalg.norm(doc.numbers(_POINT + name, (len(points), 3)) - (points - start), axis=1)
    if off.max() > 1e-6:
        raise doc.refuse(f"dataset {_POINT}{name}[{off.argmax()}] is {off.max():g} mm off the difference of its two shapes")


def _arrays(doc: Document, group: str, rows: int, without: tuple[str, ...]) -> dict[str, np.ndarray]:
    arrays = {}
    for path in doc.datasets:
        name = path.removeprefix(group)
        if not path.startswith(group) or "/" in name or name in without or doc.datasets[path].dtype.kind == "O":
            continue
        if len(doc.datasets[path].shape) == 0 or doc.datasets[path].shape[0] != rows:
            raise doc.refuse(f"dataset {path} has shape {doc.datasets[path].shape}, must have {rows} rows")
        array = doc.datasets[path]
        array.setflags(write=False)
        arrays[name] = array
    return arrays


def _cell_arrays(doc: Document, elements: int) -> dict[str, np.ndarray]:
    doc.fractions(_CELL + "fibroglandular_fraction", (elements,))
    for name in ("pressure", "det_F", "scaled_jacobian"):
        if doc.has(_CELL + name):
            doc.numbers(_CELL + name, (elements,))
    return _arrays(doc, _CELL, elements, ("tissue",))


def _sets(doc: Document, hexahedra: np.ndarray, nodes: int) -> tuple[dict[str, np.ndarray], dict[str, np.ndarray]]:
    faces, node_sets = {}, {}
    for name in _FACE_SETS:
        path = f"/breast/sets/{name}_faces"
        faces[name] = doc.integers(path, (None, 2), 0, max(len(hexahedra), 6))
        bad = (faces[name] >= [len(hexahedra), 6]).any(1)
        if bad.any():
            raise doc.refuse(f"dataset {path}[{int(np.argmax(bad))}] is no face of an element")
        node_sets[name] = doc.integers(f"/breast/sets/{name}_nodes", (None,), 0, nodes)
        if not np.array_equal(node_sets[name], _nodes_of(hexahedra, faces[name])):
            raise doc.refuse(f"dataset /breast/sets/{name}_nodes are not the sorted nodes of {path}")
    stated = np.concatenate(list(faces.values()))
    stated = stated[np.lexsort(stated.T[::-1])]
    if not np.array_equal(stated, boundary_faces(hexahedra)):
        raise doc.refuse("skin_faces, pectoral_faces and cut_faces must be disjoint and cover the boundary, and do not")
    for name in ("tumour", "nipple"):
        node_sets[name] = doc.integers(f"/breast/sets/{name}", (None,), 0, nodes)
        if len(node_sets[name]) > 1:
            raise doc.refuse(f"dataset /breast/sets/{name} has {len(node_sets[name])} nodes, must be 0 or 1")
    return faces, node_sets


def _nodes_of(hexahedra: np.ndarray, faces: np.ndarray) -> np.ndarray:
    if hexahedra.shape[1] == 8:
        return np.unique(hexahedra[faces[:, :1], FACE_CORNERS[faces[:, 1]]])
    return np.unique(hexahedra[faces[:, :1], np.array(_FACE_NODES)[faces[:, 1]]])


def _landmarks(doc: Document, elements: int) -> dict[str, Landmark]:
    group = "/breast/landmarks/"
    names = doc.names(group + "name")
    count = len(names)
    imaged, local = doc.places(group + "imaged", count), doc.numbers(group + "local", (count, 3))
    element = doc.integers(group + "element", (count,), 0, elements)
    moved = doc.numbers(group + "moved", (count,))
    if count and np.abs(local).max() > 1 + 1e-6:
        raise doc.refuse(f"dataset {group}local[{np.abs(local).max(1).argmax()}] must be -1 to 1")
    if count and moved.min() < 0:
        raise doc.refuse(f"dataset {group}moved[{moved.argmin()}] is {moved.min()}, must be 0 or more")
    return {name: Landmark(name, imaged[i], int(element[i]), local[i], float(moved[i])) for i, name in enumerate(names)}
