#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Residuals and certainty of a calibrated set: fit_tables.py REPORT.json SET.tsv residuals|constants > TABLE.tsv

REPORT and SET are the report and the material set that calibrate-softness writes. Every breast is named WOMAN-SIDE. `residuals` has
one row for each quantity of the fit: women's mean, the standard deviation that the fit gave the difference, and the model's value
less women's, for all (as the fit weighs them) and for each woman (mean of her sides). `constants` has one row for each constant: its
value, the factor by which its 95 % interval reaches either way, the constant with which it is correlated most, and the largest factor
by which the fit without one of the women changes it.
"""
from __future__ import annotations

import csv
import json
import math
import sys
from pathlib import Path
from statistics import fmean


def residuals(report: dict) -> list[list[str]]:
    """Rows of the table of residuals, mm."""
    women: dict[str, list[dict[str, float]]] = {}
    for side, values in report["breasts"].items():
        women.setdefault(side.rpartition("-")[0], []).append(values)
    rows = [["quantity", "women", "sd_of_the_fit", "all", *women]]
    for quantity, data in report["data"].items():
        over = [fmean(side[quantity] for side in sides) - data["wanted"] for sides in women.values()]
        rows.append([quantity, f"{data['wanted']:g}", f"{data['sd']:.1f}", f"{data['found'] - data['wanted']:.1f}",
                     *(f"{value:.1f}" for value in over)])
    return rows


def constants(report: dict, material_set: Path) -> list[list[str]]:
    """Rows of the table of constants; factors have no unit."""
    with material_set.open(newline="") as lines:
        uncertain = {row["tissue"]: row for row in csv.DictReader(lines, delimiter="\t") if row["law"] == "uncertainty"}
    rows = [["constant", "value", "interval_95_factor", "most_correlated_with", "correlation", "largest_factor_without_a_woman"]]
    for name, row in uncertain.items():
        others = {other: float(row["correlation_" + other]) for other in uncertain if other != name}
        most = max(others, key=lambda other: abs(others[other]))
        without = max((fit[name + "_factor"] for fit in report["without"].values()), key=lambda factor: abs(math.log(factor)))
        rows.append([name, f"{report['softness'][name]:g}", f"{math.exp(1.96 * float(row['ln_sd'])):.1f}", most, f"{others[most]:.2f}",
                     f"{without:.2f}"])
    return rows


def main() -> None:
    if len(sys.argv) != 4 or sys.argv[3] not in ("residuals", "constants"):
        sys.exit(__doc__)
    report = json.loads(Path(sys.argv[1]).read_text())
    rows = residuals(report) if sys.argv[3] == "residuals" else constants(report, Path(sys.argv[2]))
    csv.writer(sys.stdout, delimiter="\t", lineterminator="\n").writerows(rows)


if __name__ == "__main__":
    main()
