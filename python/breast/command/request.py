# SPDX-License-Identifier: GPL-3.0-or-later
"""The request given to `breast run`, `demo` or `cohort`, parsed from its command line."""
from __future__ import annotations

import os
import re
from collections.abc import Sequence
from dataclasses import dataclass, field

from ..errors import BreastError, Failed
from .assumed import SIDES, TUMOUR_RULE
from .commands import COMMANDS
from .declaration import Declaration
from .parse import Tokens, assign, tokenize

_SETTING = re.compile(r"[A-Z_0-9]+=.*", re.DOTALL)


@dataclass
class PipelineRequest:
    """command: run, demo, page or cohort; scan: for run a file or folder, for cohort the folder of case files; side: left, right, or empty
    for those that the scan shows;
    plan: only print the commands; slurm, local: for cohort a job array, or processes on this machine; settings: given as SETTING=value.
    """

    command: str
    scan: str = ""
    side: str = ""
    runs: str = "runs"
    target: str = "summary"
    jobs: int = 1
    plan: bool = False
    slurm: bool = False
    local: bool = False
    settings: dict[str, str] = field(default_factory=dict)

    @property
    def of_scan(self) -> bool:
        """Whether it is about one scan of a patient."""
        return self.command == "run" or (self.command == "page" and self.scan != "")


def _options(d: Declaration, jobs: int, jobs_help: str) -> None:
    d.text("--runs", "DIR", "folder in which every run has a folder of its own; it is created if it does not exist", "runs")
    d.integer("-j,--jobs", jobs_help, jobs, 1, 64)
    d.flag("--dry-run", "print the commands without running them")


def _case_options(d: Declaration, target: str) -> None:
    # Of one case, two stages can run side by side most of the time, such as the compressions in both views.
    _options(d, 2, "number of stages that may run at the same time; they share the cores")
    d.text("--target", "NAME", "what to make: chain, figures, summary, page, states, report or another target of the pipeline (breast help "
           "settings); several are separated by blanks", target)


def _declare_run(d: Declaration) -> None:
    d.paragraphs += [
        "Models the breasts of a scan, from its segmentation to both mammographic views, and ends with the path of the page, which shows "
        "where the tumour, or any other place, lies in them. Only the scan must be given: the command prints what it assumed of the "
        "rest, and how to change it. Stages whose inputs and settings are unchanged are not run again.",
        "Without --side, both breasts are modelled; one that the scan does not show is left out. Of a "
        "DICOM folder the best series is taken (`breast help scan` has the rule), and a water image is read with the fat image of the same "
        f"size. A file of the tumour is found beside the scan by its name: {TUMOUR_RULE}. If both breasts are modelled, the tumour "
        "belongs to the one whose nipple is nearer.",
        "Settings of the form SETTING=value may follow the scan, such as TUMOUR=x,y,z, REDUCTION=40, CHEST_WALL=labels.nrrd or "
        "MATERIALS=wellman; `breast help settings` lists them. File names are relative to the current folder. A scan, or a file in a "
        "setting, whose name make cannot handle (blanks, quotes, brackets, ...) is accessed through a link with a plain name in "
        "DIR/.names; the name of the run's folder has underscores in place of such characters."]
    d.word("SCAN", "T1-weighted MR in which fat is bright, patient prone: NRRD, NIfTI, MetaImage or a DICOM folder")
    d.choice("--side", SIDES, "breast to model: the patient's left or right (default: both, if the scan shows both)")
    _case_options(d, "summary page")
    d.examples += [("breast run scan.nrrd", "results in ./runs/scan-left and ./runs/scan-right, each with page.html"),
                   ("breast run scan.nrrd --side left", "results in ./runs/scan-left"),
                   ("breast run 'my scans/patient 1' --side right TUMOUR=-60,-40,12 --runs /data/runs",
                    "a DICOM folder, and a tumour to follow, at L, P, S in mm as DICOM and 3D Slicer's LPS have them")]


def _declare_demo(d: Declaration) -> None:
    d.paragraphs.append(
        "Simulates the MR scan of a phantom of average size, runs the pipeline on it, and shows the table of landmark displacements, the "
        "errors against the phantom's truth, and where the pictures are. SETTING=value changes a setting that `breast help settings` "
        "lists, such as PRESET=paper.")
    _case_options(d, "summary")
    d.examples += [("breast demo", "results in ./runs/average"),
                   ("breast demo PRESET=small ELEMENTS=6 'PHANTOM_OPTIONS=--coarse 2'", "a tiny breast, in about a minute")]


def _declare_cohort(d: Declaration) -> None:
    d.paragraphs.append(
        "Runs the pipeline on every case file of DIR (*.case, */case.txt, with one KEY = VALUE per line, where MR or PRESET names the "
        "scan). It continues after a case that fails, and ends with one table of all cases (cohort.tsv, cohort.html) and the contours of "
        "every segmentation (contours.html). File names in a case file are relative to the current folder. SETTING=value applies to all "
        "cases and overrides their files.")
    d.word("DIR", "folder of case files")
    _options(d, 1, "number of cases that may run at the same time; they share the cores")
    d.flag("--slurm", "submit the cases to Slurm as one job array, followed by a job that makes the table; --dry-run prints the script")
    d.flag("--local", "run the cases as processes on this machine (the default)")
    d.flag("--resume", "with --slurm, submit only the cases that are missing or out of date; runs on this machine always do so")
    d.text("--partition", "NAME", "with --slurm, the partition")
    d.text("--account", "NAME", "with --slurm, the account")
    d.text("--time", "T", "with --slurm, the time limit of a case in the format of sbatch, such as 45 (minutes) or 2:00:00 (default: "
           "estimated from measured cost)")
    d.text("--memory", "MB", "with --slurm, the memory of a case (default: estimated from measured cost)")
    d.text("--cores", "N", "with --slurm, the number of cores of a case (default: 1)")
    d.examples += [("breast cohort patients --jobs 4", "results in ./runs/cohort-patients"),
                   ("breast cohort patients --slurm --partition long --resume",
                    "a job array of the cases that are missing or out of date")]


def _declare(command: str, of_scan: bool = True) -> Declaration:
    """of_scan: whether a page is that of a scan."""
    declare = {"run": _declare_run, "demo": _declare_demo, "page": _declare_run if of_scan else _declare_demo,
               "cohort": _declare_cohort}.get(command)
    if declare is None:
        raise Failed(f"no command {command}")
    d = Declaration("breast " + command, COMMANDS[command])
    declare(d)
    if command in ("page", "cohort"):
        d.options = [option for option in d.options if option.label != "--target"]
        d.args.target = command
    return d


def pipeline_command(name: str) -> Declaration:
    """The declaration of `run`, `demo`, `page` or `cohort` for help and completion. Raises Failed for another name."""
    d = _declare(name)
    if name == "page":
        d.positionals[0].placeholder = "[SCAN]"
        d.paragraphs = ["Runs the pipeline as `breast run` does on a scan, or as `breast demo` if none is given, as far as the page RUN/page.html: "
                        "pointing at a place in one view shows the curve on which it lies in the other, with its band."]
        d.examples = [("breast page", "runs/average/page.html"),
                      ("breast page scan.nrrd --side left", "runs/scan-left/page.html, without the figures")]
    d.words("[SETTING=value]", "a setting of the pipeline: `breast help settings` lists them")
    return d


def _take_settings(tokens: Tokens, scan_first: bool, settings: dict[str, str]) -> None:
    """Moves SETTING=value words to the settings. The first word may be SCAN or DIR, whatever its name."""
    rest: list[str] = []
    for word in tokens.positionals:
        if not _SETTING.fullmatch(word) or (scan_first and not rest and os.path.exists(word)):
            rest.append(word)
            continue
        name, _, value = word.partition("=")
        if name in settings:
            raise BreastError(f"{name} is given twice")
        settings[name] = value
    tokens.positionals = rest


def _check(r: PipelineRequest) -> None:
    for name in ("RUNS", "RUN"):
        if name in r.settings:
            raise BreastError(f"{name} is not a setting here: give --runs DIR")
    scan = "COHORT" if r.command == "cohort" else "MR"
    if scan in r.settings:
        raise BreastError(f"{scan} is not a setting here: " +
                          ("breast run SCAN is for scans" if r.command == "demo" else "it is the first argument"))
    side = r.settings.get("SIDE")
    if r.of_scan and not r.side and side is None:
        one = next((name for name in ("CASE", "CASE_FILE") if name in r.settings), "")
        if one:
            raise BreastError(f"--side left|right is missing: {one} is of one breast; which one of the patient is it?")
    if r.side and side is not None and side != r.side:
        raise BreastError(f"--side {r.side} and SIDE={side} contradict each other")
    if r.slurm and r.local:
        raise BreastError("--slurm and --local contradict each other")
    cluster = next((name for name in sorted(r.settings) if name.startswith("CLUSTER_")), None)
    if cluster and not r.slurm:
        raise BreastError(f"{cluster}: is a request to Slurm; give --slurm")
    if r.slurm and r.jobs != 1:
        raise BreastError("--jobs: is for runs on this machine; with --slurm give --cores")
    if not re.fullmatch(r"[A-Za-z0-9][A-Za-z0-9-]*( [A-Za-z0-9][A-Za-z0-9-]*)*", r.target):
        raise BreastError(f"--target '{r.target}': is not the name of a target")


def _request_to_slurm(given: dict[str, object], settings: dict[str, str]) -> None:
    """What is asked of Slurm, as settings."""
    for name in ("partition", "account", "time", "memory", "cores"):
        setting = "CLUSTER_" + name.upper()
        if given.get(name) and setting in settings:
            raise BreastError(f"--{name} and {setting}= are both given")
        if given.get(name):
            settings[setting] = str(given[name])
    if given.get("resume"):
        settings["RESUME"] = "1"


def parse_request(command: str, words: Sequence[str]) -> PipelineRequest:
    """Raises BreastError for an unknown option, a superfluous word, a setting given twice, or a side that is missing or contradicted."""
    of_scan = command == "run"
    if command == "page":  # of a scan, if one is given
        named = tokenize(pipeline_command("run"), words).positionals
        of_scan = any(not _SETTING.fullmatch(word) or os.path.exists(word) for word in named)
    d, settings = _declare(command, of_scan), {}
    tokens = tokenize(d, words)
    _take_settings(tokens, bool(d.positionals), settings)
    assign(d, tokens)
    given = vars(d.args)
    _request_to_slurm(given, settings)
    r = PipelineRequest(command, given.get("scan") or given.get("dir", ""), given.get("side", ""), given["runs"], given["target"],
                        given["jobs"], given["dry_run"], given.get("slurm", False), given.get("local", False), settings)
    _check(r)
    if r.slurm:
        r.settings["CLUSTER"] = "slurm"
    return r
