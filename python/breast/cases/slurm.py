# SPDX-License-Identifier: GPL-3.0-or-later
"""A cohort on Slurm: a job array over its cases (several arrays if there are more cases than the site's MaxArraySize), followed by a
job that makes the table."""
from __future__ import annotations

import os
import re
import shutil
import socket
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ..command.child import capture_child, run_child
from ..errors import BreastError, Failed
from ..output import write_text
from ..study.table import table_if_any
from ..text_table import number_in, read_table, read_text
from .case_file import setting_in
from .case_run import is_done, run_case
from .cohort import CohortEntry, listed_cases
from .cost import CaseCost, case_cost

_MOST_ELEMENTS = 64.0  # hexmesh refuses more
_USUAL_ARRAY = 1001  # Slurm's default of MaxArraySize


@dataclass
class SlurmRequest:
    """A submission to Slurm.

    runs: of the cohort, contains its list .cases; cohort: folder of the case files; program: the tool `cases`, which runs a task;
    command: make command of a case, without the case's own settings; partition, account, time (minutes or Slurm's notation), memory
    (MB), options: of sbatch, empty if not given, where time and memory are then derived from measured costs; cores: per case;
    resume: submits only the cases that are missing or out of date; elements, element: of every case, unless its file asks for more;
    cost: table of assumed costs.
    """

    runs: Path
    cohort: Path
    program: str
    command: list[str]
    cost: Path
    partition: str = ""
    account: str = ""
    time: str = ""
    memory: str = ""
    options: str = ""
    cores: int = 1
    resume: bool = False
    elements: int = 16
    element: str = ""


def _quoted(word: object) -> str:
    """A word for a shell, whatever characters it contains."""
    return "'" + str(word).replace("'", "'\\''") + "'"


def _command_of(make: Sequence[str], *more: str) -> list[str]:
    # With CLUSTER empty make runs the case itself, within a job, instead of submitting it to Slurm.
    return [*make, "CLUSTER=", *more]


def _case_command(make: Sequence[str], runs: Path, one: CohortEntry) -> list[str]:
    return _command_of(make, "COHORT=", f"RUNS={runs}", f"CASE_FILE={one.file}", f"CASE={one.name}", "summary")


def _leave_make() -> None:
    """A make started here must not act as a sub-make of the make that started this program."""
    for name in ("MAKEFLAGS", "MFLAGS", "MAKEOVERRIDES", "MAKELEVEL"):
        os.environ.pop(name, None)


def dearest_case(request: SlurmRequest, cases: Sequence[CohortEntry]) -> CaseCost:
    """The cost of the largest mesh that the request or a case file asks for. Raises BreastError if no table contains the element."""
    size, element = request.elements, request.element or "q1p0"
    for one in cases:
        text = read_text(one.file)
        size = max(size, min(number_in(setting_in(text, "ELEMENTS")) or 0, _MOST_ELEMENTS))
        if setting_in(text, "ELEMENT") == "q2p1":
            element = "q2p1"
    return case_cost(table_if_any(request.runs / "cost.tsv"), read_table(request.cost), request.cores, element, size)


def _job_script(request: SlurmRequest, folder: Path, name: str, time: object, memory: object, output: str, command: str,
                cores: int = 1, remark: str = "") -> str:
    asked = {"job-name": name, "time": time, "mem": f"{memory}M", "cpus-per-task": cores, "output": folder / output, "requeue": None,
             "open-mode": "append", "partition": request.partition, "account": request.account}
    lines = "".join(f"#SBATCH --{key}\n" if value is None else f"#SBATCH --{key}={value}\n"
                    for key, value in asked.items() if value != "")
    return f"#!/bin/bash\n{lines}{remark}cd {_quoted(os.getcwd())} || exit 1\nexec {command}\n"


def _source_of(request: SlurmRequest, cost: CaseCost) -> str:
    return cost.source + ("; time as asked" if request.time else "") + ("; memory as asked" if request.memory else "")


def array_script(request: SlurmRequest, folder: Path, cost: CaseCost) -> str:
    """The script of the job array.

    Every submission has its own list of cases in `folder` (RUNS/.slurm/N), so that a later submission does not change what the tasks
    of an earlier one read.
    """
    remark = (f"# Time and memory: from {_source_of(request, cost)}.\n# Task K runs the case on line K + 1 of {folder / 'cases'}, in "
              "chunks K + 1 + $1.\n")
    task = f"{_quoted(request.program)} task {_quoted(folder)} \"${{1:-0}}\" --quiet"
    return _job_script(request, folder, request.runs.name, request.time or cost.minutes, request.memory or cost.memory_mb,
                       "%A_%a.out", task, request.cores, remark)


def _next_folder(runs: Path) -> Path:
    number = 1
    while (runs / ".slurm" / str(number)).exists():
        number += 1
    return runs / ".slurm" / str(number)


def wanted_cases(request: SlurmRequest) -> list[CohortEntry]:
    """The cases to run: all or, with `resume`, those without a result and those that make considers out of date."""
    cases = listed_cases(request.runs / ".cases")
    if not request.resume:
        return cases
    _leave_make()

    def done(one: CohortEntry) -> bool:
        make, *words = _case_command(request.command, request.runs, one)
        return is_done(one.status(request.runs)) and capture_child([make, "-q", *words]).exit_code == 0
    return [one for one in cases if not done(one)]


def slurm_plan(request: SlurmRequest) -> str:
    """The options and the script that sbatch would receive."""
    cost = dearest_case(request, listed_cases(request.runs / ".cases"))
    return (f"# sbatch --array=0-{len(wanted_cases(request)) - 1} [OFFSET: tasks before those of this chunk]\n" +
            array_script(request, _next_folder(request.runs), cost))


def _largest_array() -> int:
    """The largest number of tasks in a job array: the site's setting, or Slurm's default if unknown."""
    try:
        found = re.search(r"MaxArraySize *= *([0-9]+)", capture_child(["scontrol", "show", "config"]).out)
    except Failed:
        return _USUAL_ARRAY
    return int(found[1]) if found else _USUAL_ARRAY


def _sbatch(request: SlurmRequest, options: Sequence[str], script: Sequence[object]) -> str:
    """Submits a job and returns its number."""
    said = capture_child(["sbatch", "--parsable", *options, *request.options.split(), *map(str, script)])
    if said.exit_code != 0:
        raise Failed(" ".join(said.err.splitlines()))
    return re.split("[;\n]", said.out)[0]


def _submit_arrays(request: SlurmRequest, folder: Path, total: int) -> str:
    size, jobs = _largest_array(), ""
    for offset in range(0, total, size):
        try:
            jobs += ":" + _sbatch(request, [f"--array=0-{min(total - offset, size) - 1}"], [folder / "array.sh", offset])
        except Failed as error:
            submitted = f" (jobs{jobs})" if jobs else ""
            raise Failed(f"{error}; sbatch accepted {offset} of {total} cases{submitted}; when they have ended, submit the others by "
                         "the same command with --resume") from None
    return jobs


def submit_to_slurm(request: SlurmRequest) -> str:
    """Submits the cohort and returns a message with the numbers of the jobs and their time and memory.

    Raises Failed if sbatch is not found or refuses a job.
    """
    if not shutil.which("sbatch"):
        raise Failed("the program sbatch was not found in PATH, so that no job can be submitted to Slurm from this machine; install "
                     "slurm-client, or run the cases on this machine without --slurm")
    every, wanted = listed_cases(request.runs / ".cases"), wanted_cases(request)
    cost, folder = dearest_case(request, every), _next_folder(request.runs)
    folder.mkdir(parents=True)
    write_text(folder / "command", "\n".join(request.command) + "\n")
    write_text(folder / "cases", "".join("\t".join(one) + "\n" for one in wanted))
    write_text(folder / "array.sh", array_script(request, folder, cost))
    # The table takes one or two seconds per case; 30 minutes and 6 seconds per case are requested.
    table = f"{_quoted(request.program)} table {_quoted(folder)} {_quoted(request.cohort)} --quiet"
    write_text(folder / "table.sh", _job_script(request, folder, request.runs.name + "-table", 30 + len(every) // 10, 1024,
                                                "table.out", table))
    jobs = _submit_arrays(request, folder, len(wanted))
    last = _sbatch(request, [f"--dependency=afterany{jobs}"] if jobs else [], [folder / "table.sh"])
    return (f"{len(wanted)} of {len(every)} cases given to Slurm, job{jobs or ' none'}; then the table, job {last}\n"
            f"Time and memory of a case: {request.time or cost.minutes} minutes, {request.memory or cost.memory_mb} MB, from "
            f"{_source_of(request, cost)}\n{request.runs}/cohort.tsv and cohort.html appear when the last has ended\n")


def run_slurm_task(folder: Path, offset: int) -> str:
    """Called in a task of the array: runs the case whose line in FOLDER/cases, counted from 0, is SLURM_ARRAY_TASK_ID + offset.

    Returns the text of its status file. Raises BreastError if there is no such case, and Failed if it does not end as done.
    """
    _leave_make()
    cases, given = listed_cases(folder / "cases"), os.environ.get("SLURM_ARRAY_TASK_ID", "")
    task = number_in(given)
    if task is None or task < 0 or int(task) + offset >= len(cases):
        raise BreastError(f"SLURM_ARRAY_TASK_ID: task '{given}' with the offset {offset} is none of the {len(cases)} cases listed in "
                          f"{folder / 'cases'}; submit the cohort again")
    one, runs = cases[int(task) + offset], folder.parent.parent
    status = one.status(runs)
    os.environ["OMP_NUM_THREADS"] = os.environ.get("SLURM_CPUS_PER_TASK") or "1"  # nproc prints it, too
    starts = int(number_in(os.environ.get("SLURM_RESTART_COUNT", "")) or 0) + 1
    # Printed at the start, because nothing could be printed at the end if the node were lost.
    print(f"{one.name} on {socket.gethostname()}, job {os.environ.get('SLURM_JOB_ID', '')}, start {starts}", flush=True)
    make = read_text(folder / "command").splitlines()
    run_case(runs, one, _case_command(make, runs, one))
    if not is_done(status):
        raise Failed(f"{one.name}: {' '.join(read_text(status).split(chr(9))).strip()}")
    return read_text(status)


def run_slurm_table(folder: Path, cohort: str) -> None:
    """Called in the last job: makes the table of the cohort. Raises Failed if make fails."""
    _leave_make()
    make, runs = read_text(folder / "command").splitlines(), folder.parent.parent
    code = run_child(_command_of(make, f"COHORT={cohort}", f"RUNS={runs.parent}", "cohort-table"))
    if code != 0:
        raise Failed(f"the table could not be made: make ended with {code}")
