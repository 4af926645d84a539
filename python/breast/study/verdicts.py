# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's conclusions as numbers, and whether they hold for several models.

A verdict is a row of pipelines/paper/conclusions.tsv, with two bounds and where in the paper they come from, and a function @measure
of the same name here, which measures a model.
"""
from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from .paper_tables import scaled_table
from .shapes import moved
from .slopes import slope_between, slope_cell
from .stage_report import StageReport, posture_failure_of, variant_of
from .table import NO_VALUE, Row, Table, fixed, number_of, or_dash, read_table, table_if_any

TISSUES = ("fat", "fibroglandular", "skin")
_OF_TABLE = {"fat": 0, "fibroglandular": 1, "skin": 2}


@dataclass(frozen=True)
class Model:
    """What a verdict measures.

    Attributes:
        slope: d ln u / d ln s of a tissue (first argument) at a landmark, as a cell.
        stiff: Table VI, the rows of a stiff tumour.
        prefix: of the columns nipple_mm and tumour_mm of this model in `stiff`.
        run: its folder with mammograms and curve, or None.
    """

    slope: Callable[[str, str], str]
    stiff: Table
    prefix: str = ""
    run: Path | None = None

    def change(self, percent: str, landmark: str) -> str:
        """Change of a landmark's displacement by a stiff tumour, per cent."""
        column = f"{self.prefix}{landmark}_mm"
        here, base = self.stiff.number_at(percent, column), self.stiff.number_at("100", column)
        return NO_VALUE if here is None or not base or base < 0 else fixed(100 * (here / base - 1), 3)


MEASURES: dict[str, Callable[[Model], str]] = {}


def measure(name: str) -> Callable[[Callable[[Model], str]], Callable[[Model], str]]:
    def declared(function: Callable[[Model], str]) -> Callable[[Model], str]:
        MEASURES[name] = function
        return function

    return declared


def _slope_measures(landmark: str) -> None:
    for tissue in TISSUES:
        measure(f"{tissue}_{landmark}")(lambda model, tissue=tissue: model.slope(tissue, landmark))

    @measure(f"order_{landmark}")
    def order(model: Model) -> str:
        """1 if fat matters more than three times as much as fibroglandular tissue, and that more than skin."""
        fat, gland, skin = (number_of(model.slope(tissue, landmark)) for tissue in TISSUES)
        if fat is None or gland is None or skin is None:
            return NO_VALUE
        return "1" if abs(fat) > 3 * abs(gland) and abs(gland) > abs(skin) else "0"


_slope_measures("nipple")
_slope_measures("tumour")


@measure("tumour_1000")
def _tumour_1000(model: Model) -> str:
    return model.change("1000", "tumour")


@measure("tumour_2000")
def _tumour_2000(model: Model) -> str:
    return model.change("2000", "nipple")


def _inside_image(model: Model, view: str) -> str:
    """Distance of the tumour from the nearest edge of the simulated mammogram, mm; negative outside."""
    report = StageReport.read(model.run / f"{view}-mammogram.json") if model.run else StageReport()
    place = report.find(f"landmarks/{report.landmark('tumour')}/uv_mm")
    pixel, *pixels = (report.number(key) for key in ("pixel_mm", "width_pixels", "height_pixels"))
    if place is None or pixel is None or None in pixels:
        return NO_VALUE
    return fixed(min(min(at, pixel * count - at) for at, count in zip(place, pixels)), 1)


@measure("fig6_cc")
def _fig6_cc(model: Model) -> str:
    return _inside_image(model, "cc")


@measure("fig6_mlo")
def _fig6_mlo(model: Model) -> str:
    return _inside_image(model, "mlo")


@measure("fig6_curve")
def _fig6_curve(model: Model) -> str:
    """Share of the length of the tumour's curve that lies in the MLO image, per cent."""
    return fixed(StageReport.read(model.run / "curve.json").number("inside_image_percent") if model.run else None, 1)


@measure("fig7_bend")
def _fig7_bend(model: Model) -> str:
    """How far the tumour's curve in the MLO image bends away from its chord, per cent of its length."""
    report = StageReport.read(model.run / "curve.json") if model.run else StageReport()
    bend, length = report.number("max_bend_mm"), report.number("curve_mm")
    return fixed(100 * bend / length if bend is not None and length else None, 1)


def measured(model: Model) -> Table:
    """Columns conclusion, value: one row a measure, "-" without a solution."""
    return Table(["conclusion", "value"], [[name, function(model)] for name, function in MEASURES.items()])


def model_of_rows(tables: list[Table], prefix: str = "", run: Path | None = None) -> Model:
    """From the rows of 90 and 110 per cent of Tables III, IV and V, and Table VI; columns PREFIXnipple_mm and PREFIXtumour_mm."""
    def slope(tissue: str, landmark: str) -> str:
        low, high = (tables[_OF_TABLE[tissue]].number_at(percent, f"{prefix}{landmark}_mm") for percent in ("90", "110"))
        return fixed(slope_between(90, low, 110, high), 4) if low and high and low > 0 and high > 0 else NO_VALUE

    return Model(slope, tables[3], prefix, run)


def model_of_slopes(slopes: Table | None, stiff: Table, run: Path | None = None) -> Model:
    """From slopes written by `sensitivity --table` (None: no solution), and from Table VI."""
    return Model(lambda tissue, landmark: slope_cell(slopes, landmark, tissue, 4) if slopes else NO_VALUE, stiff, run=run)


def judge(conclusions: Table, models: dict[str, Table]) -> Table:
    """The bounds of the conclusions, their source, and for every model its value and verdict: holds, fails, not evaluated."""
    for values in models.values():
        values.column("value")  # raises for a table of another kind
    table = Table(["conclusion", "lowest", "highest", "source", *(c for name in models for c in (name, f"{name}_verdict"))])
    for r in range(len(conclusions.rows)):
        low, high = (conclusions.number(r, bound) for bound in ("lowest", "highest"))
        row = [conclusions.cell(r, column) for column in ("text", "lowest", "highest", "source")]
        for values in models.values():
            value = or_dash(values.at(conclusions.cell(r, "conclusion"), "value"))
            number = number_of(value)
            row += [value, "not evaluated" if number is None else "holds" if low <= number <= high else "fails"]
        table.rows.append(row)
    return table


def judged_tables(conclusions: Table, folder: Path, printed: bool) -> Table:
    """judge() for Tables III to VI in the folder RUN/tables: for the paper's values, ours as printed (if `printed`), and ours for the
    case, with its mammograms and its curve."""
    own = _scaled_tables(folder)
    models = {"paper": measured(model_of_rows(own, "paper_"))}
    if printed:
        models["as_printed"] = measured(model_of_rows(_scaled_tables(folder, "-as-printed")))
    return judge(conclusions, {**models, "ours": measured(model_of_rows(own, run=folder.parent))})


def survival_table(conclusions: Table, third: Table, sixth: Table, run: Path, sets: list[str], remark: str) -> Table:
    """Table VIII: whether each material set has a stress-free body, its supine displacements, and judge() for the paper, the run
    and the sets, which are the variants SET and SET-tumour-PERCENT of RUN/studies/table8.

    Args:
        third, sixth: Tables III and VI of the paper.
    """
    folders = {name: variant_of(run, "table8", name) for name in sets}
    failures = {name: posture_failure_of(folder) for name, folder in folders.items()}
    own = _scaled_tables(run / "tables")
    models = {"paper": model_of_rows(own, "paper_"), "ours": model_of_slopes(table_if_any(run / "slopes.tsv"), own[3], run)}
    for name, folder in folders.items():
        models[name] = model_of_slopes(table_if_any(folder / "slopes.tsv"), _stiff_rows(sixth, folder))
    table = judge(conclusions, {name: measured(model) for name, model in models.items()})
    body = ["stress-free body of the imaged shape", "-", "-", "-", "-", "", "yes", ""]
    for failure in failures.values():
        body += ["yes", ""] if failure is None else ["no", failure]
    first: list[Row] = [body]
    for landmark in ("nipple", "tumour"):
        row = [f"supine displacement of the {landmark}, mm", "-", "-", "-", third.at("100", f"{landmark}_mm"), "",
               fixed(moved(run / "supine.vtkhdf", landmark), 4), remark]
        for name, folder in folders.items():
            row += [fixed(moved(folder / "supine.vtkhdf", landmark), 4) if failures[name] is None else NO_VALUE, ""]
        first.append(row)
    table.rows[:0] = first
    return table


def _scaled_tables(folder: Path, ending: str = "") -> list[Table]:
    return [read_table(folder / f"table{n}{ending}.tsv") for n in (3, 4, 5, 6)]


def _stiff_rows(sixth: Table, folder: Path) -> Table:
    """The rows of Table VI that the conclusions need: a tumour with 1, 10 and 20 times its stiffness."""
    wanted = Table(sixth.columns, [row for row in sixth.rows if row[0] in ("100", "1000", "2000")], sixth.name)
    prefix = folder.with_name(folder.name + "-tumour")
    return scaled_table(wanted, prefix, prefix.with_name(prefix.name + "-100") / "supine.vtkhdf", "")
