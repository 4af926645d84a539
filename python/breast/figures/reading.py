# SPDX-License-Identifier: GPL-3.0-or-later
"""The files that figures are drawn from."""
from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ..errors import BreastError
from ..labels import read_labels
from ..loading import load
from ..text_table import read_table
from ..volume import Volume
from .inputs import Inputs
from .of_run import PICTURES, RunPicture, pictures_of


def inputs_of_figure(files: Sequence[Path], scan: Volume | None, labels: Path | None) -> Inputs:
    """What the files of one figure hold."""
    inputs = Inputs(scan=scan, labels=read_labels(labels) if labels else None)
    for file in files:
        if file.suffix == ".tsv":
            inputs.tables.append(read_table(file))
        else:
            _add(inputs, file, _read(file))
    return inputs


def inputs_of_run(files: Sequence[Path], scan: Volume | None, labels: Path | None,
                  only: Sequence[str]) -> list[tuple[str, str, Inputs]]:
    """Name, figure and inputs of the pictures that files of a run allow (of_run.py), or of those named `only`.

    Each file is read once.
    """
    named = {file.name: file for file in files} | ({"labels.vtkhdf": labels} if labels else {})
    wanted = [picture for picture in pictures_of(named, scan is not None) if not only or picture.name in only]
    missing = next((picture for picture in PICTURES if picture.name in only and picture not in wanted), None)
    if missing:
        needed = [name for name in missing.files if name not in named] + ["--scan"] * (missing.scan and scan is None)
        raise BreastError(f"--only: {missing.name} needs {', '.join(needed)} too")
    if not wanted:
        raise BreastError(f"--all: no picture of a run is drawn from {', '.join(named)} alone",
                          None, "give files with the names they have in a run, such as mesh.vtkhdf and cc.vti")
    used = {name for picture in wanted for name in (*picture.files, *picture.also) if name in named}
    read = {name: read_labels(named[name]) if name == "labels.vtkhdf" else _read(named[name]) for name in sorted(used)}

    def inputs_of(picture: RunPicture) -> Inputs:
        inputs = Inputs(scan=scan, labels=read["labels.vtkhdf"]) if picture.scan else Inputs()
        for name in (*picture.files, *picture.also):
            if name in read and name != "labels.vtkhdf":
                _add(inputs, named[name], read[name])
        return inputs
    return [(picture.name, picture.figure, inputs_of(picture)) for picture in wanted]


def _add(inputs: Inputs, file: Path, content: Any) -> None:
    kind = type(content).__name__
    if kind == "Geometry":
        inputs.geometry = content
    elif kind == "dict":
        inputs.curves = content
    elif kind in ("State", "Mammogram", "XmlMesh"):
        {"State": inputs.states, "Mammogram": inputs.mammograms, "XmlMesh": inputs.clouds}[kind].append(content)
    else:
        raise BreastError(f"no figure is drawn from a file of this kind ({kind}) alone", file)


def _read(file: Path) -> Any:
    content = load(file)
    for line in (line for lines in content.values() for line in lines) if isinstance(content, dict) else ():
        for name in ("u_mm", "v_mm", "query"):
            if name not in line.arrays:
                raise BreastError(f"the file of curves has no PointData {name}", file, "make it with cc2mlo")
    return content
