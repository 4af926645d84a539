# SPDX-License-Identifier: GPL-3.0-or-later
"""tabulate: tables, verdicts and pages of runs, from their reports, tables and shapes."""
from __future__ import annotations

import os
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path

from ..command.tool import Run, Tool
from ..errors import BreastError
from ..page import views_page  # noqa: F401
from . import summary, report, verify, values  # noqa: F401, I001  the order of the help
from . import run_tables, paper_tables, outcomes, cost, leaveout, cohort, sides, views  # noqa: F401
from .kinds import KINDS, Request

_OWN = len(KINDS.known)
if find_spec("breast_validation"):  # in the source tree
    import breast_validation.kinds  # noqa: F401


def calibrated(request: Request) -> Request:
    """With CALIBRATED="REPORT SIDE", which the makefile exports for a phantom with a preset fitted to the chain."""
    given = os.environ.get("CALIBRATED", "")
    report_file, blank, side = given.rpartition(" ")
    if not given.strip(" "):
        return request
    if not blank:
        raise BreastError(f"CALIBRATED='{given}': is not REPORT.json SIDE")
    return replace(request, calibrated=Path(report_file), side=side)


def declaration() -> Tool:
    tool = Tool("tabulate", "tables, verdicts and pages of finished runs")
    tool.describe(
        "Reads the JSON reports, TSV tables and shapes of finished runs and prints one table or page to stdout, either as "
        "tab-separated text with a header line or as HTML. It runs no simulation. The pipeline makes all its tables and pages with "
        "this tool, and each kind can also be made by hand.")
    for number, known in enumerate(KINDS.known.values()):
        if number in (0, _OWN):
            tool.describe("In the source tree, for the validation pages and the checks of the tests:" if number else "The kinds are:")
        tool.describe(f"{known.name} {known.arguments}: {known.help}.")
    tool.describe(
        "If a phantom's preset was fitted to results of the chain, the environment variable CALIBRATED=\"REPORT.json SIDE\" names the "
        "phantom's report and side, and the rows to which it was fitted are marked.")
    KINDS.declare(tool)
    tool.text("--pipelines", "FOLDER", "folder with the pipeline's own tables: advice.tsv, limits.txt, paper/, invivo/", "pipelines")
    tool.example("tabulate summary runs/average", "the results of a finished case, preceded by its warnings")
    tool.example("tabulate tables runs/paper pipelines/materials/seed2008.tsv table3 conclusions",
                 "two of the tables in runs/paper/tables, beside the paper's")
    return tool


def main() -> int:
    def body(run: Run) -> None:
        run.report["kind"] = run.args.kind
        made = KINDS.called(run.args.kind).make(
            calibrated(Request(tuple(run.args.argument), Path(run.args.pipelines))))
        run.print(made if isinstance(made, str) else made.text())

    return declaration().main(body)
