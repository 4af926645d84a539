# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of the cases of a cohort: the result of each case, what should be checked, and the cost."""
from __future__ import annotations

import os
import subprocess
from dataclasses import dataclass
from pathlib import Path

from ..cases.cohort import listed_cases
from ..errors import Failed
from ..output import write_text
from ..text_table import read_text
from .advice import Advice, own_advice, warnings_of
from .kinds import Request, kind
from .stage_report import StageReport
from .summary import tumour_origin
from .table import NO_VALUE, Table, fixed, number_of, one_line, or_dash, read_table, table_if_any


@dataclass(frozen=True)
class Case:
    """A case: the name of its folder in the folder of the cohort; status done or failed; reason of a failure."""

    name: str
    status: str
    reason: str


def read_cases(runs: Path) -> list[Case]:
    """Reads RUNS/.cases (one line a case: name, file and kind) and RUNS/CASE.status: "done", or "failed" with the reason. "running"
    and a missing status count as failures."""
    cases = []
    for listed in listed_cases(runs / ".cases"):
        file, status, reason = listed.status(runs), "failed", "never started"
        if file.is_file():
            status, _, reason = read_text(file).partition("\n")[0].partition("\t")
        if status == "running":
            status = "failed"
            reason = "ended without a message: it was killed, ran out of memory, lost its node, or is still running"
        cases.append(Case(listed.name, status, one_line(reason)))
    return cases


def far_motion(motion: Table, women: Table) -> str:
    """The first quantity that is more than two standard deviations from the mean of living women, and the number of the others."""
    far = []
    for row in motion:
        for column, cell in row.items():
            value, mean, sd = number_of(cell), women.number_at(column, "mean"), women.number_at(column, "sd")
            if None not in (value, mean, sd) and sd > 0 and abs(value - mean) > 2 * sd:
                far.append(f"{column} {cell} (women {women.at(column, 'mean')}, sd {women.at(column, 'sd')})")
    return far[0] + (f" and {len(far) - 1} more" if len(far) > 1 else "") if far else ""


def looks(run: Path, advice: list[Advice], women: Table) -> list[str]:
    """What should be checked in a case, finished or interrupted: warnings, quality scores of segment below 0.5, poor elements, views
    that did not converge, and motion (motion.tsv) far from that of living women."""
    warned = len(warnings_of(run, advice))
    said = [f"{warned} warnings"] if warned else []
    labels = StageReport.read(run / "labels.json")
    for part in ("contrast", "wall", "extent", "tissue"):
        grade = labels.number(f"quality/{part}")
        if grade is not None and grade < 0.5:
            said.append(f"quality of {part} {grade:.2f}")
    shape = StageReport.read(run / "mesh.json").number("min_scaled_jacobian")
    if shape is not None and shape < 0.1:
        said.append(f"element shape {shape:.2f}")
    for view in ("cc", "mlo"):
        report = StageReport.read(run / f"{view}.json")
        if report and report.text("status") != "converged":
            said.append(f"{view.upper()} {one_line(report.text('status'))}")
    motion = table_if_any(run / "motion.tsv")
    far = far_motion(motion, women) if motion else ""
    return [*said, far] if far else said


def cohort_table(runs: Path, cases: list[Case], advice: list[Advice], women: Table) -> Table:
    """One row a case, failures first."""
    table = Table(["case", "status", "volume_ml", "min_scaled_jacobian", "supine_nipple_mm", "supine_tumour_mm", "tumour",
                   "cc_thickness_mm", "cc_force_N", "mlo_thickness_mm", "mlo_force_N", "look", "log", "reason"])
    for case in sorted(cases, key=lambda case: case.status == "done"):
        run = runs / case.name
        mesh, cc, mlo = (StageReport.read(run / f"{stage}.json") for stage in ("mesh", "cc", "mlo"))
        displacements = table_if_any(run / "displacements.tsv")
        moved = [or_dash(displacements.at("supine.vtkhdf", c)) if displacements else NO_VALUE for c in ("nipple_mm", "tumour_mm")]
        table.rows.append([
            case.name, case.status, fixed(mesh.number("volume_ml"), 0), fixed(mesh.number("min_scaled_jacobian"), 2), *moved,
            tumour_origin(mesh), *(fixed(view.number(key), 1) for view in (cc, mlo) for key in ("thickness_mm", "force_N")),
            or_dash("; ".join(looks(run, advice, women))), f"{case.name}.log", or_dash(case.reason)])
    return table


def cohort_cost(runs: Path, cases: list[Case]) -> Table:
    """The cost of the stages of every case, each from its last run."""
    table = Table(["case", "elements", "wall_seconds", "cpu_seconds", "peak_mb"])
    for case in cases:
        reports = [StageReport.read(file) for file in sorted((runs / case.name).glob("*.json"))]
        elements = next(filter(None, (report.first("elements") for report in reports)), 0.0)
        wall, cpu = (sum(report.number(key) or 0 for report in reports) for key in ("seconds/total", "cpu_seconds"))
        peak = max((report.number("peak_mb") or 0 for report in reports), default=0.0)
        table.rows.append([case.name, *(fixed(value, 0) for value in (elements, wall, cpu, peak))])
    return table


def _measure_motion(run: Path, population: str) -> bool:
    """Tabulates the motion of a case's tissue if its mesh has a chest wall to measure from, again if the supine shape is newer.
    Returns whether there is one."""
    supine, motion = run / "supine.vtkhdf", run / "motion.tsv"
    if supine.exists() and motion.exists() and motion.stat().st_mtime_ns > supine.stat().st_mtime_ns:
        return True
    words = [population, supine, "--table", motion, "--quiet"]
    if not supine.exists() or subprocess.run(words, capture_output=True, check=False).returncode != 0:
        motion.unlink(missing_ok=True)
    return motion.exists()


@kind("cohort", "RUNS POPULATION",
      "table of all cases in RUNS/.cases, which is also printed; beside it cost.tsv, motion.tsv and women.tsv (made by the program "
      "POPULATION), cohort.html and contours.html are written")
def _cohort(request: Request) -> str:
    from .cohort_pages import CohortPages, cohort_page, contours_page

    runs, population, women_file = request.path(0), request.word(1), request.pipelines / "invivo/women.tsv"
    cases = read_cases(runs)
    moved = [case.name for case in cases if (runs / case.name).is_dir() and _measure_motion(runs / case.name, population)]
    known = read_table(women_file)
    table, cost = cohort_table(runs, cases, own_advice(request), known), cohort_cost(runs, cases)
    write_text(runs / "cohort.tsv", table.text())
    write_text(runs / "cost.tsv", cost.text())
    motion, women = runs / "motion.tsv", runs / "women.tsv"
    motion.unlink(missing_ok=True)
    women.unlink(missing_ok=True)
    if moved:
        words = [population, *(runs / name / "supine.vtkhdf" for name in moved), "--women", women_file, "--table", motion,
                 "--summary", women, "--quiet"]
        said = subprocess.run(words, capture_output=True, text=True, errors="replace", check=False)
        if said.returncode != 0:
            raise Failed(f"{os.fspath(population)}: {one_line(said.stderr)}")
    pages = CohortPages(runs, table, cost, table_if_any(motion), known)
    write_text(runs / "cohort.html", cohort_page(pages))
    write_text(runs / "contours.html", contours_page(pages))
    return table.text()
