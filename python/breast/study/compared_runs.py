# SPDX-License-Identifier: GPL-3.0-or-later
"""What two runs predict, side by side: landmarks, views, the breast, the curve, and in what their models differ."""
from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import astuple, dataclass, fields
from functools import cached_property, partial
from pathlib import Path

from ..cases.compression import VIEWS
from ..errors import BreastError
from .compared_model import STAGES, differences, scan_of
from .curve_distance import curve_distance
from .stage_report import StageReport
from .table import NO_VALUE, Table, fixed, or_dash

TOPICS = {"landmarks": "Where the landmarks are", "views": "Compressed views", "breast": "The breast",
          "curve": "The curve in the second view", "model": "What differs in settings and model"}


@dataclass(frozen=True)
class Row:
    """One quantity of both runs as text; "-" where a run has no value.

    difference: second minus first, or the distance between two places. first_error, second_error: estimates of the discretisation
    error as each run reports them.
    """

    topic: str
    quantity: str
    unit: str
    first: str
    second: str
    difference: str = NO_VALUE
    first_error: str = NO_VALUE
    second_error: str = NO_VALUE


@dataclass(frozen=True)
class _Number:
    quantity: str
    unit: str
    key: str
    decimals: int


_OF_VIEW = (_Number("thickness", "mm", "thickness_mm", 1), _Number("reduction of thickness", "%", "reduction_percent", 1),
            _Number("force of the paddle", "N", "force_N", 1), _Number("force of the detector", "N", "detector_force_N", 1),
            _Number("mean pressure", "kPa", "pressure_kPa", 2), _Number("contact area of the paddle", "cm2", "area_cm2", 1),
            _Number("projection of the breast in the image", "cm2", "coverage/projected_cm2", 1),
            _Number("volume in the image", "%", "coverage/volume_percent", 1),
            _Number("nipple to the edge of the image", "mm", "coverage/nipple_in_front_mm", 1),
            _Number("nipple to the muscle", "mm", "coverage/nipple_to_muscle_mm", 1))
_OF_LABELS = (_Number("volume", "ml", "breast_ml", 0), _Number("fat", "ml", "volumes_ml/fat", 0),
              _Number("fibroglandular tissue", "ml", "volumes_ml/fibroglandular", 1),
              _Number("density by volume", "%", "density_percent", 1), _Number("skin thickness", "mm", "skin_thickness_mm", 2))
_OF_MESH = (_Number("volume of the mesh", "ml", "volume_ml", 0), _Number("least scaled Jacobian of the mesh", "", "min_scaled_jacobian", 3))
_PLACES = {"mesh": ("imaged", "in the scan"), "reference": ("position", "stress-free"), "supine": ("position", "supine"),
           "cc": ("position", "in CC"), "mlo": ("position", "in MLO"), "ml": ("position", "in ML")}
_IMAGES = {"cc-mammogram": "on the CC image", "mlo-mammogram": "on the MLO image", "ml-mammogram": "on the ML image"}


class Pair:
    """Two run folders. Raises BreastError for folders that hold no reports, or nothing that both have.

    Attributes:
        first, second: the folders.
        remarks: sentences on what is not compared, and why.
    """

    def __init__(self, first: Path, second: Path) -> None:
        self.first, self.second = first, second
        self.remarks: list[str] = []
        self._reports = {stage: tuple(StageReport.read(run / f"{stage}.json") for run in (first, second)) for stage in STAGES}
        for n, run in enumerate((first, second)):
            if not any(both[n] for both in self._reports.values()):
                raise BreastError("holds no report of a stage (labels.json, mesh.json, cc.json ...)", run, "give the folder of a run")
        self._same_place = self._of_one_place()

    @cached_property
    def rows(self) -> list[Row]:
        """Every quantity that both runs have, and what differs in the model."""
        makers: tuple[Callable[[], Iterator[Row]], ...] = (self._landmarks, self._curve) if self._same_place else ()
        rows = [row for make in (*makers, self._views, self._breast) for row in make()]
        if not rows:
            raise BreastError(f"nothing can be compared with {self.second}: no stage of the chain is in both", self.first)
        rows += [Row("model", what, "", a, b) for what, a, b in differences(self.first, self.second)]
        return sorted(rows, key=lambda row: list(TOPICS).index(row.topic))

    def of_topic(self, topic: str) -> list[Row]:
        return [row for row in self.rows if row.topic == topic]

    def table(self) -> Table:
        """All rows, as compare.tsv has them."""
        return Table([field.name for field in fields(Row)], [[or_dash(cell) for cell in astuple(row)] for row in self.rows])

    def names(self) -> tuple[str, str]:
        """Names of the folders, with those above where they are equal."""
        a, b = self.first.resolve().parts, self.second.resolve().parts
        count = next((n for n in range(1, max(len(a), len(b)) + 1) if a[-n:] != b[-n:]), 1)
        return "/".join(a[-count:]), "/".join(b[-count:])

    def _of_one_place(self) -> bool:
        """Whether places of both runs are in one frame; a remark says why not, or that it is not known."""
        sides = [next((side for both in self._reports.values() if (side := both[n].text("side"))), "") for n in (0, 1)]
        if all(sides) and sides[0] != sides[1]:
            self.remarks.append(f"the first run is of the {sides[0]} breast and the second of the {sides[1]}: places and curves are not "
                                "compared")
            return False
        scans = scan_of(self.first), scan_of(self.second)
        if scans[0] is None or scans[1] is None:
            self.remarks.append("not every run records its scan: places are compared as if both runs were of one scan")
        elif scans[0][1] != scans[1][1]:
            a, b = scans[0][0], scans[1][0]
            named = f"both named {a}" if a == b else f"{a} and {b}"
            self.remarks.append(f"the runs are of different scans, {named}: places and curves are not compared")
            return False
        return True

    def _both(self, stage: str) -> tuple[StageReport, StageReport] | None:
        first, second = self._reports[stage]
        return (first, second) if first and second else None

    def _landmarks(self) -> Iterator[Row]:
        """Where the landmarks are in the shapes and, of those that everybody looks for, on the images."""
        known = self._reports["mesh"][0].find("landmarks")
        others = [name for name in known if name not in ("nipple", "tumour", "artificial_tumour")] if isinstance(known, dict) else []
        for landmark in ("nipple", "tumour", *others):
            for stage, (key, where) in _PLACES.items():
                yield from self._at(landmark, stage, where, partial(StageReport.place, landmark=landmark, what=key))
        for stage, where in _IMAGES.items():
            for landmark in ("nipple", "tumour"):
                yield from self._at(landmark, stage, where, partial(_on_image, landmark=landmark))

    def _at(self, landmark: str, stage: str, where: str, place_in: Callable[[StageReport], tuple[float, ...] | None]) -> Iterator[Row]:
        both = self._both(stage)
        a, b = map(place_in, both) if both else (None, None)
        if both and a and b:
            errors = [fixed(report.number(f"landmarks/{report.landmark(landmark)}/error_estimate_mm"), 2) for report in both]
            yield Row("landmarks", f"{_called(landmark, both)} {where}", "mm", _place(a), _place(b), fixed(math.dist(a, b), 2), *errors)

    def _numbers(self, topic: str, stage: str, numbers: tuple[_Number, ...], prefix: str = "") -> Iterator[Row]:
        both = self._both(stage)
        for number in numbers if both else ():
            a, b = (report.number(number.key) for report in both or ())
            if a is not None and b is not None:
                yield Row(topic, prefix + number.quantity, number.unit, fixed(a, number.decimals), fixed(b, number.decimals),
                          _signed(b - a, number.decimals))

    def _views(self) -> Iterator[Row]:
        for view in (*VIEWS, "ml"):
            both, name = self._both(view), STAGES[view]
            if both:
                yield Row("views", f"{name}: status", "", *(report.text("status") or NO_VALUE for report in both))
            yield from self._numbers("views", view, _OF_VIEW, f"{name}: ")

    def _breast(self) -> Iterator[Row]:
        yield from self._numbers("breast", "labels", _OF_LABELS)
        yield from self._numbers("breast", "mesh", _OF_MESH)

    def _curve(self) -> Iterator[Row]:
        yield from self._numbers("curve", "curve", (_Number("length", "mm", "curve_mm", 1), ))
        files = self.first / "curve.vtp", self.second / "curve.vtp"
        if not all(file.exists() for file in files):
            return
        try:
            mean, largest = curve_distance(files[1], files[0])
        except BreastError as error:
            self.remarks.append(f"the curves are not compared: {error}")
            return
        yield Row("curve", "mean distance between both curves", "mm", NO_VALUE, NO_VALUE, fixed(mean, 2))
        yield Row("curve", "largest distance between both curves", "mm", NO_VALUE, NO_VALUE, fixed(largest, 2))


def _called(landmark: str, both: tuple[StageReport, StageReport]) -> str:
    """What a landmark is in both runs: "artificial tumour", or "artificial tumour and tumour" where they do not have the same."""
    return " and ".join(dict.fromkeys(report.landmark(landmark).replace("_", " ") for report in both))


def _place(place: tuple[float, ...]) -> str:
    return " ".join(fixed(x, 1) for x in place)


def _on_image(report: StageReport, landmark: str) -> tuple[float, ...] | None:
    """u and v, mm."""
    entry = report.find(f"landmarks/{report.landmark(landmark)}/uv_mm")
    numbers = [float(x) for x in entry if isinstance(x, (int, float))] if isinstance(entry, list) else []
    return tuple(numbers) if len(numbers) == 2 else None


def _signed(value: float, decimals: int) -> str:
    return fixed(0.0, decimals) if round(value, decimals) == 0 else f"{value:+.{decimals}f}"
