# SPDX-License-Identifier: GPL-3.0-or-later
"""The program render."""
from __future__ import annotations

import subprocess
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..command.nearest import suggestion
from ..command.tool import Run, Tool
from ..errors import BreastError
from ..output import check_replaceable, write_bytes
from ..programs import ended, started
from . import FIGURES
from .of_run import PICTURES

if TYPE_CHECKING:
    from .inputs import Inputs

_ENDINGS = (".vtkhdf", ".vti", ".vtp", ".tsv")


def main() -> int:
    tool = Tool("render", "pictures of shapes, plates, mammograms and tables")
    tool.describe("Draws figures without a screen: for surfaces the tool starts and stops an X server of its own (Xvfb), whatever "
                  "DISPLAY says. All views are parallel projections with a scale bar in mm; L, A and S mark the patient's left, "
                  "anterior and superior directions.")
    tool.describe("The figures, and the files that each needs, are:")
    for name, figure in FIGURES.items():
        tool.describe(f"{name}: {figure.summary}.")
    tool.cite("Pathmanathan et al. 2008, IEEE Trans Biomed Eng 55(10), Figs 4 to 7")
    tool.words("FILE", "meshes (.vtkhdf), mammograms (.vti), points or curves (.vtp), a table (.tsv); all of one breast, except "
                       "for outlines", "input")
    tool.input_file("--scan", "MR", "MR scan behind the contours of slices and summary (.nrrd, .nii, .nii.gz, .mha or a DICOM "
                                    "folder)")
    tool.integer("--series", "series of a DICOM folder (0: the only one)", 0, 0, 100000)
    tool.input_file("--labels", "LABELS.vtkhdf", "segmentation of that scan (segment)")
    tool.choice("--figure", tuple(FIGURES), "figure to draw", "mesh")
    tool.output_file("-o,--output", "OUT.png", "the picture")
    tool.output_folder("--all", "instead of --figure and --output: all pictures of a run that its files, given with the names they have in "
                                "a run, allow; as FOLDER/NAME.png")
    tool.text("--only", "NAME,...", "with --all: these pictures alone, of " + ", ".join(p.name for p in PICTURES))
    tool.choice("--accept-other", ("model",), "accept files that otherwise are refused because they do not belong "
                                              "together (docs/pairs.md). model: FILE.vti and FILE.vtp, of different models")
    tool.check(lambda: _check(tool.args))
    tool.example("render mesh.vtkhdf --figure slices --scan scan.nrrd --labels labels.vtkhdf -o slices.png",
                 "the scan in three planes through the tumour, with the contours of the segmentation")
    tool.example("render mesh.vtkhdf --figure tissues -o tissues.png",
                 "fibroglandular tissue and tumour through a translucent skin")
    tool.example("render cc.vti mlo.vti curve.vtp --figure mammogram -o mammograms.png",
                 "both mammograms with the matched curve")
    tool.example("render mesh.vtkhdf reference.vtkhdf supine.vtkhdf --all figures", "all pictures that these three shapes allow")
    return tool.main(_render)


def _check(args: Any) -> None:
    if bool(args.scan) != bool(args.labels):
        raise BreastError("--scan and --labels must be given together")
    if bool(args.output) == bool(args.all):
        raise BreastError("give either --output OUT.png or --all FOLDER" if args.all else
                          "-o, --output OUT.png is missing; usage: render FILE... -o OUT.png [options]")
    names = [picture.name for picture in PICTURES]
    for name in args.only.split(",") if args.only else []:
        if name not in names or not args.all:
            raise BreastError(f"--only: '{name}' is none of {', '.join(names)}{suggestion(name, names)}" if args.all else
                              "--only needs --all FOLDER")
    for file in args.file:
        if Path(file).suffix not in _ENDINGS:
            raise BreastError(f"{file}: render reads .vtkhdf, .vti, .vtp and .tsv files")


def _render(run: Run) -> None:
    args = run.args
    pairs = _started_pairs(args)  # they are checked, in C++, while they are read here
    try:
        drawn = _inputs(args)
    except BreastError:
        _finish_pairs(pairs, run)
        raise
    _finish_pairs(pairs, run)
    targets = [Path(args.all) / f"{name}.png" if args.all else Path(args.output) for name, _, _ in drawn]
    for target in targets:
        check_replaceable(target, "--all" if args.all else "--output")
    _draw(drawn, targets)
    run.report["figure"] = args.figure if not args.all else [name for name, _, _ in drawn]


def _inputs(args: Any) -> list[tuple[str, str, Inputs]]:
    """Name, figure and inputs of every picture."""
    from ..loading import load_scan
    from .reading import inputs_of_figure, inputs_of_run
    files, labels = [Path(file) for file in args.file], Path(args.labels) if args.labels else None
    scan = load_scan(args.scan, args.series) if args.scan else None
    if args.all:
        return inputs_of_run(files, scan, labels, args.only.split(",") if args.only else [])
    return [(args.figure, args.figure, inputs_of_figure(files, scan, labels))]


def _draw(drawn: list[tuple[str, str, Inputs]], targets: list[Path]) -> None:
    """Draws pictures (name, figure, inputs), on a display if one of them needs it, and writes each."""
    from contextlib import nullcontext

    from . import draw
    if any(FIGURES[figure].in_space for _, figure, _ in drawn):
        from .scene import display
        screen = display()
    else:
        screen = nullcontext()
    with screen:
        for (_, figure, inputs), target in zip(drawn, targets):
            content = draw(figure, inputs).png()
            target.parent.mkdir(exist_ok=True)
            write_bytes(target, content)


def _started_pairs(args: Any) -> subprocess.Popen[bytes] | None:
    """Checks that the files are of one breast; only outlines may compare several, and tables are of none."""
    files = [file for file in args.file if not file.endswith(".tsv") and (args.all or args.figure != "outlines")]
    named = [*(f"first FILE={file}" for file in files[:1]), *(f"FILE={file}" for file in files)]
    named += [f"FILE.vti={file}" for file in files if file.endswith(".vti")]
    if args.all or not FIGURES[args.figure].of_points:
        named += [f"FILE.vtp={file}" for file in files if file.endswith(".vtp") and Path(file).name != "points.vtp"]
    if args.scan:
        named += [f"--labels={args.labels}", f"--scan={args.scan}"]
    if not named:
        return None
    accepted = ["--accept-other", args.accept_other] if args.accept_other else []
    return started("pairs", ["render", "--series", str(args.series), *accepted, *(f"--check={name}" for name in named)])


def _finish_pairs(child: subprocess.Popen[bytes] | None, run: Run) -> None:
    for remark in ended("pairs", child)[1] if child is not None else []:
        run.remark(remark)
