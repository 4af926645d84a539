# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of VTK XML (.vtp, .vti, .vtu), read by VTK (needs python3-vtk9).

As of HDF5 (hdf5.py), a file whose seal holds is read as it is; any other was edited or is another program's, and `pairs` reads it first:
VTK follows damaged headers out of its buffers.
"""
from __future__ import annotations

import hashlib
import re
from pathlib import Path
from typing import Any

import numpy as np

from .document import read_only
from .errors import BreastError
from .programs import done_on

Arrays = dict[str, "np.ndarray | list[str]"]
_SEAL = re.compile(rb"<!-- sha256 of everything above: ([0-9a-f]{64}) -->")
_LINES = re.compile(rb'NumberOfLines="[1-9]')


class VtkXml:
    """A file of the kind `wanted` (PolyData, ImageData, UnstructuredGrid): `kind` says which, `data` is VTK's data set.

    Raises BreastError, one line, when it is damaged or of another kind, when it was edited and the programs refuse it, and when VTK's
    Python modules are not installed.
    """

    def __init__(self, file: Path, wanted: str) -> None:
        self.file, self.kind = file, wanted
        if not file.is_file():
            raise self.refuse("is not a file")
        content = file.read_bytes()
        seal = _SEAL.search(content)
        if seal is None:
            self._check(wanted, content)
        elif hashlib.sha256(content[:seal.start()]).hexdigest().encode() != seal[1]:
            raise self.refuse("is damaged: its text disagrees with the digest at its end")
        elif content[seal.end():].strip() != b"</VTKFile>":
            raise self.refuse("is damaged: behind its digest stands more, or less, than the end of a VTK file")
        if f'type="{wanted}"'.encode() not in content[:1000]:
            raise self.refuse(f"is no VTK file of the kind {wanted}")
        try:
            from vtkmodules import vtkIOXML
        except ImportError as error:
            raise BreastError("is read by VTK's Python modules", file, "apt-get install python3-vtk9") from error
        reader = getattr(vtkIOXML, f"vtkXML{wanted}Reader")()
        reader.SetFileName(str(file))
        reader.Update()
        self.data = reader.GetOutput()

    def refuse(self, what: str) -> BreastError:
        return BreastError(what, self.file, "make it again")

    def _check(self, wanted: str, content: bytes) -> None:
        # The names by which pairs knows the files of a kind: of polygonal data, only curves have lines.
        names = {"ImageData": "image", "PolyData": "curves.vtp" if _LINES.search(content) else "surface"}
        if wanted not in names:
            raise self.refuse("was changed after it was written")
        done_on(self.file, "pairs", ["all", f"--check={names[wanted]}={self.file}"])

    @property
    def points(self) -> np.ndarray:
        """(P, 3) LPS mm."""
        return vtk_array(self.data.GetPoints().GetData())

    def fields(self) -> Arrays:
        return self.group("FieldData")

    def group(self, name: str) -> Arrays:
        """Arrays by name of FieldData, PointData or CellData; texts as lists."""
        group = getattr(self.data, f"Get{name}")()
        arrays = [group.GetAbstractArray(n) for n in range(group.GetNumberOfArrays())]
        return {array.GetName(): vtk_array(array) for array in arrays}

    def cells(self, kind: str) -> list[np.ndarray]:
        """Point numbers of each cell of Verts, Lines, Polys or Cells."""
        cells = getattr(self.data, f"Get{kind}")()
        if not cells.GetNumberOfCells():
            return []
        return np.split(vtk_array(cells.GetConnectivityArray()), vtk_array(cells.GetOffsetsArray())[1:-1])


def vtk_array(array: Any) -> Any:
    """An array of VTK that refuses to be changed; texts as a list."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    if array.IsA("vtkStringArray"):
        return [array.GetValue(n) for n in range(array.GetNumberOfValues())]
    return read_only(vtk_to_numpy(array))
