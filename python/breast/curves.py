# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines and markers of cc2mlo: the file curve.vtp."""
from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .vtk_xml import VtkXml


@dataclass(frozen=True)
class Line:
    """A line, or a marker of one point.

    Attributes:
        points: (n, 3) LPS mm, in the shape its name says.
        uv_mm: (n, 2) in the image of that view; NaN for what lies in no image.
        arrays: all arrays of the file along the line, by name (depth_mm, query, u_mm, v_mm, ...).
    """

    points: np.ndarray
    uv_mm: np.ndarray
    arrays: dict[str, np.ndarray]


def read_curves(file: str | os.PathLike[str]) -> dict[str, list[Line]]:
    """Lines and markers by name: 'curve', 'chord', 'column in CC', 'point in CC', ...; one each for every query.

    Raises BreastError for a damaged file or one of another schema.
    """
    return curves_of(VtkXml(Path(file), "PolyData"))


def holds_curves(xml: VtkXml) -> bool:
    return xml.fields().get("schema") == ["curves/1"]


def curves_of(xml: VtkXml) -> dict[str, list[Line]]:
    """The same of a file that has been read."""
    if not holds_curves(xml):
        raise xml.refuse(f"has schema {xml.fields().get('schema') or 'none'}, must be 'curves/1'")
    points, data = xml.points, {name: a for name, a in xml.group("PointData").items() if isinstance(a, np.ndarray)}
    cells = [line for kind in ("Verts", "Lines") for line in xml.cells(kind)]
    names = xml.group("CellData").get("name", [str(n) for n in range(len(cells))])
    lines: dict[str, list[Line]] = {}
    none = np.full(len(points), np.nan)
    uv = np.stack([data.get("u_mm", none), data.get("v_mm", none)], -1)
    for name, ids in zip(names, cells):
        own = {key: array[ids] for key, array in data.items()}
        image = uv[ids] if not name.endswith((" reference", " imaged")) else np.full((len(ids), 2), np.nan)
        lines.setdefault(str(name), []).append(Line(points[ids], image, own))
    return lines
