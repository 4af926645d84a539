# SPDX-License-Identifier: GPL-3.0-or-later
"""The pictures of a run: which figure shows which of its files."""
from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass


@dataclass(frozen=True)
class RunPicture:
    """A picture by its name, the figure it is, and the run's files it shows; of `also` those that there are."""

    name: str
    figure: str
    files: tuple[str, ...]
    also: tuple[str, ...] = ()
    scan: bool = False


_CURVE = ("curve.vtp",)
PICTURES = (
    RunPicture("slices", "slices", ("mesh.vtkhdf", "labels.vtkhdf"), scan=True),
    RunPicture("points", "points", ("points.vtp",)),
    RunPicture("geometry", "geometry", ("geometry.vtkhdf",)),
    RunPicture("mesh", "mesh", ("mesh.vtkhdf",)),
    RunPicture("tissues", "tissues", ("mesh.vtkhdf",)),
    RunPicture("outlines", "outlines", ("reference.vtkhdf", "supine.vtkhdf")),
    RunPicture("cc-compression", "compression", ("cc.vtkhdf",)),
    RunPicture("mlo-compression", "compression", ("mlo.vtkhdf",)),
    RunPicture("pressure", "pressure", ("cc.vtkhdf", "mlo.vtkhdf")),
    RunPicture("force-thickness", "force-thickness", ("cc.vtkhdf", "mlo.vtkhdf")),
    RunPicture("cc-mammogram", "mammogram", ("cc.vti",), _CURVE),
    RunPicture("mlo-mammogram", "mammogram", ("mlo.vti",), _CURVE),
    RunPicture("cc-matching", "matching", ("cc.vtkhdf", "curve.vtp")),
    RunPicture("mlo-matching", "matching", ("mlo.vtkhdf", "curve.vtp")),
    RunPicture("cc-points", "mammogram", ("cc.vti", "curves.vtp")),
    RunPicture("mlo-curves", "mammogram", ("mlo.vti", "curves.vtp")),
    RunPicture("summary", "summary", ("mesh.vtkhdf", "reference.vtkhdf", "supine.vtkhdf", "cc.vtkhdf", "mlo.vtkhdf",
                                      "labels.vtkhdf"), ("cc.vti", "mlo.vti", *_CURVE), scan=True),
)


def pictures_of(files: Iterable[str], scan: bool) -> list[RunPicture]:
    """Those that these files of a run allow, with or without its scan."""
    there = set(files)
    return [p for p in PICTURES if there.issuperset(p.files) and (scan or not p.scan)]
