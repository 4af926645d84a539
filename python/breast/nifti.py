# SPDX-License-Identifier: GPL-3.0-or-later
"""NIfTI-1 and -2 volumes in a single file, plain or gzipped."""
from __future__ import annotations

from pathlib import Path

import numpy as np

from .errors import BreastError
from .volume import Volume, checked_size, exact_bytes, inflated, made_volume

_TYPES = {2: "u1", 256: "i1", 4: "i2", 512: "u2", 8: "i4", 768: "u4", 16: "f4", 64: "f8", 1024: "i8", 1280: "u8"}
_UNIT_MM = {1: 1e3, 3: 1e-3}
"""Unknown units count as mm, as every program takes them."""
_FIRST = np.dtype({"names": ["dim", "type", "bits", "pixdim", "offset", "slope", "intercept", "units", "qform", "sform",
                             "quaternion", "srow"],
                   "formats": [("<i2", 8), "<i2", "<i2", ("<f4", 8), "<f4", "<f4", "<f4", "u1", "<i2", "<i2", ("<f4", 6),
                               ("<f4", (3, 4))],
                   "offsets": [40, 70, 72, 76, 108, 112, 116, 123, 252, 254, 256, 280], "itemsize": 348})
_SECOND = np.dtype({"names": list(_FIRST.names),
                    "formats": [("<i8", 8), "<i2", "<i2", ("<f8", 8), "<i8", "<f8", "<f8", "u1", "<i4", "<i4", ("<f8", 6),
                                ("<f8", (3, 4))],
                    "offsets": [16, 12, 14, 104, 168, 176, 184, 500, 344, 348, 352, 400], "itemsize": 540})


def read_nifti(file: Path) -> Volume:
    """A volume from .nii or .nii.gz. Raises BreastError when size, voxel size or orientation are unknown or contradictory."""
    content = file.read_bytes()
    zipped = content[:2] == b"\x1f\x8b"
    header, order = _header(file, inflated(file, content, 540, whole=False) if zipped else content)
    dimensions = int(header["dim"][0])
    if not 1 <= dimensions <= 7:
        raise BreastError(f"{dimensions} dimensions, must be 1 to 7", file)
    extents = [int(n) for n in header["dim"][1 : dimensions + 1]]
    if any(n != 1 for n in extents[3:]):
        raise BreastError(f"size {extents}: one 3-D volume is needed", file)
    count = checked_size(file, extents[:3])
    code = _TYPES.get(int(header["type"]))
    if code is None or np.dtype(code).itemsize * 8 != int(header["bits"]):
        raise BreastError(f"data type {header['type']} of {header['bits']} bits: grey values of 8 to 64 bits are read", file)
    dtype = np.dtype(code).newbyteorder(order)
    offset = float(header["offset"])
    if not 348 <= offset <= 1e8:
        raise BreastError(f"the stated start of the voxels is byte {offset}: must be 348 or more", file)
    needed = int(offset) + count * dtype.itemsize
    data = exact_bytes(file, inflated(file, content, needed) if zipped else content, needed)
    voxels = np.frombuffer(data, dtype, count, int(offset))
    slope, intercept = float(header["slope"]), float(header["intercept"])
    if slope != 0 and (slope != 1 or intercept != 0):
        voxels = (voxels * slope + intercept).astype(np.float32)
    with np.errstate(all="ignore"):  # what is not finite is refused by name
        axes, origin = _placed(file, header)
    return made_volume(file, extents[:3], axes, origin, voxels)


def _header(file: Path, head: bytes) -> tuple[np.void, str]:
    for layout, magic_at, magic in ((_FIRST, 344, b"n+1"), (_SECOND, 4, b"n+2")):
        for order in "<>":
            stated = np.frombuffer(head[:4].ljust(4, b"\0"), order + "i4")[0]
            if stated == layout.itemsize and len(head) >= stated and head[magic_at : magic_at + 3] == magic:
                return np.frombuffer(head, layout.newbyteorder(order), 1)[0], order
    raise BreastError("not the NIfTI header of a single file", file)


def _placed(file: Path, header: np.void) -> tuple[np.ndarray, np.ndarray]:
    """Steps from voxel to voxel (columns) and origin, LPS mm; the format states RAS."""
    mm = _UNIT_MM.get(int(header["units"]) & 7, 1.0)
    size = mm * header["pixdim"][1:4].astype(float)
    to_lps = np.array([-1.0, -1.0, 1.0])
    found = []
    if header["sform"] > 0:
        matrix = mm * header["srow"].astype(float)
        found.append((matrix[:, :3] * to_lps[:, None], matrix[:, 3] * to_lps))
        if not (np.abs(np.linalg.norm(matrix[:, :3], axis=0) - size) <= 0.01 * np.abs(size)).all():
            raise BreastError("sform's voxel size and pixdim's contradict each other", file)
    if header["qform"] > 0:
        rotation = _rotation(file, header["quaternion"][:3].astype(float))
        rotation[:, 2] *= -1 if header["pixdim"][0] < 0 else 1
        found.append((rotation * size * to_lps[:, None], mm * header["quaternion"][3:].astype(float) * to_lps))
    if not found:
        raise BreastError("states no orientation (qform and sform code 0), so left and right are unknown", file,
                          "convert the scan again from DICOM")
    (axes, origin), (other, elsewhere) = found[0], found[-1]  # the same where only one form is stated
    if np.abs((axes - other) / size).max() > 0.011 or np.linalg.norm(origin - elsewhere) > 1:
        raise BreastError("qform and sform contradict each other", file, "keep only that of the scanner")
    return axes, origin


def _rotation(file: Path, bcd: np.ndarray) -> np.ndarray:
    if not bcd @ bcd <= 1 + 1e-3:
        raise BreastError(f"qform's quaternion has length {np.linalg.norm(bcd)}: must be at most 1", file)
    a = np.sqrt(max(0.0, 1 - bcd @ bcd))
    a, b, c, d = np.array([a, *bcd]) / np.linalg.norm([a, *bcd])
    return np.array([[a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)],
                     [2 * (b * c + a * d), a * a + c * c - b * b - d * d, 2 * (c * d - a * b)],
                     [2 * (b * d - a * c), 2 * (c * d + a * b), a * a + d * d - b * b - c * c]])
