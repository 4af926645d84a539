# SPDX-License-Identifier: GPL-3.0-or-later
"""What moves a predicted place by how many mm, and what accuracy costs: gathered from the tables of the validation pages."""
from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from statistics import median

from breast.errors import BreastError
from breast.study.kinds import Request, kind
from breast.study.table import NO_VALUE, Table, general, number_of, read_table

Row = dict[str, str]
TRUTH, FINER, CHOICE, AGAIN = "phantom's truth", "finer solution", "other assumption", "same breast again"
"""How a distance was measured: from a known place, or only from another result."""


@dataclass(frozen=True)
class _Source:
    """One row of the table: the column `value` in those rows of a table for which `where` holds, and what is taken of several."""

    words: str
    shape: str
    of: str
    measured: str
    table: str
    value: str
    where: Callable[[Row], bool]
    take: Callable[[list[float]], float] = max


def _view(name: str, variant: str) -> Callable[[Row], bool]:
    return lambda row: row["view"] == name and row["variant"] == variant


def _sources() -> Iterator[_Source]:
    yield _Source("backward undone by forward", "scan", "any node", AGAIN, "round-trips", "closure_mm", lambda row: row["percent"] == "100")
    yield _Source("field exported to 3D Slicer", "supine", "mean of points", FINER, "slicer-fields", "mean_mm",
                  lambda row: row["field"] == "scan-points-to-supine")
    for view in ("CC", "MLO"):
        yield _Source("half the steps of the plates", view, "tumour", FINER, "compression-steps", "tumour_mm",
                      _view(view, f"half-{view.lower()}"))
        yield _Source("twice as many elements", view, "tumour", FINER, "compression-mesh", "tumour_mm", _view(view, "16"))
        for friction in ("0.2", "0.4"):
            yield _Source(f"friction {friction} instead of 0.3", view, "tumour", CHOICE, "friction", "tumour_mm",
                          _view(view, f"friction-{friction}"))
    for shape, column in (("stress-free", "stress_free_error_mm"), ("supine", "supine_error_mm")):
        yield _Source("chain, wall held, stiffness known", shape, "tumour", TRUTH, "truth", column, lambda row: row["landmark"] == "true-tumour")
    for shape in ("stress_free", "supine", "cc", "mlo"):
        yield _Source("chain, sliding, stiffness unknown", shape.upper() if len(shape) < 4 else shape.replace("_", "-"), "mean of landmarks",
                      TRUTH, "truth-sliding", "error_mm", lambda row, shape=shape: (row["case"], row["shape"]) == ("average", shape))
    yield _Source("stiffness identified, right law", "supine", "mean of landmarks", TRUTH, "identification", "true_mm",
                  lambda row: row["study"] == "same")
    yield _Source("stiffness identified, wrong law", "supine", "mean of landmarks", TRUTH, "identification", "true_mm",
                  lambda row: row["study"] == "other")
    yield _Source("rolled, noisy, other voxels: median", "supine", "nipple", AGAIN, "same-scan", "supine_apart_mm",
                  lambda row: row["change"] != "unchanged" and "less" not in row["change"], median)
    yield _Source("30 mm less on one border: median", "supine", "nipple", AGAIN, "same-scan", "supine_apart_mm",
                  lambda row: "less" in row["change"], median)


def error_sources(folder: Path) -> Table:
    """One row a source of error, in the order of `_sources`.

    mm: how far it moves a place; of: which place, or over which the mean is taken; measured: against what; table: where it stands.
    Contributions of different rows must not be added: they are of different breasts, and some contain others.
    """
    made = Table(["source", "shape", "mm", "of", "measured", "table"])
    for source in _sources():
        values = [number for row in read_table(folder / f"{source.table}.tsv") if source.where(row) and
                  (number := number_of(row[source.value])) is not None]
        if not values:
            raise BreastError(f"has no value of {source.value} for '{source.words}' in {source.shape}", folder / f"{source.table}.tsv")
        made.rows.append([source.words, source.shape, general(source.take(values), 3), source.of, source.measured, source.table])
    return made


def methods_cost(folder: Path) -> Table:
    """One row a solution: method, elements, CPU seconds, error in mm, and against what it was measured.

    Prone to supine (cost.tsv): both solves, tumour or nipple against the finest solution. Between plates (compression-mesh.tsv): one view,
    tumour against the next finer mesh. Looked up (lookup-cost.tsv): all curves of a view on a grid, points between its nodes against their
    curves matched anew; a row is a pitch and states no elements. Identification (identification-cost.tsv): all of its solves, mean of the
    landmarks against the phantom's truth; mean over the laws of the truth.
    """
    made = Table(["method", "elements", "cpu_s", "error_mm", "measured"])
    for row in read_table(folder / "cost.tsv"):
        element, solver = row["element"].upper(), ", direct solver" if row["solver"] == "direct" else ""
        method = f"supine, {element[:2]}/{element[2:]} {row['template']}{solver}"
        made.rows.append([method, row["elements"], row["cpu_s"], row["supine_error_mm"], FINER])
    for row in read_table(folder / "compression-mesh.tsv"):
        made.rows.append([f"between plates, {row['view']}", row["elements"], row["cpu_seconds"], row["tumour_mm"], FINER])
    for row in read_table(folder / "lookup-cost.tsv"):
        made.rows.append(["curve looked up in MLO", NO_VALUE, row["cpu_s"], row["mean_mm"], FINER])
    by_elements: dict[str, list[tuple[float, float]]] = {}
    identification = read_table(folder / "identification-cost.tsv")
    for n, row in enumerate(identification):
        by_elements.setdefault(row["elements"], []).append((identification.number(n, "cpu_s"), identification.number(n, "true_mm")))
    for elements, pairs in by_elements.items():
        seconds, error = (general(sum(column) / len(pairs), 3) for column in zip(*pairs))
        made.rows.append(["stiffness identified, wrong law", elements, seconds, error, TRUTH])
    made.rows = [row for row in made.rows if number_of(row[3])]
    return made


@kind("error-sources", "TABLES", "what moves a predicted place by how many mm, from the tables of the validation pages in the folder TABLES")
def _error_sources(request: Request) -> Table:
    return error_sources(request.path(0))


@kind("methods-cost", "TABLES", "error and CPU time of all methods, from the tables of the validation pages in the folder TABLES")
def _methods_cost(request: Request) -> Table:
    return methods_cost(request.path(0))
