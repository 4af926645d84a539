# SPDX-License-Identifier: GPL-3.0-or-later
"""What a radiologist says of a place in the breast, and of the breast itself, computed from the files of a run."""
from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..grid import Grid
from ..labels import Labels
from ..mammogram import Mammogram
from ..state import TISSUES, State
from ..study.stage_report import StageReport
from ..study.views import nipple_lines
from .patient import PatientImage

_BEHIND_NIPPLE_MM = 10  # from the line straight back from the nipple
_DENSITY_LIMITS = (4.5, 7.5, 15.5)  # % of the volume
_DENSITY_WORDS = ("a, almost entirely fatty", "b, scattered areas of fibroglandular density", "c, heterogeneously dense",
                  "d, extremely dense")
_AXES = (("R", "L"), ("A", "P"), ("I", "S"))


@dataclass(frozen=True)
class Fact:
    """One row: `key` names it for programs, `note` says how it is meant."""

    key: str
    name: str
    value: str
    note: str = ""


def clock_position(offset: np.ndarray) -> str:
    """Of a place (3), LPS mm from the nipple, as somebody who faces the patient sees it: "2 o'clock", or "behind the nipple"."""
    if np.hypot(offset[0], offset[2]) < _BEHIND_NIPPLE_MM:
        return "behind the nipple"
    return f"{_hour(offset) or 12} o'clock"


def _hour(offset: np.ndarray) -> int:
    return round(float(np.degrees(np.arctan2(offset[0], offset[2]))) / 30) % 12


def quadrant(offset: np.ndarray, side: str) -> str:
    """Of a place (3), LPS mm from the nipple: "upper outer quadrant", ..., or "between the inner quadrants" at their border."""
    up, across = "upper" if offset[2] > 0 else "lower", "outer" if (offset[0] > 0) == (side == "left") else "inner"
    hour = _hour(offset)
    return f"{up} {across} quadrant" if hour % 3 else f"between the {across if hour % 6 else up} quadrants"


def depth_third(from_wall: float, nipple_from_wall: float) -> str:
    """Anterior, middle or posterior, by how far a place is from the chest wall compared with the nipple, both in mm."""
    return ("posterior", "middle", "anterior")[int(np.clip(3 * from_wall / nipple_from_wall, 0, 2))]


def patient_position(place: np.ndarray) -> str:
    """LPS mm as radiologists write it: "L 94, A 31, S 13 mm"."""
    return ", ".join(f"{ends[int(x > 0)]} {abs(x):.0f}" for x, ends in zip(place, _AXES)) + " mm"


def slice_of(grid: Grid, place: np.ndarray) -> tuple[int, int, str]:
    """Number of the slice nearest to a place (3), as the scan counts them from 1, of how many, and which plane they are."""
    number = int(np.clip(np.rint(grid.to_index(place)[2]), 0, grid.size[2] - 1)) + 1
    return number, grid.size[2], ("sagittal", "coronal", "axial")[int(np.abs(grid.direction[:, 2]).argmax())]


def first_slice(grid: Grid) -> str:
    """Where slice 1 lies: "lowest", "rightmost", ..."""
    along = grid.direction[:, 2]
    axis = int(np.abs(along).argmax())
    return (("rightmost", "leftmost"), ("foremost", "hindmost"), ("lowest", "highest"))[axis][int(along[axis] < 0)]


def density_class(percent: float) -> str:
    """The class of a mammogram's density by the share of fibroglandular tissue in the volume of fat and gland.

    The limits are those of volumetric density grades (Highnam et al. 2010, Proc. IWDM, LNCS 6136), not a radiologist's impression.
    """
    return _DENSITY_WORDS[int(np.searchsorted(_DENSITY_LIMITS, percent, side="right"))]


def wall_distance(labels: Labels, place: np.ndarray) -> float | None:
    """mm from a place (3) to the nearest voxel of muscle, which is the front of the chest wall; None if there is none."""
    k, j, i = np.nonzero(labels.tissue == TISSUES.index("muscle"))
    if not len(k):
        return None
    return float(np.sqrt(((labels.grid.to_patient(np.stack([i, j, k], -1)) - place) ** 2).sum(1).min()))


def in_view(image: Mammogram, state: State, name: str) -> str:
    """Where a landmark is in a view, from the nipple: "43 mm behind the nipple, 28 mm lateral"."""
    nipple, place = (image.project(state.landmark_position(landmark)[None])[0] for landmark in ("nipple", name))
    behind, upwards = nipple[0] - place[0], (place - nipple)[1] * (-1 if image.side == "left" else 1)
    words = ("lateral", "medial") if image.view == "CC" else ("above", "below")
    return f"{behind:.0f} mm behind the nipple, {abs(upwards):.0f} mm {words[int(upwards < 0)]}"


def facts_of_tumour(state: State, labels: Labels | None, scan: Grid | None) -> list[Fact]:
    """Of the tumour in the breast as scanned: rows of the page. `state` is any shape of the mesh."""
    name = state.landmark("tumour").name
    place, nipple = (state.landmark_position(landmark, "imaged") for landmark in (name, "nipple"))
    clock = clock_position(place - nipple)
    words = clock if "nipple" in clock else f"{clock}, {quadrant(place - nipple, state.side)}"
    facts = [Fact("clock", "Clock position", words, "facing the patient"),
             Fact("nipple_mm", "From the nipple", f"{np.linalg.norm(place - nipple):.0f} mm"),
             Fact("skin_mm", "From the skin", f"{state.distance_to('skin', place[None])[0]:.0f} mm")]
    walls = [wall_distance(labels, at) for at in (place, nipple)] if labels is not None else [None, None]
    if walls[0] is not None and walls[1]:
        facts.append(Fact("third", "Depth", f"{depth_third(walls[0], walls[1])} third",
                          f"{walls[0]:.0f} mm from the chest wall; the nipple {walls[1]:.0f} mm"))
    facts.append(Fact("position", "In the MR", patient_position(place), "DICOM patient coordinates of the scan"))
    if scan is not None:
        number, count, plane = slice_of(scan, place)
        facts.append(Fact("slice", "MR slice", f"{plane} {number} of {count}", f"slice 1 is the {first_slice(scan)}"))
    return facts


def facts_in_views(images: list[tuple[Mammogram, State]]) -> list[Fact]:
    """Where the tumour is in the views. The plates move tissue: what is above the nipple in the scan may be lateral of it in CC."""
    return [Fact(f"in_{image.view}", f"In {image.view}", in_view(image, compressed, "tumour")) for image, compressed in images]


def facts_of_patient(images: dict[str, PatientImage]) -> list[Fact]:
    """How well the patient's own mammograms fit the simulated ones, by view."""
    facts = []
    for view, image in images.items():
        facts.append(Fact(f"fit_{view}", f"Outline of {view}", f"{image.residual_mm:.1f} mm from the simulated one",
                          "root mean square after registration by rotation, shift and scale"))
        stated, simulated = image.thickness_mm
        if stated is not None and simulated is not None:
            facts.append(Fact(f"thickness_{view}", f"Thickness in {view}", f"{stated:.0f} mm", f"simulated: {simulated:.0f} mm"))
    return facts


def facts_of_breast(labels_report: StageReport, compressions: list[StageReport]) -> list[Fact]:
    """Volume, density and how the breast lies between the plates, as far as the reports say it."""
    facts = []
    volume, density = labels_report.number("breast_ml"), labels_report.number("density_percent")
    if volume is not None:
        facts.append(Fact("volume_ml", "Volume", f"{volume:.0f} ml"))
    if density is not None:
        facts.append(Fact("density", "Density", f"{density:.1f} % gland by volume; class {density_class(density)}",
                          "class by volumetric limits 4.5, 7.5 and 15.5 %, not by eye"))
    for report in compressions:
        thickness, force, angle = (report.number(key) for key in ("thickness_mm", "force_N", "angle_deg"))
        if None not in (thickness, force, angle):
            view = report.text("view")
            tilt = f", {angle:.0f} degrees" if view != "CC" else ""
            facts.append(Fact(f"plates_{view}", f"{view} compression", f"{thickness:.0f} mm thick, {force:.0f} N{tilt}",
                              "of the simulation"))
    return facts


def fact_of_views(run: Path) -> list[Fact]:
    """How much of the breast both views show, if both are compressions."""
    lines = nipple_lines(run)
    if not lines:
        return []
    return [Fact("nipple_lines", "Nipple to muscle or image edge", f"CC {lines[0]:.0f} mm, MLO {lines[1]:.0f} mm", "of the simulation")]
