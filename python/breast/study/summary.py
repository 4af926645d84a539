# SPDX-License-Identifier: GPL-3.0-or-later
"""The results of a finished case as text for a terminal."""
from __future__ import annotations

import textwrap
from pathlib import Path

from ..cases.compression import views_without_compression
from ..text_table import read_text
from .advice import Warned, own_advice, warnings_of
from .findings import calibration_note
from .kinds import Request, kind
from .stage_report import StageReport
from .table import fixed
from .views import NIPPLE_LINES_DIFFER_MM, nipple_lines


def tumour_origin(mesh: StageReport) -> str:
    """The origin of a mesh's tumour as hexmesh reports it: "none", "artificial" or "given"."""
    tumour = mesh.text("tumour")
    return "none" if not tumour else "artificial" if tumour.startswith("artificial") else "given"


def aligned(tsv: str) -> str:
    """Tab-separated text as columns of equal width, each preceded by two blanks; comments are omitted."""
    rows = [line.split("\t") if line else [] for line in lines_of(tsv) if not line.startswith("#")]
    widths = [max(len(row[c]) for row in rows if c < len(row)) for c in range(max(map(len, rows), default=0))]
    return "".join("".join("  " + cell.ljust(width) for cell, width in zip(row, widths)).rstrip(" ") + "\n" for row in rows)


def folded(text: str, width: int) -> str:
    """The text in lines of at most `width` characters, broken at blanks if there are any."""
    return textwrap.fill(text, width, break_on_hyphens=False) + "\n"


def lines_of(text: str) -> list[str]:
    """The lines of a file; the last need not end with a line break."""
    return text.removesuffix("\n").split("\n") if text else []


def some_rows(tsv: str, names: tuple[str, ...]) -> str:
    """The header and the rows that begin with these names."""
    return "".join(line + "\n" for n, line in enumerate(lines_of(tsv)) if n == 0 or line.startswith(names))


def summary_text(run: Path, warned: list[Warned], phantom: Path | None, note: str) -> str:
    """Warnings; landmark displacements; errors against the truth, if there is one; compressions; the MLO curve; pictures.

    Args:
        phantom: report of the phantom, for the error of the truth.
        note: a sentence beside the rows that were fitted to the paper's; may be empty.
    """
    failed = "".join(folded(f"NOT DONE: {line}. No mammogram and no curve are made of it.", 118) for line in views_without_compression(run))
    parts = [f"== {run}\n\n", failed, _warnings_text(warned), "\n", _tumour_text(StageReport.read(run / "mesh.json")),
             "\nLandmark displacements (mm)\n", aligned(_text_of(run / "displacements.tsv"))]
    if note:
        parts.append("  supine: " + "  ".join(line + "\n" for line in lines_of(folded(note, 118))))
    if cut := _text_of(run / "cut.tsv"):
        parts.append("\nWith a fixed lateral cut instead, supine (relative: distance to the case as solved, mm)\n" + aligned(cut))
    return "".join([*parts, _truth_text(run, phantom), _compression_text(run), "\n", _curve_text(run), _pictures_text(run)])


def _text_of(file: Path) -> str:
    return read_text(file) if file.exists() else ""


def _warnings_text(warned: list[Warned]) -> str:
    if not warned:
        return "There were no warnings.\n"
    lines = [f"  {w.stages}: {w.text}\n" + (f"    -> {w.remedy}\n" if w.remedy else "") for w in warned]
    return f"Warnings: {len(warned)}; read these first\n" + "".join(lines)


def _tumour_text(mesh: StageReport) -> str:
    return {"none": "No tumour in this case (TUMOUR=x,y,z follows one).\n",
            "artificial": "THE TUMOUR IS ARTIFICIAL: it was not found in the scan.\n",
            "given": f"Tumour: {mesh.text('tumour')}.\n"}[tumour_origin(mesh)]


def _truth_text(run: Path, phantom: Path | None) -> str:
    text = ""
    if truth := _text_of(run / "truth.tsv"):
        own = StageReport.read(phantom).number("error_estimate_mm") if phantom else None
        text += ("\nError against the phantom's truth (mm). The truth's own error is "
                 f"{fixed(own, 3)} mm; smaller errors are not\nclaimed. Points are the phantom's, found in the chain's mesh; "
                 "truth.tsv has every one of them.\n" + aligned(some_rows(truth, ("nipple", "true-tumour", "mean", "largest"))))
    if truth := _text_of(run / "truth-cut-fixed.tsv"):
        text += ("\nThe same with a fixed cut in the chain, as in the truth (mean and largest)\n" +
                 aligned(some_rows(truth, ("mean", "largest"))))
    return text


def _compression_text(run: Path) -> str:
    text = "\nCompression\n"
    for name in ("CC", "MLO"):
        report = StageReport.read(run / f"{name.lower()}.json")
        values = [fixed(report.number(key), 1) for key in
                  ("thickness_mm", "reduction_percent", "force_N", "detector_force_N", "pressure_kPa")]
        text += "  {:<4}thickness {} mm, reduction {} %, paddle {} N, detector {} N, mean pressure {} kPa, status {}\n".format(
            name, *values, report.text("status"))
    lines = nipple_lines(run)
    if lines:
        # The difference of the lengths as they are printed.
        text += (f"  nipple line: CC {lines[0]:.0f} mm, MLO {lines[1]:.0f} mm to the muscle or the image edge; they differ by "
                 f"{abs(round(lines[0]) - round(lines[1]))} mm (clinics accept {NIPPLE_LINES_DIFFER_MM})\n")
    return text


def _curve_text(run: Path) -> str:
    said = ""
    if views_without_compression(run):
        said = "No curve: one of the views is no compression.\n"
    elif _text_of(run / "curve.tsv"):
        said = f"CC point to MLO curve: {run}/curve.tsv, in ParaView {run}/curve.vtp\n"
    if (run / "page.html").exists():
        curves = "" if views_without_compression(run) else f"; curves of every CC and MLO point: {run}/lookup.h5"
        said += f"The page to read: {run}/page.html (a browser opens it){curves}\n"
    return said


def _pictures_text(run: Path) -> str:
    """The slices of the scan come first, because everything else is made from them."""
    names = sorted((file.name for file in run.glob("figures/*.png")), key=lambda name: (name != "slices.png", name))
    return f"Pictures: {run}/figures/\n" + "".join(f"  {run}/figures/{name}\n" for name in names)


@kind("summary", "RUN [PHANTOM.json]", "results of a finished case as text, preceded by its warnings")
def _summary(request: Request) -> str:
    run, phantom = request.path(0), request.path(1) if len(request.words) > 1 else None
    return summary_text(run, warnings_of(run, own_advice(request)), phantom, calibration_note(request.calibrated, request.side))
