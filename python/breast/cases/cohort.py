# SPDX-License-Identifier: GPL-3.0-or-later
"""The case files of a cohort's folder."""
from __future__ import annotations

import os
import re
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from ..command.make_name import plain_for_make
from ..errors import BreastError
from ..text_table import read_text
from .case_file import read_case_file


class CohortEntry(NamedTuple):
    """name: of the case, and of its folder below the runs of the cohort; kind: scan, or phantom if the case file names no MR."""

    name: str
    file: str
    kind: str

    def status(self, runs: Path) -> Path:
        """The file that says what became of the case."""
        return runs / (self.name + ".status")


def _visible(folder: str) -> list[str]:
    """Hidden files and folders do not belong to a cohort."""
    try:
        return [os.path.join(folder, name) for name in os.listdir(folder) if not name.startswith(".")]
    except OSError:
        return []


def _case_files(cohort: str) -> list[str]:
    files = []
    for entry in _visible(cohort):
        if Path(entry).suffix == ".case":
            files.append(entry)
        if os.path.isdir(entry):
            files += [inner for inner in _visible(entry) if os.path.basename(inner) == "case.txt"]
    return sorted(files, key=os.fsencode)


def _check_name(file: str, cohort: str) -> None:
    below = os.path.relpath(file, cohort)
    if plain_for_make("./" + below):
        return
    shown = re.sub(rb"[^A-Za-z0-9./_-]", b"?", os.fsencode(below)).decode()
    raise BreastError(f"COHORT: {shown}: a name with such characters is refused; use letters, digits, points, dashes and underscores "
                      "(each ? is such a character)")


def _case_name(file: str) -> str:
    path = Path(file)
    return path.parent.name if path.name == "case.txt" else path.stem


def cohort_entries(cohort: str, known: Sequence[str]) -> list[CohortEntry]:
    """The cases of a cohort, sorted by the paths of their files: COHORT/*.case and COHORT/*/case.txt; `known` lists the keys of case
    files.

    Raises BreastError if there is no case, if a path below COHORT contains a character that is refused, if two cases have the same
    name, or if any case file is refused or names neither MR nor PRESET: a phantom would otherwise be run under the name of the
    patient whose MR was left out.
    """
    files = _case_files(cohort)
    if not files:
        raise BreastError(f"COHORT={cohort} holds no case; a case is a file *.case or */case.txt")
    for file in files:
        _check_name(file, cohort)
    named: dict[str, str] = {}
    for file in files:
        other = named.setdefault(_case_name(file), file)
        if other is not file:
            raise BreastError(f"COHORT={cohort}: two case files are called {_case_name(file)}: {other} and {file}; rename one of them")
    entries, problems = [], []
    for name, file in named.items():
        try:
            given = read_case_file(file, known)
        except BreastError as error:
            problems.append(str(error))
            continue
        if "MR" not in given and "PRESET" not in given:
            problems.append(f"case file {file}: names neither MR nor PRESET; add MR = SCAN, or PRESET = NAME for a phantom")
        entries.append(CohortEntry(name, file, "scan" if "MR" in given else "phantom"))
    if problems:
        raise BreastError("; ".join(problems))
    return entries


def listed_cases(file: Path) -> list[CohortEntry]:
    """The list of a cohort, with a line CASE<TAB>FILE<TAB>KIND for each case. Raises BreastError naming a line without three cells."""
    cases = []
    for line in read_text(file).splitlines():
        cells = line.split("\t")
        if len(cells) != 3:
            raise BreastError(f"the line '{line}' is no case: it has {len(cells)} cells, and CASE, FILE and KIND are needed; remove "
                              "the file and start the cohort again", file)
        cases.append(CohortEntry(*cells))
    return cases
