# SPDX-License-Identifier: GPL-3.0-or-later
"""The scan in three planes with the contours of its segmentation: what the model was made from."""
from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..errors import BreastError
from ..section import quads_in_plane
from ..state import TISSUES, State
from .body import face_facets, has_tumour
from .colours import GLAND_LINE, MODEL_LINE, SKIN_LINE, WALL_LINE, WHITE, Stroke
from .inputs import Inputs, need
from .layout import LETTERS, RING, Panel, Picture
from .outlines import joined
from .silhouette import contours, gaussian

_MARGIN_MM = 12
IN_PLANE_MM = 3  # a landmark farther from the plane is not marked in it: beside a nipple, which is some 10 mm wide, it would float in air
_RASTER_MM = 0.6
_SMOOTHING_MM, _SMOOTHING_VOXELS = 0.9, 0.6  # so that contours do not follow the steps of voxels
_NEAR_BREAST_MM = 2.5
GAMMA = 0.8  # mid-greys are lifted a little, as a viewer's default window does
_OF_BREAST = [TISSUES.index(name) for name in ("fat", "fibroglandular", "skin", "tumour")]


@dataclass(frozen=True)
class Plane:
    """Axial slices are seen from below with anterior on top, sagittal ones from the patient's left with anterior on the left, and
    coronal ones from the front; words are at left, right, top and bottom."""

    name: str
    axis: int
    right: np.ndarray
    up: np.ndarray
    words: tuple[str, str, str, str]


_X, _Y, _Z = np.eye(3)
AXIAL = Plane("axial", 2, _X, -_Y, ("R", "L", "A", "P"))
SAGITTAL = Plane("sagittal", 0, _Y, _Z, ("A", "P", "S", "I"))
CORONAL = Plane("coronal", 1, _X, _Z, ("R", "L", "S", "I"))


class Slices:
    """What all planes share: the shown part of the scan, where the planes meet, and the grey shown as white."""

    def __init__(self, inputs: Inputs) -> None:
        self.scan, self.labels = inputs.scan, inputs.labels
        self.state: State | None = inputs.states[0] if inputs.states else None
        self._breast = np.isin(self.labels.tissue, _OF_BREAST)
        if not self._breast.any():
            raise BreastError("there is no breast to show", self.labels.file)
        k, j, i = np.nonzero(self._breast)
        self._places = self.labels.grid.to_patient(np.stack([i, j, k], -1))
        self.low, self.high = self._places.min(0) - _MARGIN_MM, self._places.max(0) + _MARGIN_MM

    @cached_property
    def tumour(self) -> np.ndarray | None:
        """(3) in the scan."""
        if self.state is not None:
            return self.state.landmark("tumour").imaged if has_tumour(self.state) else None
        return self.labels.landmarks.get("tumour")

    @cached_property
    def through(self) -> np.ndarray:
        """Where the planes meet (3): the tumour, or the middle of the fibroglandular tissue or else of the breast."""
        if self.tumour is not None:
            return self.tumour
        weight = self.labels.fibroglandular_fraction[self._breast].astype(float)
        return np.average(self._places, axis=0, weights=weight if weight.sum() > 0 else None)

    @cached_property
    def white(self) -> float:
        """The 99.5th percentile of the breast's intensities."""
        some = np.zeros_like(self._breast)
        some[::2, ::3, ::3] = True
        values = self.scan.sample(self._places[some[self._breast]], 0)
        level = float(np.partition(values, int(0.995 * (len(values) - 1)))[int(0.995 * (len(values) - 1))]) if len(values) else 1.0
        if not level > 0:
            raise BreastError("it is dark where the labels have the breast; is it another scan?", self.scan.file)
        return level

    def size(self, plane: Plane) -> np.ndarray:
        """Width and height (2) in mm of the slice that shows the whole breast."""
        return np.abs([(self.high - self.low) @ plane.right, (self.high - self.low) @ plane.up])

    def nipple(self, plane: Plane) -> np.ndarray | None:
        """The nipple (3) if it lies in the slice or near it."""
        found = self.labels.landmarks.get("nipple")
        return found if found is not None and abs(found[plane.axis] - self.through[plane.axis]) < IN_PLANE_MM else None

    # ---- one plane ---------------------------------------------------------------------------------------------------

    def draw(self, panel: Panel, plane: Plane, mm_per_pixel: float, letter: str) -> None:
        """The slice with contours, marks, directions and scale bar; it fills the panel."""
        middle = 0.5 * (self.low + self.high)
        middle[plane.axis] = self.through[plane.axis]
        size = mm_per_pixel * (panel.size + 2)
        corner = middle - 0.5 * size[0] * plane.right - 0.5 * size[1] * plane.up
        panel.frame(0.5 * size, mm_per_pixel)
        # Half a voxel is as fine as the scan; the page interpolates the rest.
        pitch = max(mm_per_pixel, 0.5 * float(self.scan.grid.spacing.min()))
        grey = self.scan.sample(_raster(corner, plane, size, pitch).reshape(-1, 3), 0) / self.white
        grey = np.clip(grey, 0, 1).reshape(_rows(size, pitch)) ** GAMMA
        panel.image(grey[::-1], np.array([-0.5 * pitch, -0.5 * pitch]), pitch, "bicubic")
        self._add_contours(panel, plane, corner, size)

        def flat(place: np.ndarray) -> np.ndarray:
            return np.stack([(place - corner) @ plane.right, (place - corner) @ plane.up], -1)
        if self.state is not None:
            normal = np.cross(plane.right, plane.up)
            facets = face_facets(self.state, self.state.imaged, self.state.faces["cut"])
            pieces = quads_in_plane(facets.points[facets.quads], corner, normal)
            panel.lines([flat(line) for line in joined(pieces)], MODEL_LINE, halo=True)
        if self.tumour is not None:
            panel.ring(flat(self.tumour), RING)
        if self.nipple(plane) is not None:
            panel.ring(flat(self.nipple(plane)), 0.7 * RING, WHITE)
        self._add_words(panel, plane, panel.to_pixel(flat(self.through)), letter)

    def _add_contours(self, panel: Panel, plane: Plane, corner: np.ndarray, size: np.ndarray) -> None:
        tissue, grid = self.labels.tissue, self.labels.grid
        fields = [self._breast, tissue != 0, tissue == TISSUES.index("muscle"), self.labels.fibroglandular_fraction]
        breast, body, muscle, gland = grid.clamped(fields, _raster(corner, plane, size, _RASTER_MM))
        coarsest = np.abs((grid.direction * grid.spacing).T @ np.stack([plane.right, plane.up], -1)).max()
        smooth = max(_SMOOTHING_MM, _SMOOTHING_VOXELS * coarsest) / _RASTER_MM
        away = gaussian(breast, _NEAR_BREAST_MM / _RASTER_MM) < 0.05
        for field, stroke in ((gaussian(gland, _SMOOTHING_MM / _RASTER_MM), GLAND_LINE),
                              (np.where(away, np.nan, gaussian(muscle, smooth)), WALL_LINE),
                              (np.where(away, np.nan, gaussian(body, smooth)), SKIN_LINE)):
            panel.lines(contours(field, 0.5, _RASTER_MM, np.zeros(2)), stroke, halo=True)

    def _add_words(self, panel: Panel, plane: Plane, through: np.ndarray, letter: str) -> None:
        width, height = panel.size
        places = ((12, 0.5 * height), "left"), ((width - 12, 0.5 * height), "right"), ((0.5 * width, height - 38), "center"), \
            ((0.5 * width, 16), "center")
        for word, (place, align) in zip(plane.words, places):
            panel.text(place, word, LETTERS + 3, WHITE, align)
        dim = Stroke((0.65, 0.65, 0.65), 1.5)  # at the borders, where the two other planes are
        for y in (0, height - 12):
            panel.line([(through[0], y), (through[0], y + 12)], dim)
        for x in (0, width - 12):
            panel.line([(x, through[1]), (x + 12, through[1])], dim)
        panel.text((10, height - 16), f"{letter} {plane.name}, {'xyz'[plane.axis]} = {self.through[plane.axis]:.0f} mm", LETTERS,
                   WHITE)
        panel.scale_bar(WHITE, either_side=True)

    def legend(self, planes: Sequence[Plane]) -> list[tuple[str, Stroke | None]]:
        entries: list[tuple[str, Stroke | None]] = [("skin", SKIN_LINE), ("chest wall", WALL_LINE),
                                                    ("fibroglandular tissue", GLAND_LINE)]
        if self.state is not None:
            entries.append(("end of the model", MODEL_LINE))
        if self.tumour is None:
            entries.append(("through the middle of the fibroglandular tissue", None))
        else:
            artificial = self.state is not None and "tumour" not in self.state.landmarks
            entries.append((f"yellow ring: {'artificial tumour (not in the scan)' if artificial else 'tumour'}", None))
        if any(self.nipple(plane) is not None for plane in planes):
            entries.append(("white ring: nipple", None))
        return entries

    def draw_row(self, picture: Picture, planes: Sequence[Plane], letters: str, bottom: float, right: float, legend: float) -> None:
        """Planes side by side at one scale, and below them the legend, `legend` of the page high."""
        gap, left = 0.003, 0.0
        across = sum(self.size(plane)[0] for plane in planes)
        panels = []
        for plane in planes:
            end = left + right * self.size(plane)[0] / across
            panels.append(picture.panel(left, bottom + legend, end - (gap if plane is not planes[-1] or right < 1 else 0), 1))
            left = end
        scale = max(float((self.size(plane) / panel.size).max()) for plane, panel in zip(planes, panels))
        for plane, panel, letter in zip(planes, panels, letters):
            self.draw(panel, plane, scale, f"({letter})")
        picture.panel(0, bottom, 1, bottom + legend).legend_row(self.legend(planes))


def _rows(size: np.ndarray, pitch: float) -> tuple[int, int]:
    return 1 + int(size[1] / pitch), 1 + int(size[0] / pitch)


def _raster(corner: np.ndarray, plane: Plane, size: np.ndarray, pitch: float) -> np.ndarray:
    """Places (rows, columns, 3) every `pitch` mm, from the lower left corner."""
    rows, columns = _rows(size, pitch)
    return corner + pitch * (np.arange(rows)[:, None, None] * plane.up + np.arange(columns)[:, None] * plane.right)


def need_scan(inputs: Inputs, figure: str) -> None:
    need(inputs.scan is not None and inputs.labels is not None, figure, "the scan (--scan) and its labels (--labels)")


def draw(inputs: Inputs) -> Picture:
    need_scan(inputs, "slices")
    picture = Picture(1800, 760)
    Slices(inputs).draw_row(picture, (AXIAL, SAGITTAL, CORONAL), "abc", 0, 1, 0.07)
    return picture
