# SPDX-License-Identifier: GPL-3.0-or-later
"""Summaries of studies with many solves: coverage of a band, identification of parameters, extreme cases."""
from __future__ import annotations

import math
from dataclasses import dataclass, field
from pathlib import Path

from breast.errors import BreastError
from breast.study.kinds import Request, kind
from breast.study.table import NO_VALUE, Row, Table, fixed, general, number_of, or_dash, read_table
from breast.text_table import parse_number, read_text

# ---- coverage of a band ----------------------------------------------------------------------------------------------

_HALF_50, _HALF_95 = 0.6744897502, 1.9599639845
"""Half-widths of the 50 and 95 % bands of a normal distribution, in standard deviations."""
_Z = 1.96  # rounded as for the intervals


def coverage(held: list[int], places: list[int]) -> tuple[float, float, float]:
    """The percentage of `held` among all places, both given per sample, with its 95 % interval.

    Errors of places in one sample are correlated, so that the interval is computed from the scatter between samples. For a single
    sample it is the binomial interval (Wilson 1927), as if its places were independent.
    """
    n, samples = sum(places), len(places)
    if not n > 0:
        return 0.0, 0.0, 0.0
    p = sum(held) / n
    if samples == 1:
        half = _Z * math.sqrt(p * (1 - p) / n + _Z * _Z / (4 * n * n)) / (1 + _Z * _Z / n)
        mean = (p + _Z * _Z / (2 * n)) / (1 + _Z * _Z / n)
    else:
        scatter = sum((h - p * m) ** 2 for h, m in zip(held, places))
        mean, half = p, _Z * math.sqrt(scatter * samples / (samples - 1)) / n
    return 100 * p, max(0.0, 100 * (mean - half)), min(100.0, 100 * (mean + half))


def quantile(values: list[float], part: float) -> float:
    """The value below which the fraction `part` of the values lies, as the nearest value in ascending order; 0 without values."""
    if not values:
        return 0.0
    order = int(part * len(values) + 0.5)
    return sorted(values)[min(max(order, 1), len(values)) - 1]


@dataclass
class BandRows:
    """Places of a band: sample, distance of the true position across the curve, standard deviation according to the band; mm.

    failed: the number of samples without a solution.
    """

    name: str
    places: list[tuple[str, float, float]] = field(default_factory=list)
    failed: int = 0


def read_band_rows(text: str, name: str) -> BandRows:
    """The output of band_check and band_truth: lines with sample, place, distance and deviation, and "# sample ..." for a sample that
    failed. Raises BreastError naming line and file."""
    rows = BandRows(name)
    for number, line in enumerate(text.split("\n"), 1):
        rows.failed += line.startswith("# sample")
        if not line or line.startswith("#"):
            continue
        cells, where = line.split("\t"), f"{name}, line {number}"
        if len(cells) < 4:
            raise BreastError(f"line {number} has {len(cells)} columns, not sample, place, distance, deviation", name)
        rows.places.append((cells[0], parse_number(cells[2], where), parse_number(cells[3], where)))
    if not rows.places:
        raise BreastError("contains no places", name)
    return rows


def coverage_table(files: list[BandRows]) -> Table:
    """One row a file: solved and failed samples; places, and the percentages of them inside the 50 and 95 % bands with their 95 %
    intervals; root mean square distance, true and according to the band; quantiles divided by the band's half-widths."""
    table = Table(["rows", "samples", "failed", "places", "in_50_percent", "in_50_from", "in_50_to", "in_95_percent", "in_95_from",
                   "in_95_to", "rms_mm", "band_rms_mm", "half_50_ratio", "half_95_ratio"])
    for rows in files:
        samples: dict[str, list[int]] = {}  # places, those in the 50 % band, those in the 95 % band
        for sample, distance, deviation in rows.places:
            counts = samples.setdefault(sample, [0, 0, 0])
            for which, half in enumerate((math.inf, _HALF_50, _HALF_95)):
                counts[which] += abs(distance) <= half * deviation if which else 1
        places, narrow, wide = (list(counts) for counts in zip(*samples.values()))
        ratios = [abs(distance) / deviation if deviation else math.inf for _, distance, deviation in rows.places]
        n = len(rows.places)
        rms = [math.sqrt(sum(row[which] ** 2 for row in rows.places) / n) for which in (1, 2)]
        table.rows.append([rows.name, str(len(places)), str(rows.failed), str(n),
                           *(fixed(value, 1) for held in (narrow, wide) for value in coverage(held, places)),
                           *(fixed(value, 2) for value in rms), fixed(quantile(ratios, 0.5) / _HALF_50, 2),
                           fixed(quantile(ratios, 0.95) / _HALF_95, 2)])
    return table


@kind("coverage", "ROWS.tsv...", "percentage of true positions inside the band, with its 95 % interval")
def _coverage(request: Request) -> Table:
    return coverage_table([read_band_rows(read_text(file), Path(file).stem) for file in request.words])


# ---- identification of parameters ------------------------------------------------------------------------------------

_DRAWN = ("pairs", "cpu_s", "converged", "identifiable", "within_10_percent", "within_2_sd", "directions", "all_within_2_sd",
          "motion_mm", "left_out_mm", "true_mm")


def identification_table(studies: list[Table]) -> Table:
    """Summarises the rows of identification_study, one row a study, truth and mesh: means over the draws; the number of directions in
    the space of parameters that the data determine to within 5 %, and the percentages of these directions in which the result lies
    within 10 % of the truth and within two standard deviations of it; the latter percentage for all directions; and the percentage
    of draws in which the misfit test at 5 % indicates another model."""
    groups: dict[tuple[str, str, str], list[dict[str, float]]] = {}
    for table in studies:
        for r in range(len(table.rows)):
            key = (table.cell(r, "study"), table.cell(r, "truth"), table.cell(r, "elements"))
            # A cell is "-" if it is not part of this study.
            numbers = {column: _number(table, r, column) for column in (*_DRAWN, "probability")}
            groups.setdefault(key, []).append(numbers)
    return Table(["study", "truth", "draws", "elements", "settled", "pairs", "pairs_most", "cpu_s", "known_5_percent",
                  "within_10_percent_%", "within_2_sd_%", "all_within_2_sd_%", "moved_mm", "left_out_mm", "true_mm",
                  "true_worst_mm", "alarms_%"], [_draws_row(*key, draws) for key, draws in groups.items()])


def _draws_row(study: str, truth: str, elements: str, draws: list[dict[str, float]]) -> Row:
    total = {column: sum(draw[column] for draw in draws) for column in _DRAWN}
    mean = {column: value / len(draws) for column, value in total.items()}
    most = {column: max(0.0, *(draw[column] for draw in draws)) for column in _DRAWN}
    surface, known = study.startswith("surface"), total["identifiable"]
    alarms = sum(draw["probability"] < 0.05 for draw in draws)
    return [study, truth, str(len(draws)), elements, general(total["converged"]), fixed(mean["pairs"], 1), general(most["pairs"]),
            fixed(mean["cpu_s"], 1), general(known) if total["directions"] > 0 else NO_VALUE,
            _share(total["within_10_percent"], known), _share(total["within_2_sd"], known),
            _share(total["all_within_2_sd"], total["directions"]), fixed(mean["motion_mm"], 0),
            NO_VALUE if surface else fixed(mean["left_out_mm"], 2), fixed(mean["true_mm"], 2), fixed(most["true_mm"], 2),
            NO_VALUE if surface else _share(alarms, len(draws))]


def _share(part: float, whole: float) -> str:
    return fixed(100 * part / whole, 0) if whole > 0 else NO_VALUE


def _number(table: Table, row: int, column: str) -> float:
    return number_of(table.cell(row, column)) or 0.0


@kind("identification", "ROWS.tsv...", "results of identify for known truths, one row per study and truth")
def _identification(request: Request) -> Table:
    return identification_table([read_table(file) for file in request.words])


# ---- extreme cases ---------------------------------------------------------------------------------------------------


@dataclass
class Outcome:
    """The cases of one direction with one outcome."""

    cases: int = 0
    worst_residual: float = 0.0
    least_det_F: float = 0.0
    most_newton: float = 0.0
    seconds: float = 0.0
    which: list[str] = field(default_factory=list)


def stability_table(mechanics: Table, contact: Table) -> Table:
    """One page with the tables of extreme cases: a row for every direction (for compression only one) and outcome, with the number of
    cases, their worst values, the seconds of all, and the names of those that did not converge or ended otherwise than their case
    states."""
    outcomes: dict[tuple[str, str], Outcome] = {}
    for table, solve in ((mechanics, ""), (contact, "compression")):
        for r in range(len(table.rows)):
            # Only contact cases have a verdict.
            as_stated = not solve or "verdict" not in table.columns or table.cell(r, "verdict") == "success"
            ended = table.cell(r, "outcome")
            key = (solve or table.cell(r, "direction"), ended if as_stated else f"{ended}, not as stated")
            _add_case(outcomes.setdefault(key, Outcome()), table, r, as_stated and ended == "converged")
    rows = []
    for (solve, ended), o in outcomes.items():
        reached = o.least_det_F > 0  # a scene refused before its first state has neither residual nor det F
        rows.append([solve, ended, str(o.cases), f"{o.worst_residual:.1e}" if reached else NO_VALUE,
                     fixed(o.least_det_F, 3) if reached else NO_VALUE, general(o.most_newton), fixed(o.seconds, 1),
                     or_dash("; ".join(o.which))])
    return Table(["solve", "outcome", "cases", "worst_residual", "least_det_F", "most_newton", "seconds", "which"], rows)


def _add_case(outcome: Outcome, table: Table, row: int, plain: bool) -> None:
    outcome.cases += 1
    outcome.worst_residual = max(outcome.worst_residual, _number(table, row, "residual"))
    det_F = _number(table, row, "min_det_F")
    if det_F > 0 and (outcome.least_det_F == 0 or det_F < outcome.least_det_F):
        outcome.least_det_F = det_F
    outcome.most_newton = max(outcome.most_newton, _number(table, row, "newton"))
    outcome.seconds += _number(table, row, "seconds")
    if not plain:
        outcome.which.append(table.cell(row, "case"))


@kind("stability", "MECHANICS.tsv CONTACT.tsv", "one page with the outcome of every extreme case")
def _stability(request: Request) -> Table:
    return stability_table(request.table(0), request.table(1))
