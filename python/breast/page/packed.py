# SPDX-License-Identifier: GPL-3.0-or-later
"""What the scripts of the page read: images, curves of both directions, the outline of the breast and perhaps the scan, packed.

Arrays are little-endian numbers, deflated and as base64; the script data.js unpacks them. Where neighbours are alike, their
differences are stored, which halves the size.
"""
from __future__ import annotations

import zlib
from base64 import b64encode
from typing import Any

import numpy as np

from ..elements import face_corners
from ..errors import BreastError
from ..figures.mammogram import hung
from ..figures.silhouette import contours
from ..grid import Grid
from ..lookup import Lookup
from ..mammogram import Mammogram
from ..state import State
from ..volume import Volume
from .drawing import inside_body
from .facts import slice_of

LARGEST_PAGE = 25_000_000  # bytes
_UNIT = 0.01  # mm of packed lengths
_MOST_NODES = 14000
_FINEST_PIXEL = 0.25  # mm
_MARGIN = 15  # mm of the scan about the breast
_MOST_VOXELS = 3_000_000
_AXIAL = 0.9999  # the cosine between the scan's third axis and the patient's


def landmarks_of(state: State) -> list[str]:
    """The names in the mesh of the landmarks that the page marks; that of a tumour may be artificial_tumour."""
    return [name for name in ("nipple", "tumour", "artificial_tumour") if name in state.landmarks]


def box_of(state: State) -> tuple[np.ndarray, np.ndarray]:
    """Lowest and highest corner (3) of the imaged shape, LPS mm."""
    return state.imaged.min(0), state.imaged.max(0)


def packed_image(image: Mammogram, compressed: State) -> dict[str, Any]:
    """The picture in clinical orientation, 16 bits, with every n-th pixel so that pixels are at least a quarter millimetre, and the
    landmarks of `compressed` in it."""
    skip = max(1, int(_FINEST_PIXEL / image.pixel_mm + 0.5))
    grey = hung(image)
    shown = np.rint(65535 * grey[::skip, ::skip]).astype("<u2")
    rows, columns = grey.shape
    depth, pitch = inside_body(image)
    places = [(name, image.project(compressed.landmark_position(name)[None])[0]) for name in landmarks_of(compressed)]
    return {"view": image.view, "width": shown.shape[1], "height": shown.shape[0], "pixel": image.pixel_mm * skip,
            "u_mm": image.pixel_mm * (columns - 1), "v_mm": image.pixel_mm * (rows - 1),
            "landmarks": [{"name": name, "at": at.tolist()} for name, at in places], "grey": _array(shown, 1),
            "outline": [ring.round(1).tolist() for ring in contours(depth, 0, pitch, np.full(2, -pitch))]}


def packed_lookup(lookup: Lookup, middle: np.ndarray) -> dict[str, Any]:
    """The curves of a grid, only for nodes in tissue; coordinates reach at most 327 mm from `middle` (columns) or the image's corner.

    A grid with more than 14 000 nodes in tissue is thinned, so that a direction takes at most 3 MB.
    """
    stride = 1
    while np.count_nonzero(lookup.status[::stride, ::stride]) > _MOST_NODES:
        stride += 1
    status = lookup.status[::stride, ::stride]
    tissue = status != 0

    def packed(values: np.ndarray, kind: str) -> dict[str, Any]:
        bounds = np.iinfo(kind)
        return _array(np.clip(np.rint(values / _UNIT), bounds.min, bounds.max).astype(kind), values[0].size if len(values) else 1)

    def kept(values: np.ndarray) -> np.ndarray:
        return values[::stride, ::stride][tissue].astype(float)
    return {"pitch": lookup.pitch_mm * stride, "nu": status.shape[1], "nv": status.shape[0], "samples": lookup.curve_mm.shape[2],
            "status": _array(status.astype("u1")), "depth": packed(kept(lookup.depth_mm), "<u2"),
            "length": packed(kept(lookup.length_mm), "<u2"), "curve": packed(kept(lookup.curve_mm), "<i2"),
            "deviation": packed(kept(lookup.deviation_mm), "<u2"), "imaged": packed(kept(lookup.imaged_mm) - middle, "<i2")}


def packed_body(state: State) -> dict[str, Any]:
    """Edges of skin, chest wall and cut in the frame of the scan, mm, with nipple and tumour."""
    def edges(faces: np.ndarray) -> dict[str, Any]:
        corners = face_corners(state.hexahedra, faces)
        ends = np.stack([corners, np.roll(corners, -1, 1)], -1).reshape(-1, 2)
        return _array(state.imaged[np.unique(np.sort(ends, 1), axis=0)].astype("<f4"))
    low, high = box_of(state)
    return {"middle": (0.5 * (low + high)).tolist(), "skin": edges(state.faces["skin"]), "wall": edges(state.faces["pectoral"]),
            "cut": edges(state.faces["cut"]),
            "landmarks": [{"name": name, "at": state.landmark_position(name, "imaged").tolist()} for name in landmarks_of(state)]}


def packed_scan(scan: Volume, state: State) -> dict[str, Any]:
    """The scan in the box of the imaged breast and 15 mm about it, so that it holds only the part of the patient that the page shows.

    8 bits between the 1st and the 99.5th percentile, axes along the patient's, voxels of at least 1 x 1 mm, at most 3 million. Planes are
    the slices of an axial scan, or else 2 mm apart; `slices` says how the scan itself counts: its slice at LPS mm (x, y, z) is
    row · (x, y, z, 1), from 0.
    Raises BreastError where the scan does not cover the breast.
    """
    low, high = box_of(state)
    grid = _grid_about(low - _MARGIN, high + _MARGIN, scan.grid)
    k, j, i = np.indices(grid.size[::-1]).reshape(3, -1)
    values = scan.sample(grid.to_patient(np.stack([i, j, k], -1)), np.nan)
    inside = np.sort(values[np.isfinite(values)])
    if len(inside) < len(values) // 4:
        raise BreastError(f"covers {100 * len(inside) // len(values)} % of the bounding box of the imaged breast", scan.file,
                          "give the scan that was segmented")
    dark, bright = (float(inside[int(rank * (len(inside) - 1))]) for rank in (0.01, 0.995))
    grey = np.nan_to_num(np.rint(255 * np.clip((values - dark) / max(bright - dark, 1e-30), 0, 1)))
    _, count, plane = slice_of(scan.grid, 0.5 * (low + high))
    offset, *steps = scan.grid.to_index(np.vstack([np.zeros(3), np.eye(3)]))[:, 2]
    return {"size": list(grid.size), "spacing": grid.spacing.tolist(), "origin": grid.origin.tolist(), "grey": _array(grey.astype("u1"), 1),
            "slices": {"plane": plane, "count": count, "row": [*(float(step - offset) for step in steps), float(offset)]}}


def _grid_about(low: np.ndarray, high: np.ndarray, scan: Grid) -> Grid:
    """The grid of a box along the patient's axes, coarser if the box is large; its planes are slices of a scan that is axial."""
    axial, coarser = abs(scan.direction[2, 2]) > _AXIAL, 1.0
    while True:
        spacing, first = coarser * np.array([1.0, 1.0, 2.0]), low.copy()
        if axial:
            spacing[2] = scan.spacing[2] * np.ceil(coarser / scan.spacing[2])
            first[2] = scan.origin[2] + scan.spacing[2] * np.ceil((low[2] - scan.origin[2]) / scan.spacing[2])
        size = 1 + ((high - first) / spacing).astype(int)
        if size.prod() <= _MOST_VOXELS:
            return Grid((int(size[0]), int(size[1]), int(size[2])), spacing, first, np.eye(3))
        coarser *= 1.1


def _array(values: np.ndarray, step: int = 0) -> dict[str, Any]:
    """step: each number is stored as its difference from the one `step` places before; 0: as it is."""
    numbers = np.ascontiguousarray(values).ravel()
    kind = numbers.dtype.newbyteorder("<").str[1:]
    if step:
        numbers = np.concatenate([numbers[:step], numbers[step:] - numbers[:-step]])
    return {"packed": b64encode(zlib.compress(numbers.tobytes(), 9)).decode(), "kind": kind, "step": step}
