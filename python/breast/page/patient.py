# SPDX-License-Identifier: GPL-3.0-or-later
"""The patient's own mammograms, registered with the simulated views by cc2mlo: patient.json, patient-cc.png, patient-mlo.png of a run."""
from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..errors import BreastError
from ..study.stage_report import StageReport


@dataclass(frozen=True)
class PatientImage:
    """One image as it is hung, and where (u, v) of the simulated view lies in it.

    Attributes:
        picture: PNG file.
        pixel_mm: of the picture, in the breast.
        left: whether it shows a left breast, whose chest wall is at the left edge.
        matrix, shift: (2, 2) and (2): matrix @ (u, v) + shift is a place along the axes of the image, mm.
        corner: (2) of the picture's upper left corner along these axes, mm.
        deviation_mm: one standard deviation of that place, from how well the outlines fit.
        residual_mm: root mean square distance of the outlines.
        thickness_mm: between the plates (as the header states it, in the simulation); None where it is not stated.
    """

    picture: Path
    pixel_mm: float
    left: bool
    matrix: np.ndarray
    shift: np.ndarray
    corner: np.ndarray
    deviation_mm: float
    residual_mm: float
    thickness_mm: tuple[float | None, float | None]

    def put(self, uv: np.ndarray) -> np.ndarray:
        """Places (n, 2) in the picture, mm from its upper left corner, of (u, v) (n, 2) in the simulated view."""
        along = np.asarray(uv, float) @ self.matrix.T + self.shift
        return along - self.corner if self.left else self.corner - along


def read_patient(run: Path, view: str, side: str) -> PatientImage | None:
    """The patient's image of a view (CC, MLO or ML); None where the run has none.

    Raises BreastError for a report that says nothing of it.
    """
    picture, file = run / f"patient-{'cc' if view == 'CC' else 'mlo'}.png", run / "patient.json"
    if not picture.exists() or not file.exists():
        return None
    report, key = StageReport.read(file), f"aligned/{view}/"
    scale, turned, pixel, deviation, residual = (report.number(key + name) for name in (
        "scale", "rotation_deg", "hung/pixel_mm", "deviation_mm", "residual_mm"))
    shift, corner = (report.find(key + name) for name in ("shift_mm", "hung/corner_mm"))
    if None in (scale, turned, pixel, deviation, residual, shift, corner):
        raise BreastError(f"does not say where the {view} image lies", file, "run cc2mlo again with --cc-hung and --mlo-hung")
    angle = np.radians(turned)
    matrix = scale * np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    return PatientImage(picture, pixel, side == "left", matrix, np.array(shift, float), np.array(corner, float), deviation, residual,
                        (report.number(key + "header/thickness_mm"), report.number(key + "simulated/thickness_mm")))
