# SPDX-License-Identifier: GPL-3.0-or-later
"""Execution of a stage of a variant, which may have no solution."""
from __future__ import annotations

import shutil
from collections.abc import Sequence
from pathlib import Path

from ..command.child import run_child
from ..errors import Failed
from ..output import write_text
from ..study.files import exists
from .stage import NOT_CONVERGED


def attempt(report: Path, inputs: Sequence[Path], command: Sequence[str]) -> None:
    """Runs a command that computes a stage and writes its report, STAGE.json, and files of the same name.

    Such files of an earlier run are removed first. A solve that does not converge (exit code 3) is a valid result: its report states
    the reason. If an input does not exist because an earlier stage did not converge, the command is not run, and the report of that
    input is copied to `report`. Raises Failed if the command ends with any other exit code, or with 3 and without a report.
    """
    for ending in (".vtkhdf", ".vtp", ".tsv", ".json"):
        report.with_suffix(ending).unlink(missing_ok=True)
    missing = next((file for file in inputs if not file.exists()), None)
    if missing is not None:
        shutil.copyfile(missing.with_suffix(".json"), report)
        return
    code = run_child(command)
    # A program that is not part of libbreast may write no report.
    if code == 0 and not exists(report):
        write_text(report, '{\n  "status": "ok"\n}\n')
    if code != 0 and not (code == NOT_CONVERGED and exists(report)):
        raise Failed(f"{command[0]} ended with exit code {code}")
