# SPDX-License-Identifier: GPL-3.0-or-later
"""The seal of an HDF5 file: whether its bytes are those that were written."""
from __future__ import annotations

import hashlib
from pathlib import Path

from .errors import BreastError

_MARK = b"libbreast sha256"
_SEAL_BYTES = 80


def _stated_end(content: bytes) -> int:
    """End of the HDF5 data as the superblock states it, 0 when it cannot be told (HDF5 File Format Specification III.A)."""
    version = content[8]
    if content[13 if version < 2 else 9] != 8:
        return 0
    at = {0: 40, 1: 44}.get(version, 28)
    return int.from_bytes(content[at : at + 8], "little")


def check_seal(file: Path, content: bytes, advice: str) -> bool:
    """Raises BreastError when `content` is no HDF5 file, is cut off, or disagrees with the digest at its end.

    Returns whether the bytes are vouched for: a file without a seal (written or edited by another program) passes unsealed.
    """
    if content[:8] != b"\x89HDF\r\n\x1a\n":
        raise BreastError(f"is not an HDF5 file ({len(content)} bytes)", file, advice)
    end = _stated_end(content) if len(content) >= 96 else len(content) + 1
    if end > len(content):
        raise BreastError(f"is truncated at byte {len(content)} of {end}", file, advice)
    if end == len(content):
        return False
    body = len(content) - _SEAL_BYTES
    if content[body : body + len(_MARK)] != _MARK:
        raise BreastError(f"is damaged: {len(content)} bytes where its header states {end}", file, advice)
    if content[body + len(_MARK) :] != hashlib.sha256(content[:body]).hexdigest().encode():
        raise BreastError("is damaged: its content disagrees with the digest at its end", file, advice)
    return True
