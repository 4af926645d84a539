# SPDX-License-Identifier: GPL-3.0-or-later
"""The outline of a surface seen along a direction."""
from __future__ import annotations

import numpy as np

RASTER_MM = 0.5
_BORDER = 12  # pixels round the raster
_SMOOTHING = 3.0  # pixels


def gaussian(field: np.ndarray, sigma: float) -> np.ndarray:
    """Gaussian smoothing of a field (rows, columns) with a standard deviation in pixels; beyond the border the border's values."""
    reach = int(np.ceil(3 * sigma))
    weights = np.exp(-0.5 * np.arange(-reach, reach + 1) ** 2 / sigma**2)
    weights /= weights.sum()
    for axis in (0, 1):
        padded = np.pad(field, [(reach, reach) if a == axis else (0, 0) for a in (0, 1)], mode="edge")
        rows = field.shape[axis]
        field = sum(w * np.take(padded, range(k, k + rows), axis) for k, w in enumerate(weights))
    return field


def contours(field: np.ndarray, level: float, pixel: float, corner: np.ndarray) -> list[np.ndarray]:
    """Lines (n, 2) on which a field (rows, columns) has a value, its entry (0, 0) at `corner`; none where it is NaN."""
    from contourpy import contour_generator
    return [corner + pixel * line for line in contour_generator(z=np.ma.masked_invalid(field)).lines(level)]


def silhouette(flat: np.ndarray, quads: np.ndarray) -> list[np.ndarray]:
    """Outline of facets, lines (n, 2) in mm, found on a raster of RASTER_MM and accurate to about that.

    Args:
        flat: (P, 2) places in the picture's plane, mm.
        quads: (Q, 4) rows of flat; a triangle repeats its last corner.
    """
    from matplotlib.backends.backend_agg import RendererAgg
    from matplotlib.path import Path
    from matplotlib.transforms import Affine2D
    used = flat[np.unique(quads)]
    corner = used.min(0) - _BORDER * RASTER_MM
    width, height = (int(n) for n in np.ptp(used, axis=0) / RASTER_MM + 2 * _BORDER)
    renderer = RendererAgg(width, height, 72)
    paint = renderer.new_gc()
    paint.set_antialiased(True)
    paint.set_linewidth(0.6)  # closes the seams between facets
    paint.set_foreground("black")
    places = ((flat - corner) / RASTER_MM)[quads]
    codes = [Path.MOVETO, *[Path.LINETO] * 3, Path.CLOSEPOLY]
    closed = np.concatenate([places, places[:, :1]], axis=1).reshape(-1, 2)
    for part in np.array_split(np.arange(len(quads)), max(1, len(quads) // 2000)):  # few enough for the rasteriser's memory
        vertices = closed.reshape(-1, 5, 2)[part]
        for facet in vertices:
            renderer.draw_path(paint, Path(facet, codes), Affine2D(), (0, 0, 0, 1))
    covered = np.asarray(renderer.buffer_rgba())[::-1, :, 3] / 255
    return contours(gaussian(covered, _SMOOTHING), 0.5, RASTER_MM, corner + 0.5 * RASTER_MM)
