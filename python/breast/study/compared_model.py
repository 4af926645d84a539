# SPDX-License-Identifier: GPL-3.0-or-later
"""In which settings and in which parts of the model two runs differ, from their reports and from what their files record."""
from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields
from pathlib import Path

from ..hdf5 import file_schema, read_document
from ..history import read_history
from ..records import Model, read_model
from .stage_report import StageReport
from .table import NO_VALUE, general, number_of, one_line, parse_table

STAGES = {"labels": "segmentation", "geometry": "surfaces", "mesh": "mesh", "reference": "stress-free", "supine": "supine", "cc": "CC",
          "mlo": "MLO", "ml": "ML", "cc-mammogram": "CC image", "mlo-mammogram": "MLO image", "ml-mammogram": "ML image",
          "curve": "curve", "lookup": "lookup"}
"""Reports of a run in the order of the chain, with the name of what each made."""
_SHAPES = ("reference", "supine", "cc", "mlo", "ml")
_MODEL = {"name": "material set", "element": "element", "invariants": "invariants", "bulk_ratio": "bulk ratio", "wall": "chest wall",
          "cut": "lateral cut"}
_REPORTED = {"labels": ("posture", "contrast", "interior", "nipple"),
             "mesh": ("tumour", "step", "elements", "order", "skin_mm", "muscle_mm", "surroundings_mm"), "cc": ("angle_deg",),
             "mlo": ("angle_deg",), "ml": ("angle_deg",)}
"""What a stage chose, or was given by a file, and says in its report."""
_AS_FAT = ("air", "other")
_FILES = "files"


def scan_of(run: Path) -> tuple[str, str] | None:
    """Name and SHA-256 of the scan that was segmented; None if no file of the run records it, as where people drew all labels."""
    for name in ("labels", "mesh", "reference", "supine"):
        file = run / f"{name}.vtkhdf"
        if file.exists():
            history = read_history(read_document(file, file_schema(file), ("/breast/",)))
            return next(((c.inputs[0].name, c.inputs[0].sha256) for c in history if c.tool == "segment" and c.inputs), None)
    return None


def differences(first: Path, second: Path) -> list[tuple[str, str, str]]:
    """Rows of what, in the first run, in the second run; "-" where a run does not state it. A difference that several stages share is
    one row, which names them."""
    found: dict[tuple[str, str, str], list[str]] = {}
    for stage, a, b in [*_of_reports(first, second), *_of_models(first, second)]:
        for what in dict.fromkeys([*a, *b]):
            values = a.get(what, NO_VALUE), b.get(what, NO_VALUE)
            if values[0] != values[1]:
                found.setdefault((what, *values), []).append(STAGES[stage])
    return [(f"{what} ({', '.join(dict.fromkeys(stages))})", a, b) for (what, a, b), stages in found.items()]


def options_of(command: str) -> dict[str, str]:
    """The options of a command as a report states it, each with its values, and the files before them."""
    tool, *words = command.split()
    options: dict[str, list[str]] = {}
    name = _FILES
    for word in words:
        if word.startswith("--"):
            name, equals, word = word.partition("=")
            options.setdefault(name, [])
            if not equals:
                continue
        options.setdefault(name, []).append(word)
    return {f"{tool} {name}": " ".join(values) or "given" for name, values in options.items()}


def _of_reports(first: Path, second: Path) -> Iterator[tuple[str, dict[str, str], dict[str, str]]]:
    """For each stage that both runs report, what each says of its settings."""
    for stage in STAGES:
        reports = [StageReport.read(run / f"{stage}.json") for run in (first, second)]
        if all(reports):
            a, b = (_settings(report, stage) for report in reports)
            yield stage, a, b


def _settings(report: StageReport, stage: str) -> dict[str, str]:
    said = options_of(report.text("command")) if report.text("command") else {}
    if stage in _SHAPES:  # the model in the file says which set was taken, also where none was named
        said = {option: values for option, values in said.items() if not option.endswith(" --materials")}
    chosen = {key.replace("_mm", ", mm").replace("_deg", ", degrees"): _short(report, key) for key in _REPORTED.get(stage, ())}
    return {**said, "version of libbreast": report.text("version"), **{what: value for what, value in chosen.items() if value}}


def _short(report: StageReport, key: str) -> str:
    number = report.number(key)
    return general(number) if number is not None else one_line(report.text(key))


def _of_models(first: Path, second: Path) -> Iterator[tuple[str, dict[str, str], dict[str, str]]]:
    for shape in _SHAPES:
        files = [run / f"{shape}.vtkhdf" for run in (first, second)]
        if not all(file.exists() for file in files):
            continue
        models = [read_model(read_document(file, "mesh/1", ("/breast/model",))) for file in files]
        if None not in models:
            first_model, second_model = (model for model in models if model is not None)
            a, b = _laws(first_model), _laws(second_model)
            yield shape, {**_parts(first_model), **_cells(a, b)}, {**_parts(second_model), **_cells(b, a)}


def _parts(model: Model) -> dict[str, str]:
    return {_MODEL[part.name]: getattr(model, part.name) for part in fields(model) if part.name in _MODEL}


def _laws(model: Model) -> dict[str, dict[str, str]]:
    """The cells of each tissue or parameter by column. Supports are left out, since they stand among the parts of the model."""
    table = parse_table(model.materials, f"material set {model.name}")
    laws: dict[str, dict[str, str]] = {}
    for row in table:
        name, kind = row[table.columns[0]], row.get("law", NO_VALUE)
        if kind != "support":
            laws.setdefault(name, {}).update({column: _rounded(cell) for column, cell in row.items() if cell not in (NO_VALUE, name)
                                              and (column, kind) != ("law", "uncertainty")})
    return laws


def _cells(laws: dict[str, dict[str, str]], others: dict[str, dict[str, str]]) -> dict[str, str]:
    """"fat a10_Pa" and so on. A set lists air and other tissue only where their law is not that of fat."""
    own = {**laws, **{tissue: laws["fat"] for tissue in _AS_FAT if tissue in others and tissue not in laws and "fat" in laws}}
    return {f"{name} {column}": cell for name, cells in own.items() for column, cell in cells.items()}


def _rounded(cell: str) -> str:
    number = number_of(cell)
    return cell if number is None else general(number)
