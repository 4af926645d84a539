# SPDX-License-Identifier: GPL-3.0-or-later
"""The pictures of the page that need no script: both views and the slice of the scan, in mm, with what is marked in them.

Pictures of one row have one scale. In a picture x grows to the right and y down, from its upper left corner.
"""
from __future__ import annotations

import io
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from ..figures.mammogram import hung
from ..figures.silhouette import contours, gaussian
from ..figures.slices import AXIAL, CORONAL, GAMMA, IN_PLANE_MM, SAGITTAL
from ..mammogram import Mammogram
from ..state import State
from ..study.html import data_uri
from ..volume import Volume
from .facts import slice_of
from .lines import MatchedLine
from .patient import PatientImage

BAR_MM = 20
_AROUND_MM = 15  # of a slice about the breast
_BESIDE_MM = 10  # of the patient's image about the simulated outline
_ENDS = {"CC": ("lateral", "medial"), "MLO": ("superior", "inferior"), "ML": ("superior", "inferior")}
_QUALITY = 90
_RASTER_MM = 0.5  # on which the border of a band is found


@dataclass
class Picture:
    """What the template draws.

    Attributes:
        name: for programs: CC, MLO, MR, patient-CC, patient-MLO.
        size: width and height, mm.
        place: left and top edge, width and height of the image, mm.
        image: data URI.
        title, words: in a corner, and at left, right, top and bottom.
        outward: whether the free margin is at the right.
        marks: (kind, x, y), kind nipple, tumour or artificial.
        line: points of each stretch of the line, "x,y x,y".
        band: path of the band, as far as it lies in the breast, or "".
        outlines: lines of the simulated outline in a patient's image.
        alt: what the picture shows, for those who cannot see it.
    """

    name: str
    size: tuple[float, float]
    place: tuple[float, float, float, float]
    image: str
    title: str
    words: tuple[str, str, str, str]
    outward: bool
    alt: str
    marks: list[tuple[str, float, float]] = field(default_factory=list)
    line: list[str] = field(default_factory=list)
    band: str = ""
    outlines: list[str] = field(default_factory=list)


def view_picture(image: Mammogram, state: State, size: tuple[float, float], line: MatchedLine | None) -> Picture:
    """A simulated view with nipple and tumour, and the line of the tumour as seen in the other view.

    Args:
        size: mm, of both pictures of a pair; the chest wall is at the left edge of a left breast, at the right edge of a right one.
    """
    rows, columns = image.images["path"].shape
    width, height = image.pixel_mm * columns, image.pixel_mm * rows
    left, top = 0.0 if image.side == "left" else size[0] - width, 0.5 * (size[1] - height)

    def put(uv: np.ndarray) -> np.ndarray:
        at = np.asarray(uv, float) + 0.5 * image.pixel_mm
        return np.array([left, top]) + (at if image.side == "left" else np.array([width, height]) - at)
    side = image.side[0].upper()
    upper, lower = _ENDS[image.view]
    picture = Picture(image.view, size, (left, top, width, height), _jpeg(hung(image)), f"{side} {image.view}", ("", "", upper, lower),
                      image.side == "left", f"Simulated {image.view} mammogram of the {image.side} breast")
    _mark(picture, state, lambda name: put(image.project(state.landmark_position(name)[None])[0]))
    if line is not None:
        _draw_line(picture, line, image, put)
    return picture


def patient_picture(image: Mammogram, state: State, patient: PatientImage, line: MatchedLine | None) -> Picture:
    """The patient's own mammogram about the breast, with the outline of the simulated one, and in it what view_picture shows."""
    from PIL import Image

    outlines = [patient.put(outline) for outline in _outlines(image)]
    grey = np.asarray(Image.open(patient.picture).convert("L"), float) / 255
    low, high = np.vstack(outlines).min(0) - _BESIDE_MM, np.vstack(outlines).max(0) + _BESIDE_MM
    first = np.maximum(np.floor(low / patient.pixel_mm).astype(int), 0)
    last = np.minimum(np.ceil(high / patient.pixel_mm).astype(int), grey.shape[::-1])
    first[0], last[0] = (0, last[0]) if patient.left else (first[0], grey.shape[1])  # as far as the chest wall
    grey, corner = grey[first[1] : last[1], first[0] : last[0]], patient.pixel_mm * first
    width, height = patient.pixel_mm * np.array(grey.shape[::-1])
    side = image.side[0].upper()
    upper, lower = _ENDS[image.view]
    picture = Picture(f"patient-{image.view}", (width, height), (0.0, 0.0, width, height), _jpeg(grey), f"{side} {image.view}",
                      ("", "", upper, lower), patient.left,
                      f"The patient's own {image.view} mammogram of the {image.side} breast, with the outline of the simulated one")
    picture.outlines = [_points(outline - corner) for outline in outlines]
    _mark(picture, state, lambda name: patient.put(image.project(state.landmark_position(name)[None]))[0] - corner)
    if line is not None:
        _draw_line(picture, line, image, lambda uv: patient.put(uv) - corner)
    return picture


def _outlines(image: Mammogram) -> list[np.ndarray]:
    """The border of the simulated breast, lines (n, 2) in (u, v), mm, without the edges of the image."""
    return contours((image.images["thickness"] > 0).astype(float), 0.5, image.pixel_mm, np.zeros(2))


def pair_size(images: tuple[Mammogram, ...]) -> tuple[float, float]:
    """Width and height in mm that hold every image."""
    extents = [image.pixel_mm * np.array(image.images["path"].shape[::-1]) for image in images]
    width, height = np.max(extents, axis=0)
    return float(width) + 4, float(height)


def slice_picture(scan: Volume, state: State) -> Picture:
    """The slice of the scan nearest to the tumour, or else to the nipple, about the breast; as slices are read."""
    name = "tumour" if any("tumour" in known for known in state.landmarks) else "nipple"
    place = state.landmark_position(name, "imaged")
    number, count, plane_name = slice_of(scan.grid, place)
    plane = {"axial": AXIAL, "sagittal": SAGITTAL, "coronal": CORONAL}[plane_name]
    low, high = state.imaged.min(0) - _AROUND_MM, state.imaged.max(0) + _AROUND_MM
    middle = 0.5 * (low + high)
    index = scan.grid.to_index(middle)
    index[2] = number - 1
    middle = scan.grid.to_patient(index)
    size = np.abs([(high - low) @ plane.right, (high - low) @ plane.up])
    pitch = max(0.4, float(scan.grid.spacing[:2].min()))
    columns, rows = (size / pitch).astype(int)
    corner = middle - 0.5 * size[0] * plane.right + 0.5 * size[1] * plane.up
    places = corner + pitch * ((np.arange(columns) + 0.5)[:, None] * plane.right - (np.arange(rows) + 0.5)[:, None, None] * plane.up)
    grey = scan.sample(places.reshape(-1, 3), 0).reshape(rows, columns)
    white = max(float(np.percentile(grey, 99.5)), 1e-30)
    picture = Picture("MR", (float(size[0]), float(size[1])), (0.0, 0.0, float(size[0]), float(size[1])),
                      _jpeg(np.clip(grey / white, 0, 1) ** GAMMA), f"MR {number} of {count}", plane.words, True,
                      f"{plane_name.capitalize()} slice {number} of {count} of the MR scan through the {name}")
    normal = np.cross(plane.right, plane.up)

    def put(landmark: str) -> np.ndarray | None:
        at = state.landmark_position(landmark, "imaged")
        if abs((at - middle) @ normal) > IN_PLANE_MM:
            return None
        return np.array([(at - corner) @ plane.right, (corner - at) @ plane.up])
    _mark(picture, state, put)
    return picture


def _mark(picture: Picture, state: State, put: Callable[[str], np.ndarray | None]) -> None:
    kinds = {"nipple": "nipple", "tumour": "tumour", "artificial_tumour": "artificial"}
    for name in (name for name in kinds if name in state.landmarks):
        at = put(name)
        left, top, width, height = picture.place
        if at is not None and left <= at[0] <= left + width and top <= at[1] <= top + height:
            picture.marks.append((kinds[name], round(float(at[0]), 2), round(float(at[1]), 2)))
            picture.alt += f", with the {name.replace('_', ' ')} marked"


def _draw_line(picture: Picture, line: MatchedLine, image: Mammogram, put: Callable[[np.ndarray], np.ndarray]) -> None:
    picture.line = [_points(put(stretch)) for stretch in line.stretches]
    if line.to_either_side_mm > 0:
        picture.band = " ".join(f"M{_points(put(ring))}Z" for ring in _band(line, image))
    picture.alt += f"; a line of {line.length_mm:.0f} mm on which the tumour lies, as seen in the other view"


def _band(line: MatchedLine, image: Mammogram) -> list[np.ndarray]:
    """Borders (n, 2) of the band in the breast, mm: a place beside the breast is none of the finding's."""
    inside, pitch = inside_body(image)
    v, u = pitch * (np.indices(inside.shape).reshape(2, -1) - 1)
    return contours(np.minimum(line.inside_band(np.stack([u, v], -1)).reshape(inside.shape), inside), 0, pitch, np.full(2, -pitch))


def inside_body(image: Mammogram) -> tuple[np.ndarray, float]:
    """Positive in the breast, negative beside it and zero at its border, at every n-th pixel of an image with a border of one; the distance
    of these pixels, mm. Not a distance from the border."""
    skip = max(1, round(_RASTER_MM / image.pixel_mm))
    body = (image.images["thickness"] > 0) | (image.images["through_back"] != 0)
    smooth = 4 * (gaussian(body[::skip, ::skip].astype(float), 1) - 0.5)
    return np.pad(smooth, 1, constant_values=-1), skip * image.pixel_mm


def _points(places: np.ndarray) -> str:
    return " ".join(f"{x:.2f},{y:.2f}" for x, y in places)


def _jpeg(grey: np.ndarray) -> str:
    """Grey values from 0 to 1, (rows, columns), as a data URI: a fifth of the bytes of a PNG."""
    from PIL import Image

    stream = io.BytesIO()
    Image.fromarray(np.rint(255 * grey).astype(np.uint8)).save(stream, "jpeg", quality=_QUALITY, optimize=True)
    return data_uri(stream.getvalue(), "jpeg")
