# SPDX-License-Identifier: GPL-3.0-or-later
"""What `breast run` finds for itself beside a scan: the series of a Dixon examination, a file of the tumour, and the tumour's side."""
from __future__ import annotations

import os
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ..errors import BreastError
from ..text_table import number_in, parse_table
from .child import capture_child
from .installation import Installation

SIDES = ("left", "right")
TUMOUR_ENDINGS = (".mrk.json", ".fcsv", ".tsv", ".seg.nrrd", ".nrrd", ".nii", ".nii.gz", ".mha")
_SCAN_ENDINGS = (".nii.gz", ".nii", ".nrrd", ".nhdr", ".mha", ".mhd")
TUMOUR_RULE = "SCAN-tumour.ENDING or SCAN-tumour-left.ENDING, with the scan's own name and one of the endings " + " ".join(TUMOUR_ENDINGS)


@dataclass
class Series:
    """What the series of a DICOM folder show. sides: the breasts for which one can be taken; taken: its number and contrast, by side;
    fat: the number of the fat image that belongs to a water image, by side."""

    sides: tuple[str, ...]
    taken: dict[str, str] = field(default_factory=dict)
    fat: dict[str, int] = field(default_factory=dict)


def series_of(installation: Installation, folder: str) -> Series:
    """The series that `segment` would take, as `scan --list` states them. A folder that it refuses shows both sides: the first stage
    then says what is wrong with it."""
    series = Series(())
    for side in SIDES:
        listed = capture_child([installation.tool("scan"), folder, "--list", "--side", side, "--quiet"])
        if listed.exit_code != 0:
            return Series(SIDES)
        rows = parse_table(listed.out, folder).records()
        taken = next((row for row in rows if row["use"] == "taken"), None)
        if taken is None:
            if any(not row["use"].startswith("no") for row in rows):  # several are equally good: the stage asks for a number
                series.sides += (side,)
            continue
        series.sides += (side,)
        series.taken[side] = f"series {taken['series']} ({taken['contrast']}) of {len(rows)}"
        same = [row for row in rows if row["contrast"] == "fat" and
                all(row[key] == taken[key] for key in ("images", "pixels", "voxel_mm", "sides"))]
        if taken["contrast"] == "water" and len(same) == 1:
            series.fat[side] = int(same[0]["series"])
    return series


def own_name(scan: str) -> str:
    """The name of a scan without its folder and ending."""
    name = os.path.basename(os.path.abspath(scan))
    return next((name[:-len(ending)] for ending in _SCAN_ENDINGS if name.lower().endswith(ending)), name)


def tumour_beside(scan: str) -> dict[str, str]:
    """The files beside a scan that name its tumour (TUMOUR_RULE), by side; "" for one without a side in its name.

    Raises BreastError if two files are for the same side.
    """
    folder, own = os.path.dirname(os.path.abspath(scan)), own_name(scan)
    found: dict[str, str] = {}
    for entry in sorted(os.listdir(folder)):
        for side in ("", *SIDES):
            stems = [f"{own}-{word}{'-' + side if side else ''}" for word in ("tumour", "tumor")]
            if not any(entry == stem + ending for stem in stems for ending in TUMOUR_ENDINGS):
                continue
            if side in found:
                raise BreastError(f"'{found[side]}' and '{entry}' both name the tumour of {os.path.basename(scan)}: remove one, or give "
                                  "TUMOUR=FILE or TUMOUR=none")
            found[side] = os.path.join(os.path.dirname(scan.rstrip("/")), entry)
    return found


def _voxels_of_tumour(path: Path) -> np.ndarray:
    from ..loading import load
    from ..segmentation import Segmentation
    from ..state import TISSUES
    labels = load(path)
    if isinstance(labels, Segmentation):
        names = [name for name in labels.values if "tumour" in name.lower() or "tumor" in name.lower()]
        mask = labels.mask(names[0]) if names else labels.labels > 0
    else:
        mask = labels.voxels == TISSUES.index("tumour")
    k, j, i = np.nonzero(mask)
    if not len(k):
        raise BreastError("has no tumour voxel", path)
    return labels.grid.to_patient(np.stack([i, j, k], -1))


def tumour_position(given: str) -> np.ndarray:
    """The middle (3), LPS mm, of what a value of TUMOUR names: x,y,z[:radius] or a file. Raises BreastError if it names no place."""
    path = Path(given)
    if not path.exists():
        numbers = [number_in(part) for part in given.partition(":")[0].split(",")]
        if len(numbers) != 3 or None in numbers:
            raise BreastError(f"TUMOUR={given}: is neither x,y,z[:radius] nor a file")
        return np.array(numbers, float)
    if path.name.endswith((".mrk.json", ".fcsv")):
        from ..loading import load
        marks = list(load(path).values())
        named = [m.point("tumour") for m in marks if "tumour" in m.labels]
        points = np.array(named) if named else np.concatenate([m.points for m in marks])
    elif path.name.endswith(".tsv"):
        from ..text_table import read_table
        table = read_table(path)
        points = np.array([[table.number(row, f"{axis}_mm") for axis in "xyz"] for row in range(len(table.rows))])
    else:
        points = _voxels_of_tumour(path)
    if not len(points):
        raise BreastError("names no point", path)
    return points.mean(0)


def side_of(place: np.ndarray, nipples: dict[str, np.ndarray]) -> str:
    """The side whose nipple is nearest to a place."""
    return min(nipples, key=lambda side: float(np.linalg.norm(nipples[side] - place)))
