#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A breast between plates, ours beside CalculiX's: press_breast.py GEOMETRY LABELS WORK [options of compress].

The body stands on a held wall, without skin and gravity, and is pressed (CC, frictionless, contact at nodes, K/mu 1000) to three
quarters of its thickness by compress. CalculiX is then given the nodes that touch, each moved along the normal of its plate as far as
ours moved and free along the plate, and has to find everything else: the forces of both plates and all other displacements. Prints
one row. BIN is the folder of our programs, ELEMENTS (10) what hexmesh takes; the files of both programs stay in WORK.
"""
from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np

BIN = Path(os.environ.get("BIN", "build/release/bin")).resolve()
ELEMENTS = os.environ.get("ELEMENTS", "10")
MODEL = ("--bulk-ratio", "1000", "--quiet")
COLUMNS = ("elements", "reduction_percent", "touching_nodes", "paddle_N", "ccx_paddle_N", "detector_N", "ccx_detector_N", "mean_mm", "max_mm",
           "largest_displacement_mm", "cpu_s", "ccx_cpu_s")


def run(work: Path, *words: object) -> float:
    """Runs a program in the folder and returns its CPU seconds."""
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    before = os.times()
    subprocess.run([str(word) for word in words], cwd=work, env=environment, check=True, stdout=subprocess.DEVNULL)
    after = os.times()
    return after.children_user - before.children_user + after.children_system - before.children_system


def our_solution(geometry: Path, labels: Path, work: Path, options: list[str]) -> float:
    run(work, BIN / "hexmesh", geometry, labels, "mesh.vtkhdf", "--elements", ELEMENTS, "--skin", "0", "--quiet")
    run(work, BIN / "backward", "mesh.vtkhdf", "reference.vtkhdf", "--posture", "prone", "--materials", "seed2008", "--wall", "held",
        "--cut", "free", "--estimate", "none", *MODEL)
    return run(work, BIN / "compress", "reference.vtkhdf", "cc.vtkhdf", "--view", "CC", "--reduction", "25", "--standoff", "20", "--friction",
               "0", "--contact-points", "nodes", "--positioning", "hanging", "--gravity", "off", "--threads", "1", "--quiet", *options)


class Plates:
    """The plates of a compressed shape, and the nodes on which they press."""

    def __init__(self, file: h5py.File) -> None:
        self.x, self.reference = file["VTKHDF/Points"][:], file["VTKHDF/PointData/reference"][:]
        plates = file["breast/contact/plates"]
        self.normal, self.anterior, self.origin = (plates[name][:] for name in ("normal", "anterior", "origin"))
        self.radius, self.force_N = plates["edge_radius"][:], plates["force_N"][:]
        self.reduction = float(file["breast/contact"].attrs["reduction_percent"])
        self.touching = np.flatnonzero(file["VTKHDF/PointData/contact_pressure"][:] > 0)

    def plate_of(self, node: int) -> int:
        return int(np.argmin([abs((self.x[node] - self.origin[k]) @ self.normal[k]) for k in (0, 1)]))

    def direction(self, node: int) -> np.ndarray:
        """The normal of the plate at a node, on its flat part or on its rounded edge."""
        k = self.plate_of(node)
        if (self.x[node] - self.origin[k]) @ self.anterior[k] >= 0:
            return self.normal[k]
        lateral = np.cross(self.normal[k], self.anterior[k])
        from_axis = self.x[node] - (self.origin[k] - self.radius[k] * self.normal[k])
        from_axis -= (from_axis @ lateral) * lateral
        return from_axis / np.linalg.norm(from_axis)


def write_deck(plates: Plates, work: Path) -> list[int]:
    """The deck of export-deck with the motion of the touching nodes. Returns these nodes, without those of the wall."""
    run(work, BIN / "export-deck", "reference.vtkhdf", "deck.inp", "--gravity", "0,0,0", "--calculix-element", "C3D8I", *MODEL)
    model = (work / "deck.inp").read_text().split("*STEP")[0]
    held = {int(word) - 1 for word in model.split("*NSET, NSET=HELD")[1].split("*")[0].replace(",", " ").split()}
    nodes = [int(node) for node in plates.touching if int(node) not in held]
    sets, axes, moved = "", "", ""
    for node in nodes:
        d = plates.direction(node)
        beside = np.cross(d, np.eye(3)[np.argmin(np.abs(d))])
        sets += f"*NSET, NSET=N{node + 1}\n{node + 1}\n"
        axes += f"*TRANSFORM, NSET=N{node + 1}, TYPE=R\n" + ",".join(f"{value:.12g}" for value in (*d, *beside)) + "\n"
        moved += f"{node + 1},1,1,{(plates.x[node] - plates.reference[node]) @ d:.10g}\n"
    sets += "*NSET, NSET=TOUCHING\n" + "".join(f"{node + 1}\n" for node in nodes)
    (work / "press.inp").write_text(
        f"{model}{sets}{axes}*STEP, NLGEOM, INC=10000\n*STATIC\n0.05,1.,1e-5,0.1\n*BOUNDARY\n{moved}"
        "*NODE PRINT, NSET=TOUCHING, FREQUENCY=10000, GLOBAL=YES\nRF\n*NODE FILE, FREQUENCY=10000, GLOBAL=YES\nU\n*END STEP\n")
    return nodes


def forces_of(work: Path, plates: Plates, nodes: list[int]) -> np.ndarray:
    """What CalculiX needs to hold the nodes of each plate, along its normal, N."""
    total = np.zeros((2, 3))
    for line in (work / "press.dat").read_text().splitlines():
        words = line.split()
        if len(words) == 4 and words[0].isdigit() and int(words[0]) - 1 in nodes:
            total[plates.plate_of(int(words[0]) - 1)] += [float(word) for word in words[1:]]
    return np.einsum("ki,ki->k", total, plates.normal) * 1e-6


def apart(work: Path) -> list[str]:
    """Mean and largest distance of CalculiX's nodes from ours, and our largest displacement, mm, as export-deck reads its result."""
    done = subprocess.run([BIN / "export-deck", "reference.vtkhdf", "ccx.vtkhdf", "--gravity", "0,0,0", "--read-back", "press.frd", "--base",
                           "cc.vtkhdf", *MODEL], cwd=work, capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"press_breast: {done.stderr.strip()}; see {work}/press.sta")
    return done.stdout.splitlines()[-1].split()[:3]


def main() -> None:
    if len(sys.argv) < 4:
        raise SystemExit("usage: press_breast.py GEOMETRY LABELS WORK [options of compress]")
    geometry, labels, work = (Path(word).resolve() for word in sys.argv[1:4])
    work.mkdir(parents=True, exist_ok=True)
    seconds = our_solution(geometry, labels, work, sys.argv[4:])
    with h5py.File(work / "cc.vtkhdf") as file:
        plates, elements = Plates(file), file["VTKHDF/Types"].shape[0]
    nodes = write_deck(plates, work)
    for name in ("press.dat", "press.frd"):
        (work / name).unlink(missing_ok=True)
    try:
        ccx_seconds = run(work, "ccx", "press")
    except subprocess.CalledProcessError:
        raise SystemExit(f"press_breast: CalculiX failed; see {work}/press.sta") from None
    force = forces_of(work, plates, nodes)
    row = (elements, f"{plates.reduction:.1f}", len(nodes), *(f"{value:.2f}" for k in (0, 1) for value in (plates.force_N[k], force[k])),
           *apart(work), f"{seconds:.2f}", f"{ccx_seconds:.1f}")
    print("\t".join(COLUMNS))
    print("\t".join(map(str, row)))


if __name__ == "__main__":
    main()
