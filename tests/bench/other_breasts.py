#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Other breasts on the same ribs: other_breasts.py MR TRUTH FACTOR OUT_MR OUT_TRUTH

MR and TRUTH are a scan (NRRD) and its label map in the codes of the FDA's breast phantoms, on one grid whose axes are left, posterior and
superior. The soft tissue in front of the chest wall becomes FACTOR times as thick along rays from the thorax's axis in each axial slice; over the
sternum it changes half as much. 0.6 makes small breasts, 1.25 large ones. Ribs, view and voxels stay; for a factor above one, air is
added in front. Needs Debian's python3-scipy.
"""
from __future__ import annotations

import gzip
import sys
from pathlib import Path

import numpy as np
from scipy import ndimage

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))
from breast.nrrd import read_nrrd  # noqa: E402

CHEST = (40, 60, 61)
"""Codes of muscle and of what lies behind it."""
AXIS_BEHIND = 20
"""Voxels between the end of the view and the axis about which the rays turn."""
AIR_IN_FRONT_MM = 60
ANGLES = np.linspace(-np.pi / 2, np.pi / 2, 181)


def wall_radius(chest: np.ndarray, radius: np.ndarray, angle: np.ndarray) -> np.ndarray:
    """Radius (voxels) of the chest wall by slice and angle; `chest` is of shape (z, y, x), the others (y, x)."""
    row = np.clip(np.round((angle - ANGLES[0]) / (ANGLES[1] - ANGLES[0])).astype(int), 0, len(ANGLES) - 1)
    wall = np.full((len(chest), len(ANGLES)), -1.0)
    for k, inside in enumerate(chest):
        np.maximum.at(wall[k], row[inside], radius[inside])
    nearest = ndimage.distance_transform_edt(wall < 0, return_distances=False, return_indices=True)
    return ndimage.gaussian_filter(ndimage.median_filter(wall[tuple(nearest)], (7, 9)), (3, 3))


def thickness_factor(factor: float) -> np.ndarray:
    """The factor by angle: one behind the flanks, half of the change over the sternum."""
    front = np.clip((np.radians(85) - np.abs(ANGLES)) / np.radians(30), 0, 1)
    return 1 + (factor - 1) * front**2 * (3 - 2 * front) * (1 - 0.5 * np.exp(-(ANGLES / np.radians(8))**2))


def grown(scan: np.ndarray, truth: np.ndarray, factor: float) -> tuple[np.ndarray, np.ndarray]:
    """Both volumes, of shape (z, y, x), with the other breasts."""
    _, ny, nx = truth.shape
    chest = np.isin(truth, CHEST)
    middle, axis = np.median(np.nonzero(chest)[2]), ny - 1 + AXIS_BEHIND
    x, y = np.meshgrid(np.arange(nx) - middle, axis - np.arange(ny))
    radius, angle = np.hypot(x, y), np.arctan2(x, y)
    wall, factors = wall_radius(chest, radius, angle), np.interp(angle, ANGLES, thickness_factor(factor))
    new_scan, new_truth = np.empty_like(scan), np.empty_like(truth)
    for k in range(len(truth)):
        base = np.interp(angle, ANGLES, wall[k])
        share = np.where(radius > base, base + (radius - base) / factors, radius) / radius
        source = [axis - y * share, middle + x * share]
        new_scan[k] = np.round(ndimage.map_coordinates(scan[k].astype(np.float32), source, order=1, mode="nearest"))
        new_truth[k] = ndimage.map_coordinates(truth[k], source, order=0, mode="nearest")
    return new_scan, new_truth


def with_air(volume: np.ndarray, rows: int, air: np.ndarray) -> np.ndarray:
    """The volume with `rows` of voxels in front, drawn from `air`."""
    shape = (volume.shape[0], rows, volume.shape[2])
    drawn = np.random.default_rng(1).choice(air, shape)
    return np.concatenate([drawn.astype(volume.dtype), volume], 1)


def write_nrrd(file: Path, voxels: np.ndarray, spacing: np.ndarray, origin: np.ndarray) -> None:
    """Writes voxels of shape (z, y, x) whose axes are left, posterior and superior, mm."""
    kind = {1: "uint8", 2: "uint16"}[voxels.dtype.itemsize]
    directions = " ".join(f"({','.join(str(float(spacing[d]) if c == d else 0) for c in range(3))})" for d in range(3))
    head = ["NRRD0004", f"type: {kind}", "dimension: 3", "space: left-posterior-superior",
            f"sizes: {' '.join(map(str, voxels.shape[::-1]))}", f"space directions: {directions}", "kinds: domain domain domain",
            "endian: little", "encoding: gzip", f"space origin: ({','.join(str(float(o)) for o in origin)})"]
    file.write_bytes("\n".join(head).encode() + b"\n\n" + gzip.compress(np.ascontiguousarray(voxels).tobytes(), 4))


def main(mr: str, truth_file: str, factor: str, out_mr: str, out_truth: str) -> None:
    scan, truth = read_nrrd(Path(mr)), read_nrrd(Path(truth_file))
    image, labels = scan.voxels.astype("<u2"), truth.voxels.astype("u1")
    origin, spacing = np.array(scan.grid.origin, float), np.array(scan.grid.spacing, float)
    if float(factor) > 1:
        rows = int(AIR_IN_FRONT_MM / spacing[1])
        image, labels = with_air(image, rows, image[:, :6].ravel()), with_air(labels, rows, np.zeros(1))
        origin[1] -= rows * spacing[1]
    image, labels = grown(image, labels, float(factor))
    write_nrrd(Path(out_mr), image, spacing, origin)
    write_nrrd(Path(out_truth), labels, spacing, origin)


if __name__ == "__main__":
    if len(sys.argv) != 6:
        sys.exit(__doc__)
    main(*sys.argv[1:])
