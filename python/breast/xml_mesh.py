# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces and meshes in VTK XML (.vtp, .vtu), for whatever reads no VTKHDF."""
from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .vtk_xml import VtkXml, vtk_array

_KINDS = {"Verts": {1: 1}, "Lines": {2: 3}, "Polys": {3: 5, 4: 9}}
"""VTK's cell type by number of points; 2 (vertices), 4 (polyline) and 7 (polygon) for other numbers."""
_OTHERWISE = {"Verts": 2, "Lines": 4, "Polys": 7}


@dataclass(frozen=True)
class XmlMesh:
    """Points and cells as VTK has them.

    Attributes:
        file: where it was read from.
        points: (P, 3) LPS mm.
        cells: (n, k) point numbers by VTK's cell type: 5 triangles, 9 quads, 10 tetrahedra, 12 and 29 hexahedra; those of a
            type with different numbers of points (polylines) are a list of arrays.
        types: (C) VTK's cell type of every cell, in the order of cell_arrays.
        point_arrays, cell_arrays: arrays by name with P and C rows; texts are lists.
        fields: everything else the file says, by name (schema, SPACE, history, ...).
    """

    file: Path
    points: np.ndarray
    cells: dict[int, np.ndarray | list[np.ndarray]]
    types: np.ndarray
    point_arrays: dict[str, np.ndarray | list[str]]
    cell_arrays: dict[str, np.ndarray | list[str]]
    fields: dict[str, np.ndarray | list[str]]


def read_xml_mesh(file: str | os.PathLike[str]) -> XmlMesh:
    """A .vtp or .vtu of the toolkit. Raises BreastError for a damaged file, and for one whose SPACE is not LPS."""
    path = Path(file)
    return xml_mesh_of(VtkXml(path, "PolyData" if path.name.lower().endswith(".vtp") else "UnstructuredGrid"))


def xml_mesh_of(xml: VtkXml) -> XmlMesh:
    """The same of a file that has been read."""
    fields = xml.fields()
    if fields.get("SPACE", ["LPS"]) != ["LPS"]:
        raise xml.refuse(f"is in {fields['SPACE']}, must be in LPS")
    if xml.kind == "PolyData":
        parts = {kind: xml.cells(kind) for kind in _KINDS}
        cells = [cell for part in parts.values() for cell in part]
        types = np.array([_KINDS[kind].get(len(cell), _OTHERWISE[kind]) for kind, part in parts.items() for cell in part])
    else:
        cells, types = xml.cells("Cells"), vtk_array(xml.data.GetCellTypesArray())
    return XmlMesh(xml.file, xml.points, _by_type(cells, types), types.astype(np.int64), xml.group("PointData"), xml.group("CellData"), fields)


def _by_type(cells: list[np.ndarray], types: np.ndarray) -> dict[int, np.ndarray | list[np.ndarray]]:
    found: dict[int, np.ndarray | list[np.ndarray]] = {}
    for kind in np.unique(types):
        own = [cells[c] for c in np.flatnonzero(types == kind)]
        found[int(kind)] = np.stack(own) if len({len(cell) for cell in own}) == 1 else own
    return found
