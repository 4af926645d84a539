# SPDX-License-Identifier: GPL-3.0-or-later
"""Points of 3D Slicer (.mrk.json, and .fcsv of versions before 4.11)."""
from __future__ import annotations

import csv
import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .errors import BreastError
from .reports import read_report


@dataclass(frozen=True)
class Markup:
    """A list of points, a line or a curve.

    Attributes:
        kind: Fiducial, Line, Curve, ...
        labels: (n) names of the points.
        points: (n, 3) LPS mm, whatever the file's own coordinate system.
    """

    kind: str
    labels: list[str]
    points: np.ndarray

    def point(self, label: str) -> np.ndarray:
        """The point (3), LPS mm, of a label. Raises BreastError naming those there are."""
        if label not in self.labels:
            raise BreastError(f"no point '{label}'; there are: {', '.join(self.labels)}")
        return self.points[self.labels.index(label)]


def read_markups(file: str | os.PathLike[str]) -> dict[str, Markup]:
    """Markups by name. Raises BreastError when the file is none, or a place is undefined or not finite."""
    path = Path(file)
    markups: dict[str, Markup] = {}
    try:
        for n, stated in enumerate(read_report(path)["markups"]):
            system, units = stated.get("coordinateSystem", "LPS"), stated.get("coordinateUnits", "mm")
            if system not in ("LPS", "RAS") or units != "mm":
                raise BreastError(f"markup {n} is in {system} and {units}; LPS or RAS and mm are read", path)
            given = [p for p in stated["controlPoints"] if p.get("positionStatus", "defined") == "defined"]
            points = np.array([p["position"] for p in given], float).reshape(len(given), 3)
            if not np.isfinite(points).all() or (len(points) and np.abs(points).max() > 1e6):
                raise BreastError(f"markup {n} has a point that is no place within 1000000 mm", path)
            name = str(stated.get("name", n))
            name = name if name not in markups else f"{name} {n}"
            markups[name] = Markup(str(stated["type"]), [str(p.get("label", "")) for p in given],
                                   points * ([-1, -1, 1] if system == "RAS" else [1, 1, 1]))
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        raise BreastError(f"is no list of markups of 3D Slicer ({error!r})", path) from None
    return markups


def read_fiducials(file: str | os.PathLike[str]) -> dict[str, Markup]:
    """The list of points of a .fcsv, by the file's name. Raises BreastError when its comments do not state the system of
    coordinates (LPS or RAS, in older files 1 or 0) and the columns, or a place is not three finite mm."""
    path = Path(file)
    stated: dict[str, str] = {}
    labels: list[str] = []
    points: list[list[float]] = []
    for number, line in enumerate(path.read_text("utf-8", "replace").splitlines(), 1):
        if line.startswith("#"):
            key, _, value = line[1:].partition("=")
            stated[key.strip()] = value.strip()
        elif line.strip():
            try:
                cells = dict(zip(stated.get("columns", "").split(","), next(csv.reader([line]))))
                points.append([float(cells[axis]) for axis in "xyz"])
                labels.append(cells["label"].strip())
            except (KeyError, ValueError):
                raise BreastError(f"line {number} is no point with x, y, z and label", path) from None
    signs = {"LPS": 1, "1": 1, "RAS": -1, "0": -1}
    system = stated.get("CoordinateSystem", "")
    if system not in signs:
        raise BreastError(f"CoordinateSystem '{system}': LPS (1) or RAS (0) are read", path)
    if not points or not np.isfinite(points).all() or np.abs(points).max() > 1e6:
        raise BreastError("has no points within 1000000 mm", path)
    return {path.stem: Markup("Fiducial", labels, np.array(points) * [signs[system], signs[system], 1])}
