# SPDX-License-Identifier: GPL-3.0-or-later
"""What was seen of a patient beside the scan: points in another posture, or a lesion's places in both mammograms."""
from __future__ import annotations

import re
from pathlib import Path

from ..errors import BreastError
from ..markups import read_fiducials, read_markups
from .table import NO_VALUE, Table, read_table

ENDINGS = (".tsv", ".mrk.json", ".fcsv")
POSTURES = ("stress_free", "supine", "cc", "mlo", "ml")
_WORD = re.compile(r"prone|supine", re.IGNORECASE)


def read_seen(file: Path) -> Table:
    """The table of points, or the marks of 3D Slicer as such a table. Raises BreastError for a file without points."""
    table = _of_marks(file) if file.name.endswith((".mrk.json", ".fcsv")) else read_table(file)
    if not table.rows:
        raise BreastError("has no points", file)
    if "landmark" not in table.columns:
        table.columns.insert(0, "landmark")
        for number, row in enumerate(table.rows, 1):
            row.insert(0, str(number))
    return table


def _of_marks(file: Path) -> Table:
    """Marks paired by their labels without the words prone and supine, as identify pairs them."""
    places: dict[str, dict[str, list[str]]] = {}
    for markup in (read_markups if file.name.endswith(".mrk.json") else read_fiducials)(file).values():
        for label, point in zip(markup.labels, markup.points):
            word = _WORD.search(label)
            name = _WORD.sub("", label).strip(" -_") or "mark"
            posture = word[0].lower() if word else "supine" if "prone" in places.get(name, {}) else "prone"
            if posture in places.setdefault(name, {}):
                raise BreastError(f"has two {posture} marks '{name}'", file)
            places[name][posture] = [f"{x:.6f}" for x in point]
    lone = next((name for name, at in places.items() if len(at) < 2), None)
    if lone is not None:
        raise BreastError(f"the mark '{lone}' has no partner in the other posture", file, "label them prone-NAME and supine-NAME")
    columns = ["landmark", *(f"{posture}_{axis}_mm" for posture in ("prone", "supine") for axis in "xyz")]
    return Table(columns, [[name, *at["prone"], *at["supine"]] for name, at in places.items()], str(file))


def of_side(seen: Table, side: str) -> Table:
    """The rows of a breast; a table without a column `side` is all of it."""
    if "side" not in seen.columns:
        return Table([*seen.columns, "side"], [[*row, side] for row in seen.rows], seen.name)
    at = seen.column("side")
    return Table(seen.columns, [row for row in seen.rows if row[at] == side], seen.name)


def postures_in(seen: Table) -> list[str]:
    """Postures, other than that of the scan, for which the table has positions. Raises BreastError if those in the scan are missing."""
    found = [posture for posture in POSTURES if f"{posture}_x_mm" in seen.columns]
    if found and "prone_x_mm" not in seen.columns:
        raise BreastError(f"has {found[0]}_x_mm and no prone_x_mm", seen.name,
                          "each point needs its place in the scan, prone_x_mm prone_y_mm prone_z_mm")
    return found


def pairs_in(seen: Table) -> str:
    """The unit of the places in both mammograms, "u_mm v_mm" or "x_px y_px"; "" if the table has none."""
    for unit in ("u_mm v_mm", "x_px y_px"):
        names = [f"{view}_{axis}" for view in ("cc", "mlo") for axis in unit.split()]
        given = [name for name in names if name in seen.columns]
        if not given:
            continue
        missing = [name for name in (*names, *(("cc_image", "mlo_image") if "px" in unit else ())) if name not in seen.columns]
        if missing:
            raise BreastError(f"has {given[0]} and no {missing[0]}", seen.name, "a lesion needs its place in both mammograms")
        return unit
    return ""


def by_case(points: Path, cases: list[str]) -> dict[str, Table]:
    """The tables of several cases: of a folder, CASE.tsv, CASE.mrk.json or CASE.fcsv; of one table, the rows by its column `case`.

    Raises BreastError for points of a case that is none of `cases`.
    """
    found: dict[str, Table] = {}
    if points.is_dir():
        for file in sorted(points.iterdir()):
            ending = next((e for e in ENDINGS if file.name.endswith(e)), None)
            if ending is None:
                continue
            case = file.name[:-len(ending)]
            if case in found:
                raise BreastError(f"has two files of the case {case}", points)
            found[case] = read_seen(file)
    else:
        table = read_seen(points)
        at = table.column("case")
        for row in table.rows:
            if row[at] == NO_VALUE:
                raise BreastError("has a row without a case", points)
            found.setdefault(row[at], Table(table.columns, [], table.name)).rows.append(row)
    foreign = next((case for case in found if case not in cases), None)
    if foreign is not None or not found:
        raise BreastError(f"has points of '{foreign}', which is none of the runs" if found else "has no points", points,
                          f"the runs are {', '.join(cases)}")
    return found
