# SPDX-License-Identifier: GPL-3.0-or-later
"""Bounded decompression of gzip and zlib streams."""
from __future__ import annotations

import zlib
from pathlib import Path

from .errors import BreastError


def inflated(file: Path, content: bytes, most: int, whole: bool = True) -> bytes:
    """The first `most` bytes of what a gzip or zlib stream holds.

    Raises BreastError when the stream is damaged; with `whole` also when it is cut off, its checksum included, or holds more.
    """
    stream = zlib.decompressobj(wbits=zlib.MAX_WBITS | 32)
    try:
        data = stream.decompress(content, most)
        if whole and not stream.eof:
            more = stream.decompress(stream.unconsumed_tail, 1)  # reads the checksum behind the last byte
            if more or not stream.eof:
                raise BreastError("its compressed voxels are cut off, or more than the header announces", file)
    except zlib.error as error:
        raise BreastError(f"its compressed voxels are damaged ({error})", file) from None
    return data
