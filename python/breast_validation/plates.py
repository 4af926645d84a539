# SPDX-License-Identifier: GPL-3.0-or-later
"""Breasts between plates: the reports of compress beside each other."""
from __future__ import annotations

from pathlib import Path

from breast.study.kinds import Request, kind
from breast.study.shapes import apart
from breast.study.stage_report import StageReport
from breast.study.table import NO_VALUE, Table, fixed, one_line, or_dash

Columns = tuple[tuple[str, str, int], ...]
"""Name, key of the report, decimals."""
_BREAST: Columns = (("turn_deg", "turn_deg", 1), ("T0_mm", "initial_thickness_mm", 1), ("T_mm", "thickness_mm", 1))
_PRESS: Columns = (("paddle_N", "force_N", 1), ("detector_N", "detector_force_N", 1), ("area_cm2", "area_cm2", 1),
                   ("mean_pressure_kPa", "pressure_kPa", 1))
_SOLUTION: Columns = (("worst_gap_mm", "worst_gap_mm", 3), ("min_scaled_jacobian", "min_scaled_jacobian", 3),
                      ("iterations", "newton_iterations", 0), ("cpu_seconds", "cpu_seconds", 0))
_COVERAGE: Columns = (("volume_in_front_percent", "coverage/volume_percent", 1),
                      ("gland_in_front_percent", "coverage/fibroglandular_percent", 1),
                      ("thrust_into_wall_N", "thrust_into_wall_N", 1))
_PRESS_COLUMNS = [*(c[0] for c in _PRESS), "paddle_behind_edge_percent", "detector_behind_edge_percent", *(c[0] for c in _SOLUTION)]


def compressions_table(reports: list[Path]) -> Table:
    """One row a report CASE/VIEW.json of `compress`, named by its folder: thickness in mm, forces in N, area in cm2, pressure in kPa,
    shares of force, volume and gland in per cent."""
    table = Table(["breast", "view", "status", *(c[0] for c in _BREAST), *_PRESS_COLUMNS, *(c[0] for c in _COVERAGE)])
    for file in reports:
        report = StageReport.read(file)
        table.rows.append([file.parent.name, report.text("view") or file.stem, or_dash(one_line(report.text("status"))),
                           *_cells(_BREAST, report), *_press_cells(report), *_cells(_COVERAGE, report)])
    return table


def plates_table(folder: Path, base: str, variants: list[str]) -> Table:
    """One row a view (cc, mlo) and variant FOLDER/VARIANT that has a report of the view.

    tumour_mm and nipple_mm are the distances of these landmarks from their positions in the variant `base`, or in the next variant
    of the list if `base` is "next"; "-" where either has no shape.
    """
    table = Table(["view", "variant", "elements", *_PRESS_COLUMNS, "tumour_mm", "nipple_mm"])
    for view in ("cc", "mlo"):
        for k, variant in enumerate(variants):
            report = StageReport.read(folder / variant / f"{view}.json")
            if not report:
                continue
            other = variants[min(k + 1, len(variants) - 1)] if base == "next" else base
            here, there = (folder / name / f"{view}.vtkhdf" for name in (variant, other))
            both = other != variant and here.exists() and there.exists()
            table.rows.append([report.text("view") or view, variant, fixed(report.number("elements"), 0), *_press_cells(report),
                               *(fixed(apart(here, there, name), 2) if both else NO_VALUE for name in ("tumour", "nipple"))])
    return table


def _cells(columns: Columns, report: StageReport) -> list[str]:
    return [fixed(report.number(key), decimals) for _, key, decimals in columns]


def _press_cells(report: StageReport) -> list[str]:
    return [*_cells(_PRESS, report), *(_behind_edge(report, plate) for plate in ("paddle", "detector")), *_cells(_SOLUTION, report)]


def _behind_edge(report: StageReport, plate: str) -> str:
    """The part of a plate's force that acts behind the edge of the image, in per cent."""
    behind, whole = (report.number(f"plates/{plate}/{key}") for key in ("force_behind_edge_N", "force_N"))
    return NO_VALUE if behind is None or whole is None or whole <= 0 else fixed(100 * behind / whole, 1)


@kind("compressions", "REPORT.json...",
      "breasts between plates, one row per report of compress: forces, pressure, coverage and penetration")
def _compressions(request: Request) -> Table:
    return compressions_table(list(map(Path, request.words)))


@kind("plates", "FOLDER BASE|next VARIANT...",
      "the same for variants of one compression, FOLDER/VARIANT/{cc,mlo}, with the distances of tumour and nipple from those of the "
      "variant BASE or of the next one")
def _plates(request: Request) -> Table:
    return plates_table(request.path(0), request.word(1), request.rest(2))
