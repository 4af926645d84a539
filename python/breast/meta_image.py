# SPDX-License-Identifier: GPL-3.0-or-later
"""MetaImage volumes (.mha, .mhd)."""
from __future__ import annotations

from pathlib import Path

import numpy as np

from .errors import BreastError
from .volume import Volume, checked_size, detached_data, exact_bytes, inflated, made_volume, unit_mm

_TYPES = {"MET_CHAR": "i1", "MET_UCHAR": "u1", "MET_SHORT": "i2", "MET_USHORT": "u2", "MET_INT": "i4", "MET_UINT": "u4",
          "MET_LONG": "i4", "MET_ULONG": "u4", "MET_LONG_LONG": "i8", "MET_ULONG_LONG": "u8", "MET_FLOAT": "f4",
          "MET_DOUBLE": "f8"}


def read_meta_image(file: Path) -> Volume:
    """A volume from .mha or .mhd. Raises BreastError when size, voxel size or orientation are unknown."""
    content = file.read_bytes()
    fields, data_at = _header(file, content)
    size = [int(n) for n in _field(fields, "DimSize").split() if n.isdigit()]
    count = checked_size(file, size)
    code = _TYPES.get(_field(fields, "ElementType"))
    if code is None or _field(fields, "ElementNumberOfChannels") not in ("", "1"):
        raise BreastError(f"element type '{_field(fields, 'ElementType')}': grey values of 8 to 64 bits are read", file)
    big = _field(fields, "BinaryDataByteOrderMSB", "ElementByteOrderMSB").lower() == "true"
    dtype = np.dtype((">" if big else "<") + code)
    if _field(fields, "BinaryData").lower() == "false":
        raise BreastError("keeps its voxels as text, which is not read", file, "save it as binary data")
    name = _field(fields, "ElementDataFile")
    stored = content[data_at:] if name.lower() == "local" else detached_data(file, name)
    needed = count * dtype.itemsize
    if _field(fields, "CompressedData").lower() == "true":
        stored = inflated(file, stored, needed)
    axes, origin = _placed(file, fields)
    return made_volume(file, size, axes, origin, np.frombuffer(exact_bytes(file, stored, needed), dtype))


def _header(file: Path, content: bytes) -> tuple[dict[str, str], int]:
    fields: dict[str, str] = {}
    at = 0
    while at < len(content) and at < 1 << 16:
        end = content.find(b"\n", at)
        end = len(content) if end < 0 else end
        key, equals, value = content[at:end].decode("latin-1").partition("=")
        at = end + 1
        if not equals:
            break
        fields[key.strip()] = value.strip()
        if key.strip() == "ElementDataFile":
            return fields, at
    raise BreastError("no complete MetaImage header", file)


def _field(fields: dict[str, str], *names: str) -> str:
    return next((fields[name] for name in names if name in fields), "")


def _numbers(file: Path, fields: dict[str, str], count: int, *names: str) -> np.ndarray:
    try:
        numbers = np.array([float(n) for n in _field(fields, *names).split()])
    except ValueError:
        numbers = np.zeros(0)
    if len(numbers) != count or not np.isfinite(numbers).all():
        raise BreastError(f"states no {names[0]} of {count} finite numbers: size, orientation and place of voxels are unknown", file)
    return numbers


def _placed(file: Path, fields: dict[str, str]) -> tuple[np.ndarray, np.ndarray]:
    mm = unit_mm(file, _field(fields, "DistanceUnits"))
    spacing = _numbers(file, fields, 3, "ElementSpacing", "ElementSize")
    # Each row is the direction of an axis.
    rows = _numbers(file, fields, 9, "TransformMatrix", "Orientation", "Rotation").reshape(3, 3)
    origin = _numbers(file, fields, 3, "Offset", "Position", "Origin")
    return mm * rows.T * spacing, mm * origin
