# SPDX-License-Identifier: GPL-3.0-or-later
"""Reading a mesh file (schema mesh/1)."""
from __future__ import annotations

import os

import numpy as np

from .document import Document
from .elements import order_of, shape_functions
from .hdf5 import read_document
from .history import read_history, read_side
from .records import read_contact, read_model, read_solve
from .state import Landmark, State
from .thorax import read_thorax

_POINT, _CELL = "/VTKHDF/PointData/", "/VTKHDF/CellData/"
_ELEMENT_NUMBER, _NODE_NUMBER = _CELL + "element_number", _POINT + "node_number"
_FACE_SETS = ("skin", "pectoral", "cut")
_SHAPES = ("imaged", "reference", "displacement_from_scan", "displacement_from_stress_free")
"""Arrays of points that are attributes of a State."""


def read_state(file: str | os.PathLike[str]) -> State:
    """A state from its file. Raises BreastError, one line, for whatever the programs refuse."""
    doc = read_document(file, "mesh/1")
    points, hexahedra = doc.numbers("/VTKHDF/Points"), _hexahedra(doc)
    sets = "/breast/sets/"
    return State(
        doc.file, points, doc.numbers(_POINT + "imaged"), doc.numbers(_POINT + "reference") if doc.has(_POINT + "reference") else None,
        hexahedra, doc.has(_ELEMENT_NUMBER), _numbers(doc, _ELEMENT_NUMBER, len(hexahedra)), _numbers(doc, _NODE_NUMBER, len(points)),
        doc.stored(_CELL + "tissue"), _arrays(doc, _POINT, _SHAPES), _arrays(doc, _CELL, ("tissue",)),
        {name: doc.integers(f"{sets}{name}_faces") for name in _FACE_SETS},
        {name: doc.integers(f"{sets}{name}_nodes") for name in _FACE_SETS} |
        {name: doc.integers(sets + name) for name in ("tumour", "nipple")},
        _landmarks(doc), read_side(doc), doc.numbers("/breast@gravity"),
        (doc.text("/breast/template@name"), tuple(map(int, doc.integers("/breast/template@size")))), doc.text("/breast/skin@model"),
        doc.numbers("/breast/skin/thickness"), read_model(doc), read_solve(doc), read_contact(doc), read_history(doc),
        doc.number("/VTKHDF/FieldData/wall_seconds"), read_thorax(doc))


def read_landmark_places(file: str | os.PathLike[str]) -> dict[str, tuple[tuple[float, ...], tuple[float, ...]]]:
    """Where every landmark of a mesh file is in the scan and in the shape, LPS mm; reads nothing else of the file."""
    doc = read_document(file, "mesh/1", ("/breast/landmarks/", "/VTKHDF/Points", "/VTKHDF/Connectivity", "/VTKHDF/Offsets",
                                         _POINT + "imaged"))
    points, hexahedra, imaged = doc.numbers("/VTKHDF/Points"), _hexahedra(doc), doc.numbers(_POINT + "imaged")
    order = order_of(hexahedra.shape[1])
    places = {}
    for landmark in _landmarks(doc).values():
        weights, nodes = shape_functions(order, landmark.local[None])[0][0], hexahedra[landmark.element]
        places[landmark.name] = (tuple(weights @ imaged[nodes]), tuple(weights @ points[nodes]))
    return places


def _hexahedra(doc: Document) -> np.ndarray:
    return doc.integers("/VTKHDF/Connectivity").reshape(len(doc.integers("/VTKHDF/Offsets")) - 1, -1)


def _numbers(doc: Document, path: str, count: int) -> np.ndarray:
    """Numbers in the whole mesh; a file without them is a whole mesh."""
    return doc.integers(path) if doc.has(_ELEMENT_NUMBER) else np.arange(count)


def _arrays(doc: Document, group: str, without: tuple[str, ...]) -> dict[str, np.ndarray]:
    names = [path.removeprefix(group) for path in doc.datasets if path.startswith(group)]
    return {name: doc.stored(group + name) for name in names if name not in without}


def _landmarks(doc: Document) -> dict[str, Landmark]:
    columns = [doc.texts("/breast/landmarks/name"), doc.numbers("/breast/landmarks/imaged"),
               map(int, doc.integers("/breast/landmarks/element")), doc.numbers("/breast/landmarks/local"),
               map(float, doc.numbers("/breast/landmarks/moved"))]
    return {name: Landmark(name, *rest) for name, *rest in zip(*columns)}
