# SPDX-License-Identifier: GPL-3.0-or-later
"""Distance between two matched curves in the plane of the mammogram, as libbreast/evaluation/curve_distance measures it."""
from __future__ import annotations

from pathlib import Path

import numpy as np

from ..curves import Line, read_curves
from ..errors import BreastError


def curve_distance(given: Path, base: Path) -> tuple[float, float]:
    """Mean and largest distance in mm between the lines "curve" of both files, in both directions, for every query of `given`.

    Displacements along the beam are ignored: the beam is the normal of the plane of the base's lines on the detector. Raises
    BreastError naming a file without a curve for a query, or one whose lines span no plane.
    """
    lines = read_curves(base)
    ours, theirs, normal = _curves(read_curves(given), given), _curves(lines, base), _detector_normal(lines, base)
    found = []
    for query, curve in ours.items():
        if query not in theirs:
            raise BreastError(f"has no curve for query {query} of {given}", base)
        a, b = (points - np.outer(points @ normal, normal) for points in (curve, theirs[query]))
        found += [_distances(a, b), _distances(b, a)]
    distances = np.concatenate(found)
    return float(distances.mean()), float(distances.max())


def _curves(lines: dict[str, list[Line]], file: Path) -> dict[int, np.ndarray]:
    curves = {}
    for line in lines.get("curve", []):
        if len(line.points) > 1:
            curves[int(line.arrays["query"][0]) if "query" in line.arrays else 0] = line.points
    if not curves:
        raise BreastError("has no line 'curve'", file, "such files are written by cc2mlo")
    return curves


def _detector_normal(lines: dict[str, list[Line]], file: Path) -> np.ndarray:
    def on_detector(name: str) -> bool:
        return name in ("curve", "arc", "chord") or (name.endswith(" in MLO") and not name.startswith("column"))

    points = np.concatenate([line.points for name, group in lines.items() if on_detector(name) for line in group])
    spread = points - points.mean(0)
    sizes, axes = np.linalg.eigh(spread.T @ spread)
    if not sizes[1] > 1e-6 * sizes[2]:
        raise BreastError("its lines on the detector are straight and span no plane", file)
    return axes[:, 0]


def _distances(points: np.ndarray, curve: np.ndarray) -> np.ndarray:
    """From each point (n, 3) to a polyline (m, 3)."""
    start, edge = curve[:-1], np.diff(curve, axis=0)
    squared = np.maximum((edge * edge).sum(1), np.finfo(float).tiny)
    at = np.clip(np.einsum("nmd,md->nm", points[:, None] - start, edge) / squared, 0, 1)
    return np.linalg.norm(start + at[..., None] * edge - points[:, None], axis=2).min(1)
