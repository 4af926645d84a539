# SPDX-License-Identifier: GPL-3.0-or-later
"""cases: reading and checking of cases before anything runs, and running of a cohort's cases."""
from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from ..command.kinds import Kinds
from ..command.tool import Run, Tool
from ..errors import BreastError, Failed
from ..output import write_text
from ..text_table import parse_number, read_table, read_text

if TYPE_CHECKING:
    from .cohort import CohortEntry


ACTIONS = Kinds("cases", "an action of cases")


def _named_value(word: str, start: int = 0) -> tuple[str, str]:
    """NAME and VALUE after a mark: "@hexmesh=--elements 8"."""
    name, equals, value = word.partition("=")
    if not equals:
        raise BreastError(f"'{word}' is not NAME=VALUE")
    return name[start:], value


# The modules of an action are imported when it is asked for: most actions are called many times by make.

@ACTIONS.kind("given", "PIPELINES [NAME=VALUE]...",
              "refuses a name that is no setting, and a value, here or in the environment, that make or a shell would read as code")
def _given(words: list[str], run: Run) -> None:
    from .settings import check_given
    check_given(Path(words[0]), dict(map(_named_value, words[1:])), os.environ)


@ACTIONS.kind("case-file", "PIPELINES FILE FOLDER", "writes the settings of a case file as a makefile into FOLDER, and prints its name")
def _case_file(words: list[str], run: Run) -> str:
    from .settings import case_file_for_make
    return f"{case_file_for_make(Path(words[0]), words[1], Path(words[2]))}\n"


@ACTIONS.kind("check", "PIPELINES MAKE_PID|0 [NAME=VALUE]...",
              "refuses a value that no program would accept, a target (goals) that the case cannot have, a folder RUN of another scan, "
              "and a case that another process makes with other settings; 0: a plan, which makes nothing")
def _check_case(words: list[str], run: Run) -> None:
    from .settings import check_case
    check_case(Path(words[0]), int(parse_number(words[1], "check: MAKE_PID")), dict(map(_named_value, words[2:])))


def _entries(words: list[str]) -> list[CohortEntry]:
    from .cohort import cohort_entries
    from .settings_table import read_settings
    return cohort_entries(words[0], [one.name for one in read_settings(Path(words[1])) if one.of_case])


@ACTIONS.kind("cohort", "COHORT PIPELINES", "prints the names of the cases of a folder")
def _cohort(words: list[str], run: Run) -> str:
    return "".join(one.name + "\n" for one in _entries(words))


@ACTIONS.kind("list", "COHORT PIPELINES", "prints one line per case file of a folder: CASE, FILE and KIND (scan or phantom)")
def _list(words: list[str], run: Run) -> str:
    return "".join("\t".join(one) + "\n" for one in _entries(words))


@ACTIONS.kind("studies", "OUT.mk MAKEFILE RUN ENDS_AT PLACE [@COLUMN:VARIABLE=OPTIONS]... [{NAME=VALUE]... [STUDY=FILE.tsv[@ROW]]...",
              "writes the rules by which make solves the rows of studies: those of the chain in MAKEFILE, with the options of each row; "
              "PLACE is the command that prints the place of a tumour")
def _studies(words: list[str], run: Run) -> None:
    from .study_rules import StudyRules, chain_rules
    from .variants import Studies, StudyBase
    made, makefile, folder, ends_at, place, *rest = words
    rules = chain_rules(read_text(makefile))
    base = StudyBase(folder, list(rules), ends_at)
    variables: dict[str, str] = {}
    for word in rest:
        if word.startswith("@"):
            name, value = _named_value(word, 1)
            column, _, variable = name.partition(":")
            base.attributes[column], variables[column] = value, variable
        elif word.startswith("{"):
            name, value = _named_value(word, 1)
            base.placeholders[name] = value
    studies = Studies(base)
    for word in rest:
        if not word.startswith(("@", "{")):
            name, value = _named_value(word)
            file, _, origin = value.partition("@")
            studies.add(name, read_text(file), file, origin)
    text = StudyRules(studies, rules, variables, folder, "curve" in ends_at.split(), place).text()
    if not os.path.exists(made) or read_text(made) != text:
        os.makedirs(os.path.dirname(made), exist_ok=True)
        write_text(made, text)


@ACTIONS.kind("record", "RUN SIDE SCAN", "records scan and side in RUN/.scan")
def _record(words: list[str], run: Run) -> None:
    from .scan_identity import remember_scan
    remember_scan(Path(words[0]), words[1], words[2])


@ACTIONS.kind("stage", "RECORD 'SETTINGS' -- COMMAND...",
              "runs a stage, says in one line what it found, and records its settings; all else that it says is in log.txt beside the "
              "record")
def _stage(words: list[str], run: Run) -> None:
    from .stage import run_stage
    prints, keep, spared = (Path(file) if file else None for file in (run.args.prints, run.args.keep, run.args.spared))
    run_stage(Path(words[0]), words[1], words[2:], prints, keep, list(map(Path, run.args.of.split())), spared)


@ACTIONS.kind("gripped", "RUN", "fails if the plates of a view do not grip the breast, and says why")
def _gripped(words: list[str], run: Run) -> None:
    from .compression import views_without_compression
    from .stage import in_red
    if said := views_without_compression(Path(words[0])):
        sys.stderr.write("".join(in_red(line) + "\n" for line in said))
        raise Failed(f"{words[0]}: its shape is kept, and no mammogram and no curve are made of it")


@ACTIONS.kind("attempt", "STAGE.json 'INPUT...' -- COMMAND...",
              "runs a stage of a variant; if it has no solution, the report gives the reason")
def _attempt(words: list[str], run: Run) -> None:
    from .attempt import attempt
    attempt(Path(words[0]), list(map(Path, words[1].split())), words[2:])


@ACTIONS.kind("ladder", "RUN MM 'POINT...' -- MAKE...",
              "solves points of the study `cost` until the estimated error is below MM, and writes RUN/accuracy.mk")
def _ladder(words: list[str], run: Run) -> None:
    from .ladder import climb
    sys.stderr.write(climb(Path(words[0]), parse_number(words[1], "ACCURACY"), words[2].split(), words[3:]))


@ACTIONS.kind("run", "RUNS CASE -- MAKE... GOAL",
              "runs a case of the cohort listed in RUNS/.cases and writes its outcome to RUNS/CASE.status")
def _run(words: list[str], run: Run) -> None:
    from .case_run import run_case
    from .cohort import listed_cases
    runs, name, *make, goal = words
    one = next((one for one in listed_cases(Path(runs, ".cases")) if one.name == name), None)
    if one is None:
        raise BreastError(f"{runs}/.cases lists no case {name}")
    if not run_case(Path(runs), one, [*make, f"CASE_FILE={one.file}", f"CASE={one.name}", goal]):
        raise Failed(f"{name}: stopped by a signal")


@ACTIONS.kind("any-done", "TABLE.tsv", "fails if no case in the table of a cohort was completed")
def _any_done(words: list[str], run: Run) -> None:
    if not any(row["status"] == "done" for row in read_table(words[0])):
        raise Failed(f"every case failed: see {words[0]}")


@ACTIONS.kind("script", "RUNS COHORT -- [MAKE]...", "prints the script of the job array that `submit` would submit")
@ACTIONS.kind("submit", "RUNS COHORT -- [MAKE]...",
              "submits to Slurm the cases in RUNS/.cases, each as a run of the command MAKE, and a job that makes their table")
def _slurm(words: list[str], run: Run) -> str:
    from . import slurm
    asked = run.args
    request = slurm.SlurmRequest(
        Path(words[0]), Path(words[1]), os.path.realpath(sys.argv[0]), words[2:], Path(asked.cost), asked.partition, asked.account,
        asked.time, asked.memory, asked.options, asked.cores, asked.resume, asked.elements, asked.element)
    return slurm.submit_to_slurm(request) if asked.kind == "submit" else slurm.slurm_plan(request)


@ACTIONS.kind("task", "FOLDER OFFSET", "runs the case of one task; called by the job array")
def _task(words: list[str], run: Run) -> str:
    from .slurm import run_slurm_task
    return run_slurm_task(Path(words[0]), int(parse_number(words[1], "task: OFFSET")))


@ACTIONS.kind("table", "FOLDER COHORT", "makes the table; called by the last job")
def _table(words: list[str], run: Run) -> None:
    from .slurm import run_slurm_table
    run_slurm_table(Path(words[0]), words[1])


def _declared() -> Tool:
    tool = Tool("cases", "reading, checking and running of cases, cohorts and studies for the pipeline")
    tool.describe("Performs the work of Makefile.pipeline that is not a matter of make: it reads case files and studies as data, refuses "
                  "a scan in a folder that belongs to another one, runs the cases of a cohort, and submits them to Slurm. It is called "
                  "by the makefile and is not meant to be called by hand.")
    for action in ACTIONS.known.values():
        tool.describe(f"{action.name} {action.arguments}: {action.help}.")
    ACTIONS.declare(tool)
    tool.text("--prints", "FILE", "of `stage`: the file that gets what the program prints; its messages alone are then in the log")
    tool.text("--keep", "FILE", "of `stage`: the shape of compress, which is kept even if the plates do not grip the breast")
    tool.text("--spared", "FILE", "of `stage`: what the program writes, which is left out if the program fails")
    tool.text("--of", "'FILE...'", "of `stage`: compressed shapes, or files made of them, without which the stage is not run")
    tool.text("--partition", "NAME", "partition of the cluster")
    tool.text("--account", "NAME", "account to be charged")
    tool.text("--time", "TIME", "time limit of a case, in minutes or as sbatch accepts it (default: from the measured cost)")
    tool.text("--memory", "MB", "memory of a case (default: from the measured cost)")
    tool.integer("--cores", "cores of a case", 1, 1, 1024)
    tool.text("--options", "OPTIONS", "further options of sbatch, passed on unchanged")
    tool.flag("--resume", "submit only the cases that are missing or out of date")
    tool.integer("--elements", "number of elements along an edge (ELEMENTS) of the cases whose files do not ask for more", 16, 4, 64)
    tool.text("--element", "NAME", "element (ELEMENT) of every case, q1p0 or q2p1")
    tool.text("--cost", "FILE.tsv", "table of the cost of a case, used until cases of this cohort have been measured",
              "pipelines/cohort-cost.tsv")
    tool.example("cases list patients pipelines", "list the cases of a cohort")
    tool.example("cases record runs/scan-left left scan.nrrd", "record that this folder was made from this scan")
    return tool


def main() -> int:
    def body(run: Run) -> None:
        run.report["kind"] = run.args.kind
        run.print(ACTIONS.called(run.args.kind).make(run.args.argument, run) or "")
    return _declared().main(body)
