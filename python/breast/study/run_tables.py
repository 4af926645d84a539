# SPDX-License-Identifier: GPL-3.0-or-later
"""All tables of a run in one call: the paper's Tables II to VI, the conclusions, and those that are not in the paper."""
from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from ..command.nearest import nearest
from ..errors import BreastError
from ..output import write_text
from .files import exists
from .findings import findings_table
from .kinds import Request, kind
from .paper_tables import constants_table, scaled_table
from .slopes import slopes_table
from .stage_report import variant_of
from .summary import aligned
from .table import Table, read_table
from .verdicts import judged_tables, survival_table

_TISSUES = {"table3": "fat", "table4": "fibroglandular", "table5": "skin", "table6": "tumour"}
_TITLES = {"table3": "Table III: fat", "table4": "Table IV: fibroglandular tissue", "table5": "Table V: skin",
           "table6": "Table VI: one element of tumour"}
_PRINTED = "-as-printed"


def makers(request: Request, run: Path, materials: Path) -> dict[str, Callable[[], Table]]:
    """What makes each table of RUN/tables, in an order in which none needs a later one."""
    paper, studies = request.pipelines / "paper", run / "studies"

    def scaled(number: str, ending: str) -> Table:
        folder, case = studies / f"scaled{ending}", variant_of(run, "findings", "as-printed") if ending else run
        base = folder / "tumour-100" if number == "table6" else case  # the rows of Table VI have a mesh of their own
        return scaled_table(read_table(paper / f"{number}.tsv"), folder / _TISSUES[number], base / "supine.vtkhdf", request.remark)

    def conclusions() -> Table:
        printed = exists(run / f"tables/table3{_PRINTED}.tsv")
        return judged_tables(read_table(paper / "conclusions.tsv"), run / "tables", printed)

    def slopes() -> Table:
        scaled = studies / "scaled"
        tables = (read_table(folder / "slopes.tsv") for folder in (run, scaled / "tumour-100"))
        return slopes_table(run / "supine.json", scaled, *tables)

    def survival() -> Table:
        sets = [name for name in variants("table8") if not name.endswith(("-100", "-1000", "-2000"))]
        return survival_table(*(read_table(paper / f"{name}.tsv") for name in ("conclusions", "table3", "table6")), run, sets,
                              request.remark)

    def variants(study: str) -> list[str]:
        return [row["variant"] for row in read_table(request.pipelines / f"studies/{study}.tsv")]

    made = {"table2": lambda: constants_table(read_table(paper / "table2.tsv"), read_table(materials))}
    for ending in ("", _PRINTED):
        made.update({number + ending: lambda n=number, e=ending: scaled(n, e) for number in _TISSUES})
    return {**made, "conclusions": conclusions, "table7": slopes, "table8": survival,
            "findings": lambda: findings_table(run, variants("findings"))}


@kind("tables", "RUN MATERIALS.tsv NAME...",
      "tables of a run in RUN/tables, all in one call: table2 to table8, table3-as-printed to table6-as-printed, conclusions, "
      "findings")
def _tables(request: Request) -> str:
    run, wanted = request.path(0), request.rest(2)
    made = makers(request, run, request.path(1))
    for name in wanted:
        if name not in made:
            near = nearest(name, made)
            raise BreastError(f"tables: '{name}' is none of {', '.join(made)}" + (f"; did you mean '{near}'?" if near else ""))
    (run / "tables").mkdir(parents=True, exist_ok=True)
    for name, make in made.items():
        if name in wanted:
            write_text(run / f"tables/{name}.tsv", make().text())
    return ""


@kind("show", "RUN", "Tables III to VI of a run beside the paper's, and which conclusions hold, for a terminal")
def _show(request: Request) -> str:
    tables, text = request.path(0) / "tables", ""
    for number, title in _TITLES.items():
        ours = read_table(tables / f"{number}.tsv")
        names = ("stiffness_percent", "tumour_mm", "paper_tumour_mm", "nipple_mm", "paper_nipple_mm")
        text += f"{title}, displacements from prone to supine\n{_columns(ours, names)}\n"
    judged = read_table(tables / "conclusions.tsv")
    return f"{text}Conclusions\n{_columns(judged, ('conclusion', 'lowest', 'highest', 'paper', 'ours', 'ours_verdict'))}"


def _columns(table: Table, names: tuple[str, ...]) -> str:
    rows = ["\t".join(names), *("\t".join(row[name] for name in names) for row in table)]
    return aligned("\n".join(rows))
