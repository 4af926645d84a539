# SPDX-License-Identifier: GPL-3.0-or-later
"""Conversion of a state to a VTK grid (needs VTK)."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .errors import BreastError

if TYPE_CHECKING:
    from .state import State

_CELL_TYPES = {8: 12, 27: 29}


def vtk_grid(state: State) -> Any:
    """vtkUnstructuredGrid of the state's points with its point and cell arrays, and `imaged` and `reference` as vectors.

    Raises BreastError when VTK's Python modules are not installed.
    """
    try:
        from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
        from vtkmodules.vtkCommonCore import vtkPoints
        from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkUnstructuredGrid
    except ImportError as error:
        raise BreastError("a VTK grid needs VTK's Python modules", None, "apt-get install python3-vtk9") from error

    def array(name: str, values: np.ndarray) -> Any:
        made = numpy_to_vtk(np.array(values), deep=True)
        made.SetName(name)
        return made

    grid = vtkUnstructuredGrid()
    points = vtkPoints()
    points.SetData(array("Points", state.points))
    grid.SetPoints(points)
    per_element = state.hexahedra.shape[1]
    cells = vtkCellArray()
    cells.SetData(per_element, numpy_to_vtkIdTypeArray(state.hexahedra.ravel().copy(), deep=True))
    grid.SetCells(_CELL_TYPES[per_element], cells)
    shapes = {"imaged": state.imaged, "displacement_from_scan": state.displacement_from_scan}
    if state.reference is not None:
        shapes |= {"reference": state.reference, "displacement_from_stress_free": state.displacement_from_stress_free}
    for name, values in (shapes | state.point_arrays).items():
        grid.GetPointData().AddArray(array(name, values))
    for name, values in ({"tissue": state.tissue} | state.cell_arrays).items():
        grid.GetCellData().AddArray(array(name, values))
    return grid
