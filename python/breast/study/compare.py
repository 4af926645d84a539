# SPDX-License-Identifier: GPL-3.0-or-later
"""compare: two runs beside each other, as a table and as a page."""
from __future__ import annotations

import os
import shutil
from pathlib import Path

from ..command.tool import Run, Tool
from ..errors import BreastError, Failed
from ..output import check_replaceable, write_text
from .compare_page import compare_page
from .compared_runs import TOPICS, Pair
from .summary import aligned
from .table import number_of


def declaration() -> Tool:
    tool = Tool("compare", "two runs beside each other: landmarks, views, the breast, the curve, and what differs in the model")
    tool.describe(
        "Compares two finished runs, as of one breast with two material sets, with labels drawn by two people, or by two versions of these "
        "programs. For every quantity that both runs have, the table gives both values and their difference; for a place, the distance in "
        "mm. Of settings and model it has only what differs.")
    tool.describe(
        "Places are LPS mm in the frame of the scan; those on an image are u (from its edge at the chest wall) and v. Where a run "
        "states an estimate of its discretisation error at a landmark, it stands beside the distance: a distance that is not larger says "
        "nothing. The curve is that of cc2mlo, and the distance is between the two curves in the plane of the second image.")
    tool.describe(
        "If the runs are of different sides or scans, places and curves are left out and one line says so; volumes, density and what "
        "the plates do are still compared. Runs that have no stage in common are refused.")
    tool.word("FIRST", "folder of a run (runs/CASE)")
    tool.word("SECOND", "folder of another run")
    tool.output_folder("--out", "write compare.html, one self-contained page with the pictures of both runs side by side, and compare.tsv "
                                "to this folder")
    tool.check(lambda: _check(tool.args.first, tool.args.second))
    tool.example("compare runs/average runs/average-wellman", "what another material set changes")
    tool.example("compare runs/scan-left old/scan-left --out difference", "the same as a page with pictures: difference/compare.html")
    return tool


def _check(first: str, second: str) -> None:
    for label, folder in (("FIRST", first), ("SECOND", second)):
        if not Path(folder).is_dir():
            raise BreastError(f"{label}: {folder} is not a folder")
    if os.path.samefile(first, second):
        raise BreastError(f"SECOND: {second} is the same folder as FIRST; give another run")


def _printed(pair: Pair) -> str:
    names = pair.names()
    parts = [f"first: {names[0]}\nsecond: {names[1]}\n"]
    for topic, title in TOPICS.items():
        rows = pair.of_topic(topic)
        if rows:
            header = ["quantity", "unit", "first", "second", *(["difference", "first_error", "second_error"] if topic == "landmarks" else
                                                               ["difference"] if topic != "model" else [])]
            lines = ["\t".join(header), *("\t".join(getattr(row, name) for name in header) for row in rows)]
            parts.append(f"\n{title}\n" + aligned("\n".join(lines) + "\n"))
    if not pair.of_topic("model"):
        parts.append("\nNothing differs in settings and model.\n")
    return "".join(parts)


def _write(pair: Pair, folder: Path) -> None:
    """Both files, or neither of them and no folder that was not there before."""
    page, table = compare_page(pair), pair.table().text() + "\r\n"
    found = folder.exists()
    try:
        folder.mkdir(exist_ok=True)
    except OSError as error:
        raise Failed(f"could not be made: {error.strerror}", folder) from None
    for name in ("compare.html", "compare.tsv"):
        check_replaceable(folder / name, "--out")
    try:
        write_text(folder / "compare.html", page)
        write_text(folder / "compare.tsv", table)
    except Failed:
        if not found:
            shutil.rmtree(folder, ignore_errors=True)
        raise


def _compare(run: Run) -> None:
    pair = Pair(Path(run.args.first), Path(run.args.second))
    text = _printed(pair)
    for remark in pair.remarks:
        run.remark(remark)
    run.report["differences"] = {row.quantity: number_of(row.difference) for row in pair.rows if number_of(row.difference) is not None}
    run.report["model"] = {row.quantity: [row.first, row.second] for row in pair.of_topic("model")}
    if run.args.out:
        _write(pair, Path(run.args.out))
        text += f"\nThe page: {run.args.out.rstrip('/')}/compare.html (a browser opens it)\n"
    run.print(text)


def main() -> int:
    return declaration().main(_compare)
