# SPDX-License-Identifier: GPL-3.0-or-later
"""A scan: grey values on a grid."""
from __future__ import annotations

import hashlib
import zlib
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from .errors import BreastError
from .grid import Grid

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

MOST_VOXELS = 1 << 28


@dataclass(frozen=True)
class Volume:
    """A volume as the tool segment reads it.

    Attributes:
        file: where it was read from.
        grid: where the voxels are; index <-> LPS mm.
        voxels: (nk, nj, ni) float32.
    """

    file: Path
    grid: Grid
    voxels: np.ndarray

    def __repr__(self) -> str:
        return f"<Volume {self.file.name}: {'x'.join(map(str, self.grid.size))} voxels>"

    def sample(self, points: ArrayLike, outside: float = np.nan) -> np.ndarray:
        """Grey values (n) at points (n, 3), LPS mm, by trilinear interpolation; `outside` beyond the volume."""
        return self.grid.sample(self.voxels, points, outside)

    def content_sha256(self) -> str:
        """SHA-256 of grid and voxels, as the histories of files name a scan: the same for NRRD and DICOM of one scan."""
        stated = []
        for d in range(3):
            stated += [self.grid.size[d], self.grid.spacing[d] / 1e-3, self.grid.origin[d] / 1e-3]
            stated += [self.grid.direction[d, e] / 1e-4 for e in range(3)]
        # Halves away from zero, as the programs round.
        rounded = [int(np.copysign(np.floor(abs(value) + 0.5), value)) for value in stated]
        hashed = hashlib.sha256(np.array(rounded, "<i8").tobytes())
        hashed.update(np.ascontiguousarray(self.voxels, "<f4").data)
        return hashed.hexdigest()


def made_volume(file: Path, size: list[int], axes: np.ndarray, origin: np.ndarray, voxels: np.ndarray) -> Volume:
    """A volume after the checks every format needs.

    Args:
        size: (ni, nj, nk).
        axes: (3, 3) columns are the steps from voxel to voxel along i, j, k, LPS mm.
        origin: (3) centre of voxel (0, 0, 0), LPS mm.
        voxels: flat, i fastest.
    """
    if not (np.isfinite(axes).all() and np.isfinite(origin).all() and np.abs(origin).max() <= 1e5):
        raise BreastError(f"origin {origin} mm: must be finite and within 100000 mm", file)
    spacing = np.linalg.norm(axes, axis=0)
    if not ((spacing >= 0.01) & (spacing <= 50)).all():
        raise BreastError(f"voxel size {spacing} mm: must be 0.01 to 50 mm", file)
    direction = axes / spacing
    error = np.abs(direction.T @ direction - np.eye(3)).max()
    if error > 1e-3:
        raise BreastError(f"axis directions are not orthonormal (off by {error:g}, must be at most 0.001)", file,
                          "resample the scan without shear")
    grey = np.ascontiguousarray(voxels.reshape(size[::-1]), np.float32)
    if not np.isfinite(grey).all():
        k, j, i = np.unravel_index(int(np.argmin(np.isfinite(grey))), grey.shape)
        raise BreastError(f"voxel ({i},{j},{k}) is {grey[k, j, i]}: must be finite", file)
    return Volume(file, Grid((size[0], size[1], size[2]), spacing, origin, direction), grey)


def checked_size(file: Path, size: list[int]) -> int:
    """Number of voxels of a size of three positive numbers, within what is read."""
    if len(size) != 3 or min(size) < 1:
        raise BreastError(f"size {size}: one 3-D volume is needed", file)
    voxels = size[0] * size[1] * size[2]
    if voxels > MOST_VOXELS:
        raise BreastError(f"{voxels} voxels, must be at most {MOST_VOXELS}", file, "crop the scan")
    return voxels


def inflated(file: Path, content: bytes, most: int) -> bytes:
    """What a gzip or zlib stream holds. Raises BreastError when it is damaged, cut off (its checksum included) or more than `most` bytes.
    """
    stream = zlib.decompressobj(wbits=zlib.MAX_WBITS | 32)
    try:
        data = stream.decompress(content, most)
        if not stream.eof:
            more = stream.decompress(stream.unconsumed_tail, 1)  # reads the checksum behind the last byte
            if more or not stream.eof:
                raise BreastError("its compressed voxels are cut off, or more than the header announces", file)
    except zlib.error as error:
        raise BreastError(f"its compressed voxels are damaged ({error})", file) from None
    return data


def exact_bytes(file: Path, content: bytes, needed: int) -> bytes:
    """The content. Raises BreastError unless it has `needed` bytes: which of more are the volume is unknown."""
    if len(content) < needed:
        raise BreastError(f"truncated: {len(content)} bytes of voxels, the header announces {needed}", file)
    if len(content) > needed:
        raise BreastError(f"{len(content)} bytes of voxels, but the header announces {needed}", file, "save the volume again")
    return content


def unit_mm(file: Path, symbol: str) -> float:
    """mm of a unit of length by its symbol; a file that states none ("" or "?") is in mm, as every program takes it."""
    known = {"": 1.0, "?": 1.0, "m": 1e3, "cm": 10.0, "mm": 1.0, "um": 1e-3}
    if symbol not in known:
        raise BreastError(f"unit of length '{symbol}': mm, m, cm and um are read", file)
    return known[symbol]


def detached_data(file: Path, name: str) -> bytes:
    """Content of the file that a header names for its voxels; only one in the header's own folder is read."""
    if not name or name.startswith("LIST") or "%" in name or Path(name).is_absolute() or ".." in Path(name).parts:
        raise BreastError(f"names '{name}' for its voxels: must be one file in its own folder", file)
    data = file.parent / name
    if not data.is_file():
        raise BreastError(f"its voxels should be in {name}, which is not a file", file)
    return data.read_bytes()
