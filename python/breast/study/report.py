# SPDX-License-Identifier: GPL-3.0-or-later
"""The report of a finished case: one self-contained HTML page with its pictures inline, so that it can be sent, and its PDF."""
from __future__ import annotations

import os
import re
import subprocess
import tempfile
import time
from pathlib import Path

from .. import __version__
from ..cases.compression import views_without_compression
from ..errors import BreastError, Failed
from ..output import write_bytes
from ..text_table import read_text
from .advice import CHAIN_STAGES, Warned, own_advice, warnings_of
from .files import exists
from .findings import calibration_note
from .html import Block, Section, figure, page, table, table_of, table_of_text, text
from .kinds import Request, kind
from .report_words import FIGURES, MOTION, NOTES
from .stage_report import StageReport
from .summary import lines_of, tumour_origin
from .table import fixed, general, number_of, or_dash, read_table


def report_page(run: Path, runs: Path, warned: list[Warned], limits: list[str], note: str, made: str) -> str:
    """All text from reports, tables and settings is escaped, and no folder is named.

    Args:
        runs: folder of all runs, with stability/ and compare/.
        limits: what is not reproduced, and why, one paragraph each.
        note: a sentence beside the rows that were fitted to the paper; may be empty.
        made: time, version and machine.
    """
    origin = tumour_origin(StageReport.read(run / "mesh.json"))
    tumour = {"none": "", "artificial": "the artificial tumour", "given": "the tumour"}[origin]
    first = [_picture(run, name, tumour) for name in ("slices", "summary")]
    sections = [_landmarks(run, note), _motion(run), Section("Compression", [_compression(run)]), *_figures(run, tumour),
                *_paper_tables(run / "tables", note), *_own_tables(run, note), *_studies(run, runs),
                Section("Expected values", [table_of(run / "verify.tsv")]), _cost(run), _commands(run),
                Section("What is not reproduced, and why", [Block("list", (limits,))])]
    return page("report", title=f"libbreast: {run.name}", style="report.css", name=run.name, made=made, warnings=warned,
                failed=views_without_compression(run),
                artificial=origin == "artificial", first=first, sections=sections)


def _picture(run: Path, name: str, tumour: str) -> Block | None:
    """A picture with its caption, in which {and x|y} stands for the words x if a tumour is followed, else for y."""
    caption = re.sub(r"\{([^|}]*)\|?([^}]*)\}", lambda words: words[1].replace("TUMOUR", tumour) if tumour else words[2],
                     FIGURES[name][1])
    return figure(run / "figures" / f"{name}.png", caption)


def _landmarks(run: Path, note: str) -> Section:
    section = Section("Landmarks", [table_of(run / "displacements.tsv"), text("Supine: ", note, ".") if note else None])
    if exists(run / "truth.tsv"):
        lines = [line for line in lines_of(read_text(run / "truth.tsv")) if not line.startswith("#")]
        names = ("nipple", "true-tumour", "mean", "largest")
        rows = [line for n, line in enumerate(lines) if n == 0 or line.partition("\t")[0] in names]
        section.blocks += [text(NOTES["truth"]), table_of_text("\n".join(rows))]
    return section


def _motion(run: Path) -> Section:
    """The motion from prone to supine (tool population) beside that of living women; nothing for a breast whose wall is held."""
    if not exists(run / "population.tsv"):
        return Section("")
    rows = [[MOTION.get(row["quantity"], row["quantity"]), *(row[c] for c in ("mean", "women_mean", "women_sd", "within_one_sd"))]
            for row in read_table(run / "population.tsv")]
    return Section("This breast beside living women",
                   [text(NOTES["motion"]), table(["quantity", "this breast", "women", "SD", "within one SD"], rows),
                    figure(run / "figures/motion.png", "Motion of tissue, and change of its distance from the ribs, by its depth.")])


def _compression(run: Path) -> Block:
    keys = ("status", "thickness_mm", "reduction_percent", "force_N", "detector_force_N", "pressure_kPa", "area_cm2",
            "newton_iterations", "error_estimate_mm")
    names = ["view", "status", "thickness mm", "reduction %", "paddle force N", "detector force N", "mean pressure kPa", "area cm2",
             "Newton iterations", "error estimate mm"]
    reports = {view: StageReport.read(run / f"{view.lower()}.json") for view in ("CC", "MLO")}
    return table(names, [[view, *(_short(report.text(key)) for key in keys)] for view, report in reports.items()])


def _short(value: str) -> str:
    """A number with a decimal point with four digits; any other text unchanged."""
    number = number_of(value)
    return general(number, 4) if number is not None and "." in value else or_dash(value)


def _figures(run: Path, tumour: str) -> list[Section]:
    titles = dict.fromkeys(title for title, _ in FIGURES.values() if title)
    sections = {title: Section(title) for title in titles}
    for name, (title, _) in FIGURES.items():
        if title:
            sections[title].blocks.append(_picture(run, name, tumour))
    return list(sections.values())


def _paper_tables(tables: Path, note: str) -> list[Section]:
    """Tables II to VI and the conclusions."""
    if not exists(tables / "table2.tsv"):
        return []
    sections = [Section("Table II: constants of law (9)", [table_of(tables / "table2.tsv")])]
    titles = {"3": "III: fat", "4": "IV: fibroglandular tissue", "5": "V: skin", "6": "VI: one element of tumour"}
    for number, title in titles.items():
        own, printed = table_of(tables / f"table{number}.tsv"), tables / f"table{number}-as-printed.tsv"
        blocks: list[Block | None] = [text(NOTES["scaled"], f" Row of 100 %: {note}." if note else "")]
        if exists(printed):
            blocks += [_heading("As printed in the paper: cuboid, plain invariants, skin as a layer of elements"), table_of(printed),
                       _heading("As solved here")]
        sections.append(Section(f"Table {title}", [*blocks, own]))
    judged = [text(NOTES["conclusions"]), table_of(tables / "conclusions.tsv")]
    return [*sections, Section("The paper's conclusions, in numbers", judged)]


def _own_tables(run: Path, note: str) -> list[Section]:
    """Tables that are not in the paper."""
    tables = run / "tables"
    again = sum(StageReport.read(file).number("cpu_seconds") or 0 for file in sorted((run / "studies/scaled").glob("*/*.json"))
                if file.stem.endswith(("reference", "supine")) and not file.name.startswith("."))
    seventh = (NOTES["table7"], " Cost: ", fixed(StageReport.read(run / "slopes.json").number("cpu_seconds"), 2),
               f" CPU seconds for all slopes, and {again:.0f} for the solves of the tables.")
    found = (("table7", "Table VII, ours: every slope from one solve", seventh),
             ("table8", "Table VIII, ours: do the conclusions survive another stiffness?", (NOTES["table8"],)),
             ("findings", "Numerical part of the results",
              (NOTES["findings"], f" Default and as printed: {note}." if note else "")))
    return [Section(title, [text(*words), table_of(tables / f"{name}.tsv")]) for name, title, words in found
            if exists(tables / f"{name}.tsv")]


def _studies(run: Path, runs: Path) -> list[Section]:
    """Tables and plots of the slow targets, with the dates of their files: error against run time, stability and parts left out,
    or the command that makes them, and the others that were run."""
    def both(folder: Path) -> list[Path]:
        return [file for ending in ("tsv", "png") for file in sorted(folder.glob(f"[!.]*.{ending}"))]

    found = (("cost", both(run / "cost")), ("stability", [runs / f"stability/{n}.tsv" for n in ("summary", "mechanics", "contact")]),
             ("leaveout", [run / "leaveout/table.tsv", run / "leaveout/recommendation.tsv"]), ("budget", both(run / "budget")),
             ("compare", [runs / "compare/all.tsv", runs / "compare/pressed.tsv"]),
             ("population", [runs / "population/judging.tsv", runs / "population/motion.png"]))
    sections = []
    for name, files in found:
        title, _, said = NOTES[name].partition(": ")
        made = [file for file in files if exists(file)]
        blocks = [block for file in made for block in (
            _heading(file.stem, file), figure(file, file.name) if file.suffix == ".png" else table_of(file))]
        missing = [text(NOTES["not made"].replace("GOAL", name))] if name in ("cost", "stability", "leaveout") else []
        sections.append(Section(title, [text(said), *blocks] if made else missing))
    return sections


def _heading(title: str, dated: Path | None = None) -> Block:
    date = time.strftime("%Y-%m-%d %H:%M UTC", time.gmtime(dated.stat().st_mtime)) if dated else ""
    return Block("small_heading", (title, date))


def _cost(run: Path) -> Section:
    reports = {stage: StageReport.read(run / f"{stage}.json") for stage in CHAIN_STAGES}
    rows = [[stage, fixed(report.number("seconds/total"), 2), fixed(report.number("peak_mb"), 0)]
            for stage, report in reports.items() if report]
    return Section("Cost", [table(["stage", "seconds", "peak MB"], rows)])


def _commands(run: Path) -> Section:
    """Program and settings of every stage, without the folders in them: a page that is sent must not describe this machine."""
    said = [f"{file.name[1:-len('.settings')]}: {without_folders(read_text(file)).rstrip(chr(10))}\n"
            for file in sorted(run.glob(".*.settings"))]
    return Section("Commands", [text("Program and settings of every stage:"), Block("pre", ("".join(said),))])


def without_folders(words: str) -> str:
    return re.sub(r"[^ ,=:\n]*/", "", words)


def processor() -> str:
    """The name of the processor."""
    with open("/proc/cpuinfo", encoding="utf-8", errors="replace") as file:
        names = (line.partition(": ")[2].strip("\n") for line in file if line.startswith("model name"))
        return next((name for name in names if name), "a processor without a name")


def machine() -> str:
    return f"{os.cpu_count()} cores, {processor()}"


@kind("report", "RUN RUNS", "one self-contained HTML page of a finished case; RUNS contains stability/ and compare/")
def _report(request: Request) -> str:
    run = request.path(0)
    if not run.is_dir():
        raise BreastError("is not the folder of a run", run)
    made = (f"Made {time.strftime('%Y-%m-%d %H:%M UTC', time.gmtime())}\nwith libbreast {__version__}, BLAS "
            f"{StageReport.read(run / 'reference.json').text('blas')}, {machine().replace(', ', ' (', 1)}).")
    limits = lines_of(read_text(request.pipelines / "limits.txt"))
    return report_page(run, request.path(1), warnings_of(run, own_advice(request)), limits,
                       calibration_note(request.calibrated, request.side), made)


@kind("pdf", "CHROMIUM PAGE.html OUT.pdf", "that page as a PDF file, printed by CHROMIUM")
def _pdf(request: Request) -> str:
    """A headless Chromium with a temporary profile prints the page.

    Its sandbox remains on unless this process runs as root, since Chromium then refuses to start with it. Scripts are forbidden by
    the content security policy of the page itself, because Chromium 156 prints nothing if they are switched off by an option. No
    network is reachable.
    """
    with tempfile.TemporaryDirectory() as work:
        made = Path(work) / "out.pdf"
        words = ["timeout", "120", request.word(0), "--headless", *(["--no-sandbox"] if os.geteuid() == 0 else []),
                 "--proxy-server=127.0.0.1:9", "--disable-gpu", "--disable-dev-shm-usage", f"--user-data-dir={work}/profile",
                 "--no-pdf-header-footer", f"--print-to-pdf={made}", f"file://{request.path(1).resolve(strict=True)}"]
        said = subprocess.run(words, capture_output=True, text=True, errors="replace", check=False)
        if said.returncode != 0 or not exists(made):
            raise Failed(f"{request.word(0)} made no PDF of {request.word(1)}: {said.stderr}")
        write_bytes(request.word(2), made.read_bytes())
    return ""
