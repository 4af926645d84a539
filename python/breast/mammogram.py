# SPDX-License-Identifier: GPL-3.0-or-later
"""Simulated mammograms: the files cc.vti and mlo.vti."""
from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from .errors import BreastError
from .vtk_xml import VtkXml

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


@dataclass(frozen=True)
class Mammogram:
    """An image with its pose. Pixel [j, i] is centred on (u, v) = (i, j) * pixel_mm.

    Attributes:
        file: where it was read from.
        images: (nv, nu) arrays by name: path (line integral), thickness and fibroglandular (mm), through_back, and
            grey (0 to 65535, as project-mammogram shows it).
        view: CC, MLO or ML.
        side: 'left' or 'right'.
        pixel_mm: distance of pixels.
        origin: (3) centre of pixel (0, 0), LPS mm.
        e_u, e_v: (3) unit image axes, LPS; e_u away from the chest wall.
        n: (3) unit direction of the beam, paddle to detector, LPS.
        source_distance_mm: from the detector; 0 for parallel rays.
        plate_edge_mm: u at which the plates' flats begin; behind it tissue is thicker.
    """

    file: Path
    images: dict[str, np.ndarray]
    view: str
    side: str
    pixel_mm: float
    origin: np.ndarray
    e_u: np.ndarray
    e_v: np.ndarray
    n: np.ndarray
    source_distance_mm: float
    plate_edge_mm: float = 0.0

    def project(self, points: ArrayLike) -> np.ndarray:
        """Where points (n, 3) of the compressed shape, LPS mm, appear: (u, v) (n, 2) mm. Parallel rays only."""
        if self.source_distance_mm > 0:
            raise BreastError("was made with a cone of rays, and points are projected for parallel rays only", self.file)
        return (np.asarray(points, float) - self.origin) @ np.stack([self.e_u, self.e_v], -1)

    def extent_mm(self) -> tuple[float, float, float, float]:
        """Left, right, bottom and top edge in (u, v) for matplotlib's imshow(..., origin='lower')."""
        nv, nu = next(iter(self.images.values())).shape
        half = 0.5 * self.pixel_mm
        return -half, nu * self.pixel_mm - half, -half, nv * self.pixel_mm - half


def read_mammogram(file: str | os.PathLike[str]) -> Mammogram:
    """A mammogram. Raises BreastError for a damaged file or one of another schema."""
    xml = VtkXml(Path(file), "ImageData")
    fields = xml.fields()
    if fields.get("schema") != ["mammogram/1"]:
        raise xml.refuse(f"has schema {fields.get('schema') or 'none'}, must be 'mammogram/1'")

    def number(name: str) -> float:
        return float(np.ravel(fields[name])[0])

    nu, nv, _ = xml.data.GetDimensions()
    images = {name: array.reshape(nv, nu) for name, array in xml.group("PointData").items()}
    axes = {name: np.ravel(fields[name]) for name in ("origin", "e_u", "e_v", "n")}
    return Mammogram(xml.file, images, fields["view"][0], fields["side"][0], number("pixel"), **axes,
                     source_distance_mm=number("source_distance"), plate_edge_mm=number("plate_edge_u"))
