# SPDX-License-Identifier: GPL-3.0-or-later
"""Landmarks in the files of shapes, and distances between them.

All distances are mm and rounded to the 4 decimals of the tables of probe, so that every table of a study states the same number.
"""
from __future__ import annotations

import math
from functools import lru_cache
from pathlib import Path

from ..errors import BreastError
from .stage_report import Place

Shape = dict[str, tuple[Place, Place]]
"""Imaged position and position of every landmark, LPS mm."""


@lru_cache(maxsize=None)
def read_shape(file: Path) -> Shape:
    """The landmarks of a mesh file; read once a run of the program."""
    from ..state_file import read_landmark_places

    return read_landmark_places(file)


def find_landmark(shape: Shape, name: str, file: Path) -> tuple[Place, Place]:
    """A landmark; "tumour" also finds an artificial one. Raises BreastError naming the file if it has none."""
    for wanted in (name, "artificial_" + name):
        if wanted in shape:
            return shape[wanted]
    raise BreastError(f"has no landmark '{name}'", file)


def moved(file: Path, landmark: str) -> float:
    """Distance from a landmark's imaged position to its position in this shape."""
    imaged, position = find_landmark(read_shape(file), landmark, file)
    return _as_probed(math.dist(imaged, position))


def apart(file: Path, base: Path, landmark: str) -> float:
    """Distance between a landmark's positions in two shapes."""
    here, there = (find_landmark(read_shape(f), landmark, f)[1] for f in (file, base))
    return _as_probed(math.dist(here, there))


def most_apart(file: Path, base: Path) -> float:
    """The largest of these distances over all landmarks of the first shape."""
    return max((apart(file, base, landmark) for landmark in read_shape(file)), default=0.0)


def _as_probed(mm: float) -> float:
    return float(f"{mm:.4f}")
