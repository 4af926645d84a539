# SPDX-License-Identifier: GPL-3.0-or-later
"""Results of libbreast in Python.

    import breast
    run = breast.load("runs/average")
    run.supine.points                                   # (N, 3) node positions, LPS mm
    run.transport([[90, -40, 10]], "imaged", "supine")  # points carried with the tissue
    run.reports["cc"]["force_N"]

Needs h5py and numpy (Debian: python3-h5py), python3-vtk9 for .vti, .vtp, .vtu and State.vtk(), and the programs for edited files and
for scans that are not in NRRD; tables become pandas DataFrames where pandas is installed. Lengths are mm, masses g, times s (stress is
then Pa) unless a name says otherwise; places are patient LPS: x to the patient's left, y to the back, z to the head. docs/python.md has
examples.
"""
from __future__ import annotations

import importlib

__version__ = "0.1.0"

# The module of every public name. It is imported when the name is first used: a program that needs neither arrays nor files of
# HDF5, as the command `breast`, starts without numpy and h5py.
_MODULES = {
    "curves": ["Line"],
    "element_map": ["ElementMap", "Located"],
    "errors": ["BreastError"],
    "field": ["Field"],
    "geometry": ["Geometry", "Sheet"],
    "grid": ["Grid"],
    "history": ["Command", "Input"],
    "labels": ["Labels"],
    "loading": ["load", "load_scan"],
    "lookup": ["Lookup"],
    "mammogram": ["Mammogram"],
    "markups": ["Markup"],
    "records": ["Contact", "Model", "Plate", "Solve"],
    "reports": ["read_report"],
    "run": ["Run"],
    "segmentation": ["Segmentation"],
    "state": ["TISSUES", "Landmark", "State"],
    "tables": ["read_table"],
    "transport": ["Transported"],
    "volume": ["Volume"],
    "xml_mesh": ["XmlMesh"],
}
_HOME = {name: module for module, names in _MODULES.items() for name in names}
__all__ = sorted(_HOME)


def __getattr__(name: str) -> object:
    if name not in _HOME:
        raise AttributeError(f"module 'breast' has no attribute '{name}'")
    value = getattr(importlib.import_module("." + _HOME[name], __name__), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
