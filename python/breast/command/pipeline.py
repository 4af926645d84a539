# SPDX-License-Identifier: GPL-3.0-or-later
"""The pipeline as a command: breast run, demo and cohort."""
from __future__ import annotations

import os
import re
import sys
from collections.abc import Sequence
from pathlib import Path

from ..cases.settings_table import Setting, read_settings
from ..errors import BreastError, Failed
from .child import Captured, capture_child, run_child
from .installation import Installation
from .make_name import folder_for_make, name_for_make, plain_for_make
from .request import PipelineRequest, parse_request


def _settings(installation: Installation) -> list[Setting]:
    return read_settings(Path(installation.pipelines))


def settings_for_make(installation: Installation, r: PipelineRequest, runs: str) -> list[str]:
    """Every setting in the form that make accepts, with links where the name of a file needs one."""
    links = Path(runs) / ".names"
    files = {one.name for one in _settings(installation) if one.kind in ("path", "program") or "place" in one.choices}
    words = [f"RUNS={runs}"]
    if r.scan:
        words.append(("COHORT=" if r.command == "cohort" else "MR=") + name_for_make(r.scan, links))
    if r.side and "SIDE" not in r.settings:
        words.append(f"SIDE={r.side}")
    # The report of the demonstration is that of its own phantom; make's default for a report is the paper's, with its tables.
    if r.command == "demo" and r.target == "report" and not {"PRESET", "PAPER"} & r.settings.keys():
        words.append("PRESET=average")
    for name, value in sorted(r.settings.items()):
        file = name in files and os.path.exists(value)
        words.append(f"{name}={name_for_make(value, links) if file else value}")
    return words


def _refusal(made: Captured) -> str:
    """Shortens "pipelines/settings.mk:47: *** SIDES: no such setting. Stop." to the message without make's additions."""
    lines = [line for line in made.err.splitlines() if line]
    last = next((line for line in lines if "*** " in line), lines[-1] if lines else "")
    last = last.partition("*** ")[2] or last
    if ".  Stop." in last:
        last = last[:last.rindex(".  Stop.")]
    last = last.replace("`make -f Makefile.pipeline help`", "`breast help settings`", 1)
    no_rule = "No rule to make target '"
    if not last.startswith(no_rule):
        return last
    name, _, rest = last.removeprefix(no_rule).partition("'")
    if rest.startswith(", needed by "):
        return f"'{name}', which is named in a setting, does not exist"
    return f"'{name}' is not a target of the pipeline; `breast help settings` lists the targets"


def _ask(words: Sequence[str]) -> str:
    """The output of make; raises BreastError if make refuses."""
    made = capture_child(words)
    if made.exit_code != 0:
        raise BreastError(_refusal(made))
    return made.out


def _make_file(installation: Installation) -> str:
    file = installation.pipeline
    if not os.path.exists(file):
        raise Failed(f"{file} does not exist: the pipeline is not installed")
    # In the source tree it is called as in the README, so that both ways share their runs.
    name = os.path.basename(file) if os.path.samefile(os.path.dirname(file), os.getcwd()) else file
    if not plain_for_make(name):
        raise Failed(f"make cannot use the pipeline at '{name}'; install libbreast in a folder without blanks, quotes and brackets")
    return name


def make_run(words: Sequence[str], run: str) -> int:
    """Runs the stages; says where to look if one failed. Returns 0, 1, or 128 plus a signal."""
    code = run_child(words)
    if code == 0:
        return 0
    sys.stderr.write(f"breast: stopped; what the stages said is in {run}/log.txt, finished results are in {run}, and "
                     "the same command does not make them again\n")
    return code if code > 128 else 1


def show_results(targets: Sequence[str], run: str) -> None:
    """Where the results are; the last line is the page, if there is one."""
    print(f"Results: {run}")
    if "summary" in targets:
        print("More: the same command with --target report (one page for reading and printing) or slicer")
    if {"page", "states"} & {*targets}:
        print(f"Page: {run}/page.html")


def pipeline_settings(installation: Installation) -> list[str]:
    """The settings of the pipeline by name."""
    return [one.name for one in _settings(installation) if one.name != "RUN"]


def settings_help(installation: Installation) -> str:
    """The help of the makefile: all targets and settings, in an installation without what needs the source tree."""
    return _ask(["make", "-s", "-f", _make_file(installation), "help"])


def setting_help(installation: Installation, name: str) -> str:
    """What the makefile's help says of a setting, and what the setting accepts; "" if it says nothing of it."""
    setting = next((s for s in _settings(installation) if s.name == name.upper()), None)
    said = setting and re.search(rf"^  {setting.name}=.*\n(?: {{26}}.*\n)*", settings_help(installation), re.MULTILINE)
    if not said:
        return ""
    found = "  " + " ".join(said[0].split()) + "\n"
    kind, *bounds = setting.choices or ("set",)
    if kind in ("number", "integer"):
        what = "a number" if kind == "number" else "a whole number"
        found += f"  accepts: {what}" + (f" from {bounds[0]} to {bounds[1]}" if bounds else "") + "\n"
    elif kind != "set" and not kind.startswith("rows:") and "place" not in bounds:
        found += "  accepts: " + " ".join(setting.choices).replace("%", "...") + "\n"
    return found


def asked_of_make(installation: Installation, r: PipelineRequest) -> tuple[list[str], str, str]:
    """The words that make is called with, without targets; the folder of the results; and the plan. Raises BreastError if make refuses."""
    make = ["make", "-f", _make_file(installation), *settings_for_make(installation, r, folder_for_make(r.runs))]
    return make, _ask([*make, "-s", "where"]).removesuffix("\n"), _ask([*make, "-n", *r.target.split()])


def run_pipeline(installation: Installation, command: str, arguments: Sequence[str]) -> int:
    """Runs `breast COMMAND arguments` (run, demo, page or cohort).

    Everything that can be refused is refused first; then make runs in the present folder, and the location of the results is printed.
    Returns 0, 1 if a stage failed, or 128 + the signal that ended make; raises BreastError.
    """
    request = parse_request(command, arguments)
    if request.scan and not os.path.exists(request.scan):
        raise BreastError(f"'{request.scan}' does not exist")
    if request.of_scan:
        from .scan_run import run_scan
        return run_scan(installation, request)
    make, run, plan = asked_of_make(installation, request)
    targets = request.target.split()
    if request.plan:
        sys.stdout.write(_ask([*make, "-s", "cohort-script"]) if request.slurm else plan)
        return 0
    sys.stdout.flush()
    if request.slurm:
        return 0 if run_child([*make, "-s", *targets]) == 0 else 1
    code = make_run([*make, f"-j{request.jobs}", *targets], run)
    if code == 0:
        show_results(targets, run)
    return code
