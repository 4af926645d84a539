# SPDX-License-Identifier: GPL-3.0-or-later
"""The pictures of the pipeline, similar to Figs 4 to 7 of Pathmanathan et al. 2008: one module each.

A module has draw(inputs: Inputs) -> Picture (or Animation), which raises BreastError for input that the figure needs and was not given. It is
imported when its figure is drawn.
"""
from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .animation import Animation
    from .inputs import Inputs
    from .layout import Picture


@dataclass(frozen=True)
class Figure:
    """summary: its content and input, for the help. in_space: it shows surfaces, which need a display (PrivateDisplay). of_points:
    its .vtp are points instead of curves. package: where its module is."""

    summary: str
    in_space: bool = False
    of_points: bool = False
    package: str = __name__


FIGURES = {
    "slices": Figure("the scan in three planes with the contours of its segmentation (from --scan, --labels and a mesh .vtkhdf)"),
    "points": Figure("the data points of skin and chest wall (from points .vtp of segment)", True, True),
    "geometry": Figure("the Hermite sheets with patch lines and rim (from a geometry .vtkhdf and optionally points .vtp)", True, True),
    "mesh": Figure("the element edges of a mesh, front and back (from a mesh .vtkhdf)", True),
    "tissues": Figure("the fibroglandular region and the tumour through a translucent skin (from a mesh .vtkhdf)", True),
    "outlines": Figure("the superimposed shapes of the scan and other postures (from one or more deformed .vtkhdf)"),
    "postures": Figure("one slice of a breast in the prone scan, as predicted in a second posture, and as observed there (from a "
                       "deformed .vtkhdf and the .vtp of identify --seen)", of_points=True),
    "compression": Figure("the shapes between the plates (from one or two compressed .vtkhdf)", True),
    "pressure": Figure("the contact pressure of paddle and detector on the skin (from one or two compressed .vtkhdf)", True),
    "states": Figure("the equilibria on the way to a shape one after the other, with the ways of tumour and nipple and the tissue above "
                     "the tumour's CC pixel, as an animated PNG (from the .vtkhdf of a folder NAME-states of forward or compress, in their "
                     "order, and curve.vtp)", True),
    "force-thickness": Figure("the force of both plates during the compression (from a compressed .vtkhdf)"),
    "mammogram": Figure("the mammograms with axes in mm (from one or two .vti), optionally with curve, arc and tumour (from a curve "
                        ".vtp)"),
    "matching": Figure("the column of a CC point in the CC, stress-free and MLO shapes (from cc.vtkhdf and mlo.vtkhdf or one of "
                       "them, and a curve.vtp)", True),
    "summary": Figure("the whole chain (from mesh, reference, supine, cc and mlo .vtkhdf, cc.vti and mlo.vti, and optionally "
                      "curve.vtp, --scan and --labels)", True),
    "motion": Figure("how far tissue moves from prone to supine by its depth, beside living women (from a .tsv of population)"),
    "cost": Figure("error against run time (from the table .tsv of tabulate cost)"),
}
if find_spec("breast_validation"):  # in the source tree
    from breast_validation import figures
    FIGURES.update({name: Figure(summary, package=figures.__name__) for name, summary in figures.SUMMARIES.items()})


def draw(name: str, inputs: Inputs) -> Picture | Animation:
    """A figure by its name in FIGURES. One that shows surfaces needs a display."""
    return import_module(f".{name.replace('-', '_')}", FIGURES[name].package).draw(inputs)
