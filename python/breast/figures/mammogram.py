# SPDX-License-Identifier: GPL-3.0-or-later
"""Mammograms with axes in mm, and on them the curves of cc2mlo (Fig. 6)."""
from __future__ import annotations

import colorsys
from collections.abc import Sequence

import numpy as np

from ..curves import Line
from ..errors import BreastError
from ..mammogram import Mammogram
from .colours import INK, TUMOUR, WHITE, Colour, Stroke
from .inputs import Inputs, need
from .layout import RING, SMALL, Panel, Picture

_CURVE, _ARC = Stroke((0.1, 0.9, 0.4), 3), Stroke((0.35, 0.65, 1.0), 2.2, (3, 1.6))
_AXIS = 76  # pixels beside the image
_DIM: Colour = (0.85, 0.85, 0.85)


def hung(image: Mammogram) -> np.ndarray:
    """Grey from 0 to 1 (nv, nu) in rows from the top, as clinics hang a mammogram and project-mammogram shades it.

    The chest wall is at the left edge for a left breast and at the right edge for a right one; lateral (CC) or superior (MLO, ML)
    is at the top; dense tissue is bright. Pixels without a value are an even grey. Raises BreastError for an image without greys.
    """
    if "grey" not in image.images:
        raise BreastError("holds no array grey", image.file, "it is of an older version: run project-mammogram again")
    grey = image.images["grey"] / 65535
    return grey if image.side == "left" else grey[::-1, ::-1]


class _Hanging:
    """From (u, v) in mm to the plane of the picture as it is hung, mm, y up."""

    def __init__(self, image: Mammogram) -> None:
        self.left = image.side == "left"
        nv, nu = image.images["path"].shape
        self.size = image.pixel_mm * np.array([nu - 1, nv - 1])

    def __call__(self, uv: np.ndarray) -> np.ndarray:
        if self.left:
            return np.array([0, self.size[1]]) + uv * [1, -1]
        return np.array([self.size[0], 0]) + uv * [-1, 1]


def parts_inside(line: np.ndarray, size: np.ndarray) -> tuple[list[np.ndarray], float]:
    """The parts of a line (n, 2) inside an image of `size` (2) mm, and the length of the rest in mm."""
    parts: list[list[np.ndarray]] = []
    total = kept = 0.0
    for a, b in zip(line, line[1:]):
        along, length = b - a, float(np.linalg.norm(b - a))
        total += length
        low, high = 0.0, 1.0  # the segment from a + low * along to a + high * along is within all four sides
        for room, closing in zip([*a, *(size - a)], [*-along, *along]):
            if closing > 0:
                high = min(high, room / closing)
            elif closing < 0:
                low = max(low, room / closing)
            elif room < 0:
                high = -1.0
        if not high > low:
            continue
        kept += (high - low) * length
        start, end = a + low * along, a + high * along
        if not parts or low > 0 or np.linalg.norm(parts[-1][-1] - start) > 1e-9:
            parts.append([start])
        parts[-1].append(end)
    return [np.array(part) for part in parts], total - kept


def _query_colour(query: int, count: int) -> Colour:
    """Round the colour circle, and light and dark in turn."""
    return colorsys.hls_to_rgb(query / count, 0.72 if query % 2 else 0.55, 0.95) if count > 1 else TUMOUR


def _query(line: Line) -> int:
    return int(line.arrays["query"][0])


def _place_words(curves: dict[str, list[Line]]) -> str:
    """What the ring in the second view is: the truth, a mark of the user, or where the model itself has the landmark."""
    for start, words in (("model's artificial", "where the model puts the artificial tumour"),
                         ("model's", "where the model puts the tumour"), ("truth", "its true position"),
                         ("mark", "its marked position")):
        if any(name.startswith(start) and name.endswith(" in MLO") for name in curves):
            return words
    return ""


def _places(curves: dict[str, list[Line]]) -> list[Line]:
    """The positions in the second view that were given, or that the model itself has."""
    return [line for name, lines in curves.items() for line in lines
            if name.endswith(" in MLO") and name.startswith(("truth", "mark", "model's"))]


def _caption(image: Mammogram, curves: dict[str, list[Line]], size: np.ndarray) -> str:
    """What is drawn on the image; empty without curves."""
    asked = curves.get("point in CC", [])
    if not curves:
        return ""
    if image.view == "CC":
        if len(asked) > 1:
            return "the points asked for; small white ring: nipple"
        place = next((words for start, words in (("model's artificial", "artificial tumour"), ("model's", "tumour"))
                      if any(name.startswith(start) for name in curves)), "the point")
        return f"yellow ring: {place}; small white ring: nipple"
    outside = sum(parts_inside(line.uv_mm, size)[1] for line in curves.get("curve", []))
    lost = f" ({outside:.0f} mm outside the image)" if outside >= 0.5 else ""
    if len(asked) > 1:
        return f"their curves{lost}"
    place = _place_words(curves)
    return f"solid green: its curve{lost}; blue, dashed: equal distance from the nipple" + (f"; yellow ring: {place}" if place else "")


def _add_curves(panel: Panel, image: Mammogram, curves: dict[str, list[Line]], hanging: _Hanging) -> list[tuple[np.ndarray, float]]:
    """Draws what cc2mlo found for this view, and returns its rings: centre and radius in pixels."""
    asked = curves.get("point in CC", [])
    many = len(asked) > 1
    view = "CC" if image.view == "CC" else "MLO"
    marks = [(nipple, 9.0, WHITE) for nipple in curves.get(f"nipple in {view}", [])]
    if view == "CC":
        marks += [(p, 6 if many else RING, _query_colour(_query(p), len(asked))) for p in asked]
    else:
        drawn = [(line, _ARC) for line in ([] if many else curves.get("arc", []))]
        drawn += [(line, Stroke(_query_colour(_query(line), len(asked)), 2.4) if many else _CURVE)
                  for line in curves.get("curve", [])]
        for line, stroke in drawn:
            panel.lines([hanging(part) for part in parts_inside(line.uv_mm, hanging.size)[0]], stroke)
        marks += [(p, 6 if many else RING, TUMOUR) for p in _places(curves)]
    for mark, radius, colour in marks:
        panel.ring(hanging(mark.uv_mm[0]), radius, colour)
    return [(np.asarray(panel.to_pixel(hanging(mark.uv_mm[0]))), radius) for mark, radius, _ in marks]


def free_height(heights: Sequence[float], x: float, width: float, rings: Sequence[tuple[np.ndarray, float]]) -> float:
    """The first height, pixels, at which a word from x to x + width (which may be negative) touches no ring; otherwise the first."""
    low, high = sorted((x, x + width))
    half = 0.5 * SMALL + 3
    return next((y for y in heights if all(np.hypot(max(low - c[0], 0, c[0] - high), max(abs(c[1] - y) - half, 0)) > radius
                                           for c, radius in rings)), heights[0])


def _add_axes(panel: Panel, image: Mammogram, hanging: _Hanging, rings: Sequence[tuple[np.ndarray, float]]) -> None:
    """u below and v on the anterior side; the chest wall is at the picture's outer edge. Words are inside, where it is dark."""
    low, high = panel.to_pixel(np.zeros(2)), panel.to_pixel(hanging.size)
    edge, outward = (high[0], 1) if hanging.left else (low[0], -1)
    align, inner = ("left", "right") if hanging.left else ("right", "left")
    thin = Stroke(INK, 1)
    for x in (low[0], high[0]):  # muscle at the edge may be as white as the paper
        panel.line([(x, low[1]), (x, high[1])], thin)
    for u in np.arange(0, hanging.size[0] + 1e-9, 20):
        x = panel.to_pixel(hanging(np.array([u, 0])))[0]
        panel.line([(x, low[1]), (x, low[1] - 6)], thin)
        panel.text((x, low[1] - 16), f"{u:.0f}", SMALL, align="center")
    for v in np.arange(0, hanging.size[1] + 1e-9, 20):
        y = panel.to_pixel(hanging(np.array([0, v])))[1]
        panel.line([(edge, y), (edge + 6 * outward, y)], thin)
        panel.text((edge + 10 * outward, y), f"{v:.0f}", SMALL, align=align)
    words, middle = "u (mm) from the posterior edge", 0.5 * (low[0] + high[0])
    panel.text((middle, low[1] - 36), words, SMALL, align="center")
    beside = outward * max(abs(edge - middle), 0.27 * SMALL * len(words))  # a narrow image's words reach beyond it
    panel.text((middle + beside + 10 * outward, low[1] - 36), "v (mm)", SMALL, align=align)
    if image.plate_edge_mm > 1:  # where the image begins at the plates, they need no mark
        x = panel.to_pixel(hanging(np.array([image.plate_edge_mm, 0])))[0]
        panel.line([(x, low[1]), (x, high[1])], Stroke((0.7, 0.7, 0.7), 1, (3, 6)))
        panel.text((x + 8 * outward, low[1] + 10), "plates from here", SMALL - 1, _DIM, rotation=90)
    back, wide = image.images["through_back"] != 0, False
    if back.any():
        blank = (back & ~(image.images["thickness"] > 0)).any()
        chest = low[0] + 6 if hanging.left else high[0] - 6
        words = "even grey: unknown" if blank else "behind the model: fat or muscle"
        wide = 0.6 * (SMALL - 1) * len(words) + 12 > high[0] - low[0]  # a narrow image takes them in two lines
        for k, line in enumerate(words.split(": ")[::-1] if wide else [words]):
            panel.text((chest, low[1] + 14 + 16 * k), line + (":" if k else ""), SMALL - 1, _DIM, align)
    inset = edge - 10 * outward
    panel.text((inset, high[1] - 18), f"{image.side[0].upper()} {image.view}", 21, WHITE, inner)
    panel.text((inset, high[1] - 42), "lateral" if image.view == "CC" else "superior", SMALL, WHITE, inner)
    # In a narrow picture above the words at the chest.
    below = "medial" if image.view == "CC" else "inferior"
    heights = [low[1] + y + 20 * wide for y in ((34, 54, 74) if high[0] - low[0] < 400 else (14, 34, 54))]
    panel.text((inset, free_height(heights, inset, -outward * 0.6 * SMALL * len(below), rings)), below, SMALL, WHITE, inner)


def add_mammograms(panels: Sequence[Panel], images: Sequence[Mammogram], curves: dict[str, list[Line]], letters: str) -> None:
    """Mammograms with the curves of their views, at one scale; a letter begins each caption."""
    hangings = [_Hanging(image) for image in images]
    for panel, image, hanging, letter in zip(panels, images, hangings, letters):
        words = _caption(image, curves, hanging.size)
        panel.caption(f"({letter}) {image.view}" + (f"; {words}" if words else ""))
    for panel in panels:
        panel.top = min(panel.top for panel in panels)
    corners = [np.array([np.zeros(2), hanging.size]) for hanging in hangings]
    scale = max(panel.needed(corner, 12, _AXIS) for panel, corner in zip(panels, corners))
    for panel, image, hanging, corner in zip(panels, images, hangings, corners):
        panel.fit(corner, scale, 12, _AXIS, mirrored=not hanging.left)
        panel.image(hung(image), np.full(2, -0.5 * image.pixel_mm), image.pixel_mm, "bicubic")
        _add_axes(panel, image, hanging, _add_curves(panel, image, curves, hanging))


def draw(inputs: Inputs) -> Picture:
    need(inputs.mammograms, "mammogram", "a mammogram .vti")
    images = inputs.mammograms[:2]
    picture, n = Picture(800 * len(images), 1000), len(images)
    add_mammograms([picture.panel(k / n, 0, (k + 1) / n, 1) for k in range(n)], images, inputs.curves, "ab")
    return picture
