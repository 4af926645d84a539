# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables II to VI of Pathmanathan et al. (2008), with our results beside the paper's; material sets as the studies change them."""
from __future__ import annotations

from pathlib import Path

from ..errors import BreastError, Failed
from .kinds import Request, kind
from .shapes import apart, moved
from .stage_report import StageReport, posture_failure_of
from .table import NO_VALUE, Table, fixed, general, number_of, or_dash

QUANTITIES = ("tumour_mm", "tumour_rel_mm", "nipple_mm", "nipple_rel_mm")
CONSTANTS = ("a10_Pa", "a01_Pa", "a20_Pa", "a02_Pa", "a11_Pa")


def scaled_table(paper: Table, prefix: Path, base: Path, remark: str) -> Table:
    """One of Tables III to VI: displacements of tumour and nipple, and their difference from the base, mm.

    Our results are those of PREFIX-PERCENT/supine.vtkhdf for every stiffness (per cent) of the paper's table, and of `base` for
    100; "-" where the material has no solution. Without a base no row has any. `remark` stands in the row of 100. Raises Failed
    naming a file that is missing.
    """
    table = Table(["stiffness_percent", *(p + q for q in QUANTITIES for p in ("", "paper_", "difference_")), "estimate_mm", "remark"])
    for r, (percent, *_) in enumerate(paper.rows):
        whole = percent == "100"
        variant = prefix.with_name(f"{prefix.name}-{percent}")
        file = base if whole else variant / "supine.vtkhdf"
        if base.exists() and file.exists():
            ours = [f(file) for f in (lambda f: moved(f, "tumour"), lambda f: apart(f, base, "tumour"),
                                      lambda f: moved(f, "nipple"), lambda f: apart(f, base, "nipple"))]
            cells = [(fixed(mm, 3), paper.cell(r, q), fixed(mm - paper.number(r, q), 3)) for q, mm in zip(QUANTITIES, ours)]
            estimate = fixed(StageReport.read(file.with_suffix(".json")).number("error_estimate_mm"), 3)
        elif posture_failure_of(variant) is not None:
            cells = [(NO_VALUE, paper.cell(r, q), NO_VALUE) for q in QUANTITIES]
            estimate = NO_VALUE
        else:
            raise Failed("is missing", file)
        table.rows.append([percent, *(c for three in cells for c in three), estimate, remark if whole and remark else NO_VALUE])
    return table


def constants_table(paper: Table, materials: Table) -> Table:
    """Table II: the polynomial constants of a material set beside the paper's, Pa."""
    table = Table(["tissue", "constant", "used", "paper", "difference"])
    for r in range(len(paper.rows)):
        tissue = paper.cell(r, "tissue")
        for constant in CONSTANTS:
            used = or_dash(materials.at(tissue, constant))
            ours = number_of(used)
            difference = NO_VALUE if ours is None else general(ours - paper.number(r, constant))
            table.rows.append([tissue, constant, used, paper.cell(r, constant), difference])
    return table


def changed_set(materials: Table, change: str) -> Table:
    """A copy of a material set with one change.

    `fat-only`: fibroglandular tissue has the law of fat. `columns`: the three columns of second-order constants in Table II, a20,
    a02 and a11, are taken for a11, a20 and a02, as Samani and Plewes are sometimes quoted. Raises BreastError for another change,
    and for a set without a row or column that the change needs.
    """
    changed = Table(materials.columns, materials.rows, materials.name)
    if change == "fat-only":
        gland, fat = _row_of(changed, "fibroglandular"), _row_of(changed, "fat")
        gland[:] = fat
        gland[changed.column("tissue")] = "fibroglandular"
    elif change == "columns":
        a20, a02, a11 = map(materials.column, ("a20_Pa", "a02_Pa", "a11_Pa"))
        for row, old in zip(changed.rows, materials.rows):
            row[a11], row[a20], row[a02] = old[a20], old[a02], old[a11]
    else:
        raise BreastError(f"'{change}' is not a change of a material set; give fat-only or columns")
    return changed


def _row_of(materials: Table, tissue: str) -> list[str]:
    column = materials.column("tissue")
    for row in materials.rows:
        if row[column] == tissue:
            return row
    raise BreastError(f"has no row for the tissue {tissue}, which this change needs", materials.name,
                      "add one, or use a set that has it (seed2008)")


@kind("set", "fat-only|columns MATERIALS.tsv", "a material set as a study changes it")
def _set(request: Request) -> Table:
    return changed_set(request.table(1), request.word(0))
