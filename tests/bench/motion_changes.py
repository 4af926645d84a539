#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How much each part of a material set matters for the motion to supine: motion_changes.py SET.tsv RUN... > borders-changes.tsv

Each RUN is the folder of one side with mesh.vtkhdf; its name is WOMAN-SIDE. Every row of the table is the set with one change, with
all sides solved backward and forward. Means are over the light women, each counted once; HEAVY=NAME (duke153) names the heavy one.
The largest change is that of a nipple's displacement from the set as it is, over all sides. BIN is the folder of the programs.
"""
from __future__ import annotations

import csv
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

BIN = Path(os.environ.get("BIN", "build/release/bin")).resolve()
HEAVY = os.environ.get("HEAVY", "duke153")
GRAVITY = 9806.65
MEANS = ("nipple_moved_mm", "nipple_lateral_mm", "nipple_posterior_mm", "moved_0_20_mm", "change_0_20_mm", "change_at_71_mm")
COLUMNS = ("change", "solved", *MEANS, "heavy_nipple_moved_mm", "largest_change_of_nipple_mm", "least_scaled_jacobian",
           "most_newton_iterations")
TISSUES = ("fat", "fibroglandular", "muscle", "tumour", "skin")
BORDERS = ("medial", "superior")


def supports(path: Path) -> tuple[str, str]:
    """The supports of wall and cut that a material set has, as the options --wall and --cut take them."""
    lines = (line for line in path.read_text().splitlines() if not line.startswith("#"))
    held = {row["tissue"]: row["support"] for row in csv.DictReader(lines, delimiter="\t") if row["law"] == "support"}
    return held["wall"], held["cut"]


def multiplied(support: str, part: str, factor: float) -> str:
    """The support with the resistance of one part multiplied: of a border, or ("") of what is named first."""
    pattern = rf"({part}=)([\d.e+-]+)" if part else r"(:)([\d.e+-]+)"
    changed, count = re.subn(pattern, lambda found: f"{found[1]}{float(found[2]) * factor:g}", support, count=1)
    if count == 0:
        sys.exit(f"motion_changes: the support {support} names no {part or 'resistance'}")
    return changed


def changes(wall: str, cut: str) -> dict[str, list[str]]:
    """Options of backward for every row; forward takes the model from the file."""
    rows: dict[str, list[str]] = {"as fitted": []}
    for word, factor in (("halved", 0.5), ("doubled", 2)):
        rows[f"wall {word}"] = ["--wall", multiplied(wall, "", factor)]
        rows[f"lateral and inferior {word}"] = ["--cut", multiplied(cut, "", factor)]
        for border in BORDERS:
            rows[f"{border} {word}"] = ["--cut", multiplied(cut, border, factor)]
    rows["power 4"] = ["--wall", f"{wall},P=4", "--cut", f"{cut},P=4"]
    rows["all borders as lateral"] = ["--cut", re.sub(rf",({'|'.join(BORDERS)})=[\d.e-]+", "", cut)]
    rows["laws halved"] = [word for tissue in TISSUES for word in ("--scale", f"{tissue}=50")]
    rows["gravity times 1.5"] = ["--gravity", f"0,{-1.5 * GRAVITY:g},0"]
    return rows


def solved(mesh: Path, materials: Path, options: list[str], work: Path) -> tuple[dict, dict] | None:
    """One side backward and forward: its motion (a row of `population`) and forward's report, or None."""
    shapes = [work / "reference.vtkhdf", work / "supine.vtkhdf"]
    report = work / "supine.json"
    supine = ["--gravity", f"0,{1.5 * GRAVITY:g},0"] if "--gravity" in options else ["--posture", "supine"]
    runs = ([BIN / "backward", mesh, shapes[0], "--materials", materials, *options, "--report", work / "reference.json"],
            [BIN / "forward", *shapes, *supine, "--report", report],
            [BIN / "population", shapes[1], "--table", work / "motion.tsv"])
    for run in runs:
        if subprocess.run([*map(str, run), "--quiet"], stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL).returncode != 0:
            return None
    motion = next(csv.DictReader((work / "motion.tsv").open(), delimiter="\t"))
    found = json.loads(report.read_text())
    backward = json.loads((work / "reference.json").read_text())
    found["most_iterations"] = max(found["newton_iterations"], backward["newton_iterations"])
    return {name: float(motion[name]) for name in MEANS}, found


def mean_over_women(motions: dict[str, dict], name: str) -> float:
    """The mean of `name`; the sides of one woman share her weight."""
    women: dict[str, list[float]] = {}
    for side, motion in motions.items():
        women.setdefault(side.rsplit("-", 1)[0], []).append(motion[name])
    return sum(sum(values) / len(values) for values in women.values()) / len(women) if women else float("nan")


def row(change: str, options: list[str], materials: Path, runs: list[Path], fitted: dict[str, float]) -> dict:
    """All sides with one change. `fitted` gets the nipples' displacements of the first row and is compared with afterwards."""
    motions, reports = {}, []
    for run in runs:
        with tempfile.TemporaryDirectory() as work:
            found = solved(run / "mesh.vtkhdf", materials, options, Path(work))
        if found:
            motions[run.name], report = found
            reports.append(report)
    if not motions:
        sys.exit(f"motion_changes: {change}: no side of {len(runs)} was solved")
    if not fitted:
        fitted.update({side: motion["nipple_moved_mm"] for side, motion in motions.items()})
    light = {side: motion for side, motion in motions.items() if not side.startswith(HEAVY)}
    heavy = {side: motion for side, motion in motions.items() if side.startswith(HEAVY)}
    changes_of_nipple = [abs(motions[side]["nipple_moved_mm"] - fitted[side]) for side in motions.keys() & fitted.keys()]
    return {"change": change, "solved": f"{len(motions)}/{len(runs)}", **{name: f"{mean_over_women(light, name):.1f}" for name in MEANS},
            "heavy_nipple_moved_mm": f"{mean_over_women(heavy, 'nipple_moved_mm'):.1f}",
            "largest_change_of_nipple_mm": f"{max(changes_of_nipple):.1f}",
            "least_scaled_jacobian": f"{min(report['min_scaled_jacobian'] for report in reports):.2f}",
            "most_newton_iterations": max(report["most_iterations"] for report in reports)}


def main(arguments: list[str]) -> int:
    materials, runs = Path(arguments[0]), [Path(run).resolve() for run in arguments[1:]]
    table = csv.DictWriter(sys.stdout, COLUMNS, delimiter="\t", lineterminator="\n")
    table.writeheader()
    fitted: dict[str, float] = {}
    for change, options in changes(*supports(materials)).items():
        table.writerow(row(change, options, materials, runs, fitted))
        sys.stdout.flush()
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
