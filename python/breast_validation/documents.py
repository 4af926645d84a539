# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables in the pages of docs/, the runs from which they were made, and the numbers that pages state."""
from __future__ import annotations

import subprocess
import time
from collections.abc import Callable
from pathlib import Path

from breast.errors import BreastError, Failed
from breast.output import write_text
from breast.study.advice import extended_pattern
from breast.study.kinds import Request, kind
from breast.study.report import machine
from breast.study.stage_report import StageReport
from breast.study.summary import lines_of
from breast.study.table import NO_VALUE, Table, one_line, or_dash, table_if_any
from breast.text_table import read_text

_RUNS = Path("docs/tables/runs.tsv")
_BEGIN, _CLOSE, _END = "<!-- table ", " -->", "<!-- end of table -->"


def markdown_table(tsv: str, name: str) -> str:
    """Tab-separated text as a Markdown table; `name` is used in errors."""
    rows = [line.split("\t") for line in lines_of(tsv) if line not in ("", "\r") and not line.startswith("#")]
    if not rows:
        raise BreastError("contains no table", name)
    lines = ["|" + "".join(f" {or_dash(cell)} |" for cell in row) + "\n" for row in rows]
    return "".join([lines[0], "|" + "---|" * len(rows[0]) + "\n", *lines[1:]])


def with_tables(page: str, name: str, read: Callable[[str], str], run_of: Callable[[str], str]) -> str:
    """The page with the contents of FILE (tab-separated) as Markdown between its lines `<!-- table FILE -->` and
    `<!-- end of table -->`, and below each table what `run_of` says about the run that made it.

    Raises BreastError naming the page if a table has no end, or the table if it has no row.
    """
    text, inside = [], ""
    for line in lines_of(page):
        if line == _END:
            inside = ""
        if inside:
            continue
        text.append(line + "\n")
        file = line[len(_BEGIN):-len(_CLOSE)] if line.startswith(_BEGIN) and line.endswith(_CLOSE) else ""
        if file and " " not in file:
            inside = file
            text.append(f"\n{markdown_table(read(file), file)}\n{run_of(file)}\n\n")
    if inside:
        raise BreastError(f"the table {inside} has no end", name, f"close it with {_END}")
    return "".join(text)


def run_line(runs: Table, file: str) -> str:
    """One line about the run that made a table, as recorded in `runs`: date, commit and machine."""
    date, commit, machine = (runs.at(Path(file).name, column) for column in ("date", "commit", "machine"))
    if date in ("", NO_VALUE):
        return "Run: not recorded."
    return "Not from a run." if date == "none" else f"Run: {date}, commit {commit}, {machine}."


def with_run(runs: Table, file: str, date: str, commit: str, machine: str) -> Table:
    """A copy of `runs` with these values in the row of `file`, sorted by the name of the table."""
    row = [Path(file).name, date, commit, machine]
    return Table(runs.columns, sorted([*(other for other in runs.rows if other[0] != row[0]), row]), runs.name)


def wrong_numbers(numbers: Table) -> list[str]:
    """One sentence for every row of docs/numbers.tsv in which the number in the page differs from that in its source.

    Patterns are extended regular expressions with one group, the number; a source may be a folder.
    """
    wrong = []
    for r in range(len(numbers.rows)):
        page, pattern, source, source_pattern = (
            numbers.cell(r, column) for column in ("page", "page_pattern", "source", "source_pattern"))
        said, decided = _stated(Path(page), pattern), _stated(Path(source), source_pattern)
        if not said or said != decided:
            wrong.append(f"{page} says '{said or 'nothing'}' for {pattern}; "
                         f"{source} has '{decided or 'nothing'}' for {source_pattern}")
    return wrong


def _stated(source: Path, pattern: str) -> str:
    """The first match of the pattern's group; "" without a match."""
    wanted = extended_pattern(pattern, "numbers")
    files = sorted(file for file in source.rglob("*") if file.is_file()) if source.is_dir() else [source]
    for file in filter(Path.is_file, files):
        for line in lines_of(read_text(file)):
            found = wanted.search(line)
            if found and wanted.groups:
                return found[1] or ""
    return ""


def _commit_here() -> str:
    """The commit of the source tree in which this program runs, marked "-dirty" if it has uncommitted changes outside docs, where
    the table that is being made is a change itself.
    """
    commit = _git("describe", "--always", "--exclude", "*")
    changed = _git("diff", "--no-relative", "--name-only", "HEAD", "--", ":(top)", ":(top,exclude)docs")
    return commit + "-dirty" if changed else commit


def _git(*words: str) -> str:
    said = subprocess.run(["git", *words], capture_output=True, text=True, check=False)
    if said.returncode != 0:
        raise Failed(f"git {words[0]}: {one_line(said.stderr)}")
    return said.stdout.partition("\n")[0]


def _date_of(file: Path) -> str:
    """That in a report, or the date on which a table was written."""
    if file.suffix == ".json":
        date = StageReport.read(file).text("date")
        if not date:
            raise BreastError("has no date of a run", file)
        return date.partition("T")[0]
    if not file.exists():
        raise BreastError("does not exist", file)
    return time.strftime("%Y-%m-%d", time.gmtime(file.stat().st_mtime))


@kind("made", "TABLE.tsv RESULT",
      "record in docs/tables/runs.tsv of the date, commit and machine of the run from which a table of the pages was made; RESULT is "
      "one of its reports or tables")
def _made(request: Request) -> str:
    runs = table_if_any(_RUNS) or Table(["table", "date", "commit", "machine"])
    write_text(_RUNS, with_run(runs, request.word(0), _date_of(request.path(1)), _commit_here(), machine()).text())
    return ""


@kind("pages", "fill|check PAGE.md...", "tables between the marks of pages, written again (fill) or compared (check)")
def _pages(request: Request) -> str:
    fill = request.word(0) == "fill"
    if not fill and request.word(0) != "check":
        raise BreastError(f"pages: '{request.word(0)}' is neither fill nor check")
    runs, pages = table_if_any(_RUNS) or Table(["table"]), ""
    for name in request.rest(1):
        page = read_text(name)
        filled = with_tables(page, name, read_text, lambda file: run_line(runs, file))
        pages += page
        if filled == page:
            continue
        if not fill:
            raise Failed("its tables are not those of docs/tables: make -f Makefile.pipeline validation-page", name)
        write_text(name, filled)
    for file in [] if fill else sorted(_RUNS.parent.glob("*.tsv")):
        if file != _RUNS and f"{_BEGIN}{file}{_CLOSE}" not in pages:
            raise Failed("stands in no page", file)
    return ""


@kind("numbers", "NUMBERS.tsv", "whether the numbers in pages agree with their sources")
def _numbers(request: Request) -> str:
    wrong = wrong_numbers(request.table(0))
    if wrong:
        raise Failed("; ".join(wrong))
    return ""
