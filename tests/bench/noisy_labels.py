#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Views of nearly the same breast: noisy_labels.py RUN WORK SEED...

RUN is a finished run with labels, cc.json and mlo.json. For each seed, 15 % of the voxels on either side of the skin's surface become
air or skin, and the labels go through fit-hermite, hexmesh, backward and compress with every default. Prints one row a view: the
unchanged labels (seed 0), then each seed. Nothing that the labels really show has changed, so that the rows should agree. BIN is the
folder of the programs, ELEMENTS (10) what hexmesh takes.
"""
from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))
from breast.state import TISSUES  # noqa: E402

BIN = Path(os.environ.get("BIN", "build/release/bin")).resolve()
ELEMENTS = os.environ.get("ELEMENTS", "10")
AIR, SKIN = TISSUES.index("air"), TISSUES.index("skin")
CHANGED = 0.15
"""Fraction of the voxels on either side of the surface that change."""
COLUMNS = ("breast", "view", "seed", "status", "thickness_mm", "paddle_N", "contact_percent", "paddle_edge_percent", "detector_edge_percent",
           "iterations")


def beside(voxels: np.ndarray) -> np.ndarray:
    """Voxels that share a face with one of `voxels`; all of shape (z, y, x)."""
    found = np.zeros_like(voxels)
    for axis in range(3):
        lower = [slice(None)] * 3
        upper = [slice(None)] * 3
        lower[axis], upper[axis] = slice(None, -1), slice(1, None)
        found[tuple(lower)] |= voxels[tuple(upper)]
        found[tuple(upper)] |= voxels[tuple(lower)]
    return found


def add_noise(labels: Path, noisy: Path, seed: int) -> None:
    shutil.copy(labels, noisy)
    with h5py.File(noisy, "r+") as file:
        data = file["VTKHDF/PointData/tissue"]
        tissue = data[:]
        air, skin = tissue == AIR, tissue == SKIN
        drawn = np.random.default_rng(seed).random((2, *tissue.shape)) < CHANGED
        lost, gained = skin & beside(air) & drawn[0], air & beside(skin) & drawn[1]
        tissue[lost], tissue[gained] = AIR, SKIN
        data[...] = tissue


def press(noisy: Path) -> None:
    """Writes cc.json and mlo.json beside the labels."""
    def run(program: str, *words: str) -> None:
        subprocess.run([BIN / program, *words, "--threads", "1", "--quiet"], cwd=noisy.parent, check=program != "compress")

    run("fit-hermite", noisy.name, "geometry.vtkhdf")
    run("hexmesh", "geometry.vtkhdf", noisy.name, "mesh.vtkhdf", "--elements", ELEMENTS, "--muscle", "measured", "--surroundings", "16",
        "--tumour", "none")
    run("backward", "mesh.vtkhdf", "reference.vtkhdf", "--posture", "prone")
    for view in ("CC", "MLO"):
        run("compress", "reference.vtkhdf", f"{view.lower()}.vtkhdf", "--view", view, "--keep-unconverged", "--estimate", "none", "--report",
            f"{view.lower()}.json")


def row(breast: str, view: str, seed: int, report: Path) -> str:
    found = json.loads(report.read_text())
    plates = found["plates"]
    numbers = (f"{found['thickness_mm']:.1f}", f"{found['force_N']:.1f}", f"{found['coverage']['contact_percent_of_projected']:.0f}",
               *(f"{plates[plate]['edge_force_percent']:.0f}" for plate in ("paddle", "detector")), str(found["newton_iterations"]))
    return "\t".join((breast, view, str(seed), found["status"], *numbers))


def main() -> None:
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    run, work, seeds = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve(), [int(seed) for seed in sys.argv[3:]]
    folders = {0: run}
    for seed in seeds:
        folders[seed] = work / str(seed)
        folders[seed].mkdir(parents=True, exist_ok=True)
        add_noise(run / "labels.vtkhdf", folders[seed] / "labels.vtkhdf", seed)
        press(folders[seed] / "labels.vtkhdf")
    print("\t".join(COLUMNS))
    for view in ("CC", "MLO"):
        for seed, folder in folders.items():
            print(row(run.name, view, seed, folder / f"{view.lower()}.json"))


if __name__ == "__main__":
    main()
