# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings of a run of the pipeline: what is refused before make expands any of them, and what a case cannot have before anything runs.

Their defaults, and what follows from them, are variables of make (pipelines/settings.mk and options.mk).
"""
from __future__ import annotations

import hashlib
import os
from collections import defaultdict
from collections.abc import Mapping, Sequence
from pathlib import Path

from ..command.nearest import suggestion
from ..errors import BreastError
from ..output import write_text
from .case_file import read_case_file
from .claim import claim_run
from .goals import Goals
from .scan_identity import mixed_up
from .settings_table import Setting, check_characters, check_choice, read_settings

# A setting that is empty because a script's variable was must not get the results of the phantom, or the folder of all runs.
_NEVER_EMPTY = {"MR": "name the scan, or leave MR out for the phantom PRESET", "CASE_FILE": "name the case file, or leave CASE_FILE out",
                "CASE": "name the folder of the run, or leave CASE out", "RUNS": "name the folder of all runs, or leave RUNS out"}


def check_given(pipelines: Path, command_line: Mapping[str, str], environment: Mapping[str, str]) -> None:
    """Raises BreastError, in one sentence that names the setting, for a name on the command line that is no setting, and for a value there
    or in the environment that make or a shell would read as code.

    The values are those before any expansion. In the environment, names that are not settings are ignored.
    """
    # Other programs read CHROMIUM from the environment, where it may be any command.
    settings = {one.name: one for one in read_settings(pipelines)}
    known = {"share": Setting("share", "words"), **settings}
    for name in sorted(command_line):
        if name not in known:
            raise BreastError(f"{name} is not a setting{suggestion(name, known)} (`make -f Makefile.pipeline help` lists all settings)")
        check_characters(known[name], command_line[name])
        _refuse_empty(name, command_line[name])
    for name in settings.keys() & environment.keys() - command_line.keys() - {"CHROMIUM"}:
        check_characters(settings[name], environment[name])
        if name == "RUNS":
            _refuse_empty(name, environment[name])


def _refuse_empty(name: str, value: str) -> None:
    if not value and name in _NEVER_EMPTY:
        raise BreastError(f"{name}: is empty; {_NEVER_EMPTY[name]}")


def case_file_for_make(pipelines: Path, case_file: str, folder: Path) -> Path:
    """Writes the settings of a case file as a makefile into `folder` and returns its name, which is the same for the same case file.

    Raises BreastError, naming the file, the line and the setting, for what read_case_file and check_characters refuse.
    """
    settings = {one.name: one for one in read_settings(pipelines) if one.of_case}
    text = f"# The settings of {case_file}.\n"
    for name, value in read_case_file(case_file, list(settings)).items():
        check_characters(settings[name], value)
        _refuse_empty(name, value)
        text += f"{name} := {value}\n"
    made = folder / f"case-{hashlib.sha256(os.fsencode(os.path.abspath(case_file))).hexdigest()[:12]}.mk"
    folder.mkdir(parents=True, exist_ok=True)
    write_text(made, text)
    return made


def check_case(pipelines: Path, maker: int, values: Mapping[str, str]) -> None:
    """Raises BreastError, in one sentence that names the setting or the target, for a value that no program would accept, a file or a
    program that is not there, a target that this case cannot have, a folder that belongs to another scan, and a case that another process
    makes with other settings; otherwise claims the folder for the maker.

    Args:
        pipelines: folder of settings.tsv and goals.tsv.
        maker: the process that will make the case, 0 if it only plans.
        values: the case as make has it from the settings and their defaults, and goals, the targets of make; given, the names on its
            command line; installed (without the source tree), phantom, body_slides and no_tumour, not empty if they hold.
    """
    case = defaultdict(str, values)
    settings, goals = read_settings(pipelines), Goals(pipelines, case["goals"].split())
    for setting in settings:
        if not _is_result(case, case[setting.name]):
            check_choice(setting, case[setting.name], pipelines)
    _refuse_empty("CASE", case["CASE"])
    if case["CASE"].startswith(".") or "/" in case["CASE"]:
        raise BreastError(f"CASE: '{case['CASE']}' is not a plain name of a folder below {case['RUNS']}")
    goals.check(case)
    run = Path(case["RUN"])
    if goals.about_case():
        reason = mixed_up(run, case["SIDE"], f"phantom:{case['PRESET']}" if case["phantom"] else case["MR"])
        if reason:
            raise BreastError(reason)
    _check_files(case, settings)
    if goals.about_case() and maker:
        claim_run(run, maker, {one.name: case[one.name] for one in settings if one.of_case or one.kind == "program"},
                  [one.name for one in settings if one.kind == "text"])


def _is_result(case: Mapping[str, str], file: str) -> bool:
    """Whether a file is one of the runs: a rule may make it before it is read."""
    return file.startswith(case["RUNS"] + "/")


def _check_files(case: Mapping[str, str], settings: Sequence[Setting]) -> None:
    """Refuses a program or a file that a setting names and that is not there, unless a rule makes it."""
    given = case["given"].split()
    for setting in settings:
        name, value = setting.name, case[setting.name]
        if setting.kind == "program" and value and (name in given or case["installed"]):
            program = value.split()[0]
            if not (os.path.isfile(program) and os.access(program, os.X_OK)):
                raise BreastError(f"{name}: '{program}' is no program that can be run; give its path, or leave {name} out for libbreast's "
                                  "own")
        # The scan may be a phantom that a rule makes, a material set a name; LANDMARKS and MAMMOGRAMS name two files.
        for file in value.split(",") if setting.kind == "path" and setting.of_case and name not in ("MR", "MATERIALS") and value else ():
            if file != "phantom" and not _is_result(case, file) and not os.path.exists(file):
                raise BreastError(f"{name}: '{file}' does not exist; check its name and folder")
    if case["MAMMOGRAMS"] and case["MAMMOGRAMS"].count(",") != 1:
        raise BreastError(f"MAMMOGRAMS: '{case['MAMMOGRAMS']}' is not CC.dcm,MLO.dcm, the patient's two mammograms of this breast")
    if case["SUPINE"] == "phantom" and not case["phantom"]:
        raise BreastError(f"SUPINE: phantom is the supine scan of a phantom, but MR={case['MR']} is the scan of a patient; name the supine "
                          "scan of this patient")
