# SPDX-License-Identifier: GPL-3.0-or-later
"""The arrays of a VTK XML file (.vtp, .vti) of the toolkit, without VTK."""
from __future__ import annotations

import base64
import hashlib
import re
import zlib
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from .errors import BreastError

_TYPES = {"Int8": "i1", "UInt8": "u1", "UInt16": "u2", "Int32": "i4", "UInt32": "u4", "Int64": "i8", "UInt64": "u8", "Float32": "f4",
          "Float64": "f8"}
_MOST_BYTES = 1 << 30


class VtkXml:
    """A parsed file. Raises BreastError, one line, when it is damaged or not of the kind `wanted` (PolyData, ImageData)."""

    def __init__(self, file: Path, wanted: str) -> None:
        self.file = file
        if not file.is_file():
            raise self.refuse("is not a file")
        content = file.read_bytes()
        self._check_seal(content)
        if b"<!DOCTYPE" in content or b"<!ENTITY" in content:
            raise self.refuse("declares entities, which no file of VTK does")
        try:
            root = ElementTree.fromstring(content)
        except ElementTree.ParseError as error:
            raise self.refuse(f"is no XML ({error})") from None
        data = root.find(wanted) if root.tag == "VTKFile" else None
        if data is None:
            raise self.refuse(f"is no VTK file of the kind {wanted}")
        piece = data.find("Piece")
        if piece is None:
            raise self.refuse("has no piece")
        self.data, self.piece = data, piece
        self._header = {"UInt32": 4, "UInt64": 8}.get(root.get("header_type", "UInt32"), 4)
        self._compressed = root.get("compressor") == "vtkZLibDataCompressor"

    def refuse(self, what: str) -> BreastError:
        return BreastError(what, self.file, "make it again")

    def _check_seal(self, content: bytes) -> None:
        found = re.search(rb"<!-- sha256 of everything above: ([0-9a-f]{64}) -->", content)
        if found and hashlib.sha256(content[: found.start()]).hexdigest().encode() != found.group(1):
            raise self.refuse("is damaged: its text disagrees with the digest at its end")

    def group(self, name: str, inside: ElementTree.Element | None = None) -> dict[str, np.ndarray | list[str]]:
        """Arrays by name of FieldData, PointData, CellData, Points, Verts, Lines; texts as lists."""
        parent = (self.piece if inside is None else inside).find(name)
        arrays: dict[str, np.ndarray | list[str]] = {}
        for element in [] if parent is None else [e for e in parent if e.tag in ("DataArray", "Array")]:
            arrays[element.get("Name", "")] = self._array(element)
        return arrays

    def fields(self) -> dict[str, np.ndarray | list[str]]:
        return self.group("FieldData", self.data)

    def _array(self, element: ElementTree.Element) -> np.ndarray | list[str]:
        name, kind = element.get("Name", ""), element.get("type", "")
        if element.get("format") != "binary" or (kind != "String" and kind not in _TYPES):
            raise self.refuse(f"array {name} is stored in a way that is not read ({kind}, {element.get('format')})")
        try:
            values = self._decoded(element.text or "")
            if kind == "String":
                return values.decode("utf-8").split("\0")[:-1]
            array = np.frombuffer(values, dtype="<" + _TYPES[kind])
            components = int(element.get("NumberOfComponents", "1"))
            array = array.reshape(-1, components) if components > 1 else array
        except (ValueError, IndexError, OverflowError, zlib.error) as error:
            raise self.refuse(f"array {name} is damaged ({error})") from None
        if array.dtype.kind == "f" and not np.isfinite(array).all():
            raise self.refuse(f"array {name} holds a value that is not finite")
        return array

    def _decoded(self, text: str) -> bytes:
        text = "".join(text.split())
        if not self._compressed:
            raw = base64.b64decode(text, validate=True)
            return raw[self._header :]
        first = base64.b64decode(text[: 4 * -(-self._header // 3)], validate=True)
        blocks = int.from_bytes(first[: self._header], "little")
        header_bytes = self._header * (3 + blocks)
        header_text = 4 * -(-header_bytes // 3)
        if blocks == 0:
            return b""
        head = np.frombuffer(base64.b64decode(text[:header_text], validate=True)[:header_bytes], f"<u{self._header}")
        size, last = int(head[1]), int(head[2])
        if size * blocks > _MOST_BYTES:
            raise ValueError("more than 1 GB")
        body, out, at = base64.b64decode(text[header_text:], validate=True), [], 0
        for b, compressed in enumerate(int(n) for n in head[3:]):
            expected = last if b == blocks - 1 and last else size
            block = zlib.decompressobj().decompress(body[at : at + compressed], expected + 1)
            if len(block) != expected:
                raise ValueError(f"block {b} has {len(block)} bytes, must have {expected}")
            out.append(block)
            at += compressed
        return b"".join(out)

def cells_of(xml: VtkXml, kind: str) -> list[np.ndarray]:
    """Point numbers of each cell of Verts, Lines, Polys or Cells."""
    group = xml.group(kind)
    ids, ends = group.get("connectivity"), group.get("offsets")
    if not isinstance(ids, np.ndarray) or not isinstance(ends, np.ndarray) or len(ends) == 0:
        return []
    if len(ids) and ids.min() < 0 or (np.diff(ends) <= 0).any() or ends[-1] != len(ids):
        raise xml.refuse(f"{kind} are damaged")
    return np.split(ids, ends[:-1])
