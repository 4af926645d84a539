# SPDX-License-Identifier: GPL-3.0-or-later
"""NRRD volumes (teem.sourceforge.net/nrrd/format.html), attached or detached; raw, gzip and text."""
from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from .errors import BreastError
from .field import Field
from .segmentation import Segmentation, made_segmentation
from .volume import Volume, checked_size, detached_data, exact_bytes, inflated, made_volume, unit_mm

_TYPES = {"i1": "signed char,int8,int8_t", "u1": "uchar,unsigned char,uint8,uint8_t",
          "i2": "short,short int,signed short,signed short int,int16,int16_t",
          "u2": "ushort,unsigned short,unsigned short int,uint16,uint16_t", "i4": "int,signed int,int32,int32_t",
          "u4": "uint,unsigned int,uint32,uint32_t",
          "i8": "longlong,long long,long long int,signed long long,signed long long int,int64,int64_t",
          "u8": "ulonglong,unsigned long long,unsigned long long int,uint64,uint64_t", "f4": "float", "f8": "double"}
_CODE_OF = {name: code for code, names in _TYPES.items() for name in names.split(",")}
_TO_LPS = {"left-posterior-superior": (1, 1, 1), "lps": (1, 1, 1), "right-anterior-superior": (-1, -1, 1), "ras": (-1, -1, 1),
           "left-anterior-superior": (1, -1, 1), "las": (1, -1, 1)}


def read_nrrd(file: Path) -> Volume | Segmentation | Field:
    """A scan or label map, a segmentation or a displacement field of 3D Slicer, from .nrrd or .nhdr.

    Raises BreastError when size, voxel size or orientation are unknown or contradictory.
    """
    content = file.read_bytes()
    fields, notes, data_at = _header(file, content)
    size = [int(n) for n in fields.get("sizes", "").split() if n.isdigit()]
    components = _components(file, fields, size)
    count = checked_size(file, size[-3:] if components == 3 else size) * components
    axes, origin = _placed(file, fields)
    voxels = _voxels(file, fields, content[data_at:], count)
    if components == 3:
        if _TO_LPS[fields["space"].lower()] != (1, 1, 1):
            raise BreastError("a field of vectors must be in space left-posterior-superior", file)
        first = made_volume(file, size[-3:], axes, origin, voxels[0::3])
        rest = [made_volume(file, size[-3:], axes, origin, voxels[d::3]).voxels for d in (1, 2)]
        return Field(file, first.grid, np.stack([first.voxels, *rest], -1), notes)
    volume = made_volume(file, size, axes, origin, voxels)
    if "Segment0_ID" in notes:
        return made_segmentation(file, volume.grid, volume.voxels, notes)
    return volume


def _components(file: Path, fields: dict[str, str], size: list[int]) -> int:
    """1, or 3 of a field of vectors."""
    kinds = fields.get("kinds", "").split()
    if len(size) != 4:
        return 1
    if size[0] == 3 and kinds[:1] == ["vector"]:
        return 3
    several = "segments that overlap are not read: in 3D Slicer, export them to one label map"
    raise BreastError(f"has four axes of size {size}: scalars or vectors of 3 on three axes are read", file,
                      several if kinds[:1] == ["list"] else "")


def _voxels(file: Path, fields: dict[str, str], attached: bytes, count: int) -> np.ndarray:
    code = _CODE_OF.get(fields.get("type", "").lower())
    if code is None:
        raise BreastError(f"type '{fields.get('type', '')}': grey values of 8 to 64 bits are read", file)
    endian, encoding = fields.get("endian", "little").lower(), fields.get("encoding", "").lower()
    if endian not in ("little", "big") or encoding not in ("raw", "gzip", "gz", "text", "txt", "ascii"):
        raise BreastError(f"endian '{endian}', encoding '{encoding}': little or big, and raw, gzip or text are read", file)
    name = fields.get("data file", fields.get("datafile"))
    stored = attached if name is None else detached_data(file, name)
    dtype = np.dtype(("<" if endian == "little" else ">") + code)
    if encoding not in ("raw", "gzip", "gz"):
        try:
            voxels = np.array(stored.split(), np.float64)
        except ValueError:
            raise BreastError("its voxels are no numbers", file) from None
        if len(voxels) != count:
            raise BreastError(f"{len(voxels)} voxels, the header announces {count}", file)
        return voxels
    raw = stored if encoding == "raw" else inflated(file, stored, count * dtype.itemsize)
    return np.frombuffer(exact_bytes(file, raw, count * dtype.itemsize), dtype)


def _header(file: Path, content: bytes) -> tuple[dict[str, str], dict[str, str], int]:
    """Fields by lower-case name, notes of the program that wrote it by key, and where the data begin."""
    ends = [at for at in (content.find(b"\n\n"), content.find(b"\r\n\r\n")) if at >= 0]
    if not content.startswith(b"NRRD"):
        raise BreastError("no NRRD header", file)
    end = min(ends, default=len(content))
    data_at = end + (4 if content[end : end + 1] == b"\r" else 2)
    fields: dict[str, str] = {}
    notes: dict[str, str] = {}
    for line in content[:end].decode("utf-8", "replace").splitlines()[1:]:
        name, colon, value = line.partition(": ")
        if not line.startswith("#") and ":=" in name:
            key, _, text = line.partition(":=")
            notes[key] = text
            continue
        if line.startswith("#") or not colon:
            continue
        if name.strip().lower() in fields:
            raise BreastError(f"header states '{name}' twice", file)
        fields[name.strip().lower()] = value.strip()
    return fields, notes, data_at


def _placed(file: Path, fields: dict[str, str]) -> tuple[np.ndarray, np.ndarray]:
    space = fields.get("space", "").lower()
    if space not in _TO_LPS:
        said = f"space '{space}'" if space else "states no space, so left and right are unknown"
        raise BreastError(f"{said}: left-posterior-superior or right-anterior-superior are read", file)
    units = set(fields.get("space units", "").split()) or {""}
    if len(units) > 1:
        raise BreastError(f"space units {fields['space units']}: one unit for all axes is read", file)
    mm = unit_mm(file, units.pop().strip('"'))
    if "space origin" not in fields:
        raise BreastError("states no space origin, so where the scan lies is unknown", file, "save it with its origin")
    vectors = [_vector(file, v) for v in re.findall(r"\([^)]*\)", fields.get("space directions", ""))]
    if len(vectors) != 3:
        raise BreastError(f"{len(vectors)} space directions: voxel size and orientation need three", file)
    to_lps = mm * np.array(_TO_LPS[space], float)
    origin = _vector(file, fields["space origin"])
    return np.stack(vectors, -1) * to_lps[:, None], origin * to_lps


def _vector(file: Path, text: str) -> np.ndarray:
    try:
        vector = np.array([float(n) for n in text.strip("()").split(",")])
    except ValueError:
        vector = np.zeros(0)
    if vector.shape != (3,) or not np.isfinite(vector).all():
        raise BreastError(f"'{text}' must be three finite numbers", file)
    return vector
