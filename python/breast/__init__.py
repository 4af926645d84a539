# SPDX-License-Identifier: GPL-3.0-or-later
"""Results of libbreast in Python.

    import breast
    run = breast.load("runs/average")
    run.supine.points                                   # (N, 3) node positions, LPS mm
    run.transport([[90, -40, 10]], "imaged", "supine")  # points carried with the tissue
    run.reports["cc"]["force_N"]

Needs h5py and numpy (Debian: python3-h5py), nothing else; tables become pandas DataFrames where pandas is installed, and
State.vtk() needs python3-vtk9. Lengths are mm, masses g, times s (stress is then Pa) unless a name says otherwise; places are
patient LPS: x to the patient's left, y to the back, z to the head. docs/python.md has examples.
"""
from .curves import Line
from .element_map import ElementMap, Located
from .errors import BreastError
from .field import Field
from .geometry import Geometry, Sheet
from .grid import Grid
from .history import Command, Input
from .labels import Labels
from .load import load, load_scan
from .lookup import Lookup
from .mammogram import Mammogram
from .markups import Markup
from .records import Contact, Friction, Model, Plate, Solve
from .reports import read_report
from .run import Run
from .segmentation import Segmentation
from .state import TISSUES, Landmark, State
from .tables import read_table
from .transport import Transported
from .volume import Volume
from .xml_mesh import XmlMesh

__all__ = [
    "BreastError", "Command", "Contact", "ElementMap", "Field", "Friction", "Geometry", "Grid", "Input", "Labels",
    "Landmark", "Line", "Located", "Lookup", "Mammogram", "Markup", "Model", "Plate", "Run", "Segmentation", "Sheet",
    "Solve", "State", "TISSUES", "Transported", "Volume", "XmlMesh", "load", "load_scan", "read_report",
    "read_table"]
