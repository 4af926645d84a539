# SPDX-License-Identifier: GPL-3.0-or-later
"""Loading whatever a path holds."""
from __future__ import annotations

import os
import tempfile
from dataclasses import replace
from pathlib import Path
from typing import Any, Callable

from .curves import curves_of, holds_curves
from .errors import BreastError
from .geometry import read_geometry
from .hdf5 import SCHEMAS, file_schema
from .labels import read_labels
from .lookup import read_lookup
from .mammogram import read_mammogram
from .markups import read_fiducials, read_markups
from .nrrd import read_nrrd
from .programs import done_on
from .reports import read_report
from .state_file import read_state
from .tables import read_table
from .volume import Volume
from .vtk_xml import VtkXml
from .xml_mesh import read_xml_mesh, xml_mesh_of

_BY_SCHEMA: dict[str, Callable[[Path], Any]] = {"mesh/1": read_state, "labels/1": read_labels, "geometry/1": read_geometry,
                                                "lookup/1": read_lookup}


def _read_vtp(path: Path) -> Any:
    xml = VtkXml(path, "PolyData")
    return curves_of(xml) if holds_curves(xml) else xml_mesh_of(xml)


_BY_ENDING: dict[str, Callable[[Path], Any]] = {
    ".vti": read_mammogram, ".vtp": _read_vtp, ".vtu": read_xml_mesh, ".tsv": read_table, ".json": read_report,
    ".mrk.json": read_markups, ".fcsv": read_fiducials, ".nrrd": read_nrrd, ".nhdr": read_nrrd}
_BY_ENDING |= {ending: lambda path: load_scan(path) for ending in (".nii", ".nii.gz", ".mha", ".mhd")}


def load(path: str | os.PathLike[str]) -> Any:
    """A run folder, or one file.

    Returns:
        a folder: Run. A file by its ending: .vtkhdf and .h5, by their schema, State, Labels, Geometry or Lookup; .vti
        Mammogram; .vtp of cc2mlo lines by name, another .vtp and .vtu XmlMesh; .tsv a table; .json a report; .nrrd, .nhdr,
        .nii, .nii.gz, .mha, .mhd a scan (Volume). Of 3D Slicer: .seg.nrrd Segmentation, vectors in .nrrd Field, .mrk.json and .fcsv
        Markup by name.

    Raises:
        BreastError: nothing there, an unknown ending or schema, or a file that the programs would refuse.
    """
    from .run import Run
    path = Path(path)
    if path.is_dir():
        return Run(path)
    if not path.exists():
        raise BreastError("is neither a file nor a folder", path, "give a run folder (runs/CASE) or one of its files")
    name = path.name.lower()
    if name.endswith((".vtkhdf", ".h5")):
        schema = file_schema(path)
        if not schema:
            raise BreastError(f"states no schema: not a file of libbreast; read are {', '.join(SCHEMAS)}", path)
        return _BY_SCHEMA[schema](path)
    for ending in sorted(_BY_ENDING, key=len, reverse=True):
        if name.endswith(ending):
            return _BY_ENDING[ending](path)
    raise BreastError(f"has an unknown ending; read are .vtkhdf .h5 {' '.join(_BY_ENDING)}", path)


def load_scan(path: str | os.PathLike[str], series: int = 0) -> Volume:
    """A scan from whatever the programs read: of NRRD the file itself, of NIfTI, MetaImage and DICOM the copy that `scan` makes of it.

    Args:
        series: of a DICOM folder, by its number in `scan FOLDER --list`; 0 the best.
    """
    path = Path(path)
    if path.name.lower().endswith((".nrrd", ".nhdr")) and not path.is_dir():
        volume = load(path)
        if not isinstance(volume, Volume):
            raise BreastError("is a segmentation or a field, not a scan", path)
        return volume
    with tempfile.TemporaryDirectory(prefix="breast-scan-") as folder:
        copy = Path(folder) / "scan.nrrd"
        done_on(path, "scan", [str(path.absolute()), str(copy), "--series", str(series)])
        return replace(load_scan(copy), file=path)
