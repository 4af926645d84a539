# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that are complete or absent, and that never replace a file of another program."""
from __future__ import annotations

import os
import stat
from pathlib import Path

from .errors import BreastError, Failed

_HDF5, _PNG = b"\x89HDF\r\n\x1a\n", b"\x89PNG\r\n\x1a\n"
# Formats with a place in which libbreast names itself.
_MARKED = (_PNG, b"NRRD", b"\x1f\x8b", b"ObjectType", b"**", b"<?xml", b"<!DOCTYPE", b"<!doctype")
_LONGEST = 220  # of a name with the additions of its part; a file system allows 255 bytes


def is_stream(target: str | os.PathLike[str]) -> bool:
    """A device, a pipe or a stream such as /dev/stdout, which is written to directly."""
    name = os.fspath(target)
    if name.startswith(("/dev/fd/", "/proc/self/fd/")) or name in ("/dev/stdout", "/dev/stderr"):
        return True
    try:
        kind = os.stat(name).st_mode
    except OSError:
        return False
    return not stat.S_ISREG(kind) and not stat.S_ISDIR(kind)


def write_bytes(target: str | os.PathLike[str], data: bytes) -> None:
    """Writes the file beside its target under a hidden name, to the disk, and then renames it.

    Raises:
        Failed: naming the target and the system's reason; the target is then what it was.
    """
    path = Path(target)
    try:
        if is_stream(path):
            with open(path, "ab", buffering=0) as stream:
                stream.write(data)
            return
        name = os.fsdecode(os.fsencode(path.name)[:_LONGEST])
        part = path.with_name(f".{name}.part-{os.getpid()}")
        try:
            with open(part, "xb") as file:
                file.write(data)
                file.flush()
                os.fsync(file.fileno())
            part.replace(path)
        except BaseException:
            part.unlink(missing_ok=True)
            raise
    except OSError as error:
        raise Failed(f"could not be written ({len(data)} bytes): {error.strerror}", path) from None


def write_text(target: str | os.PathLike[str], text: str) -> None:
    """The same for text, as UTF-8; bytes of a file name that are none stay what they are."""
    write_bytes(target, text.encode("utf-8", "surrogateescape"))


def written_by_us(file: str | os.PathLike[str]) -> bool:
    """Whether the content shows that libbreast wrote the file, or the file is empty (libbreast/core/own_file.hpp)."""
    try:
        with open(file, "rb") as stream:
            head = stream.read(1 << 20)
            stream.seek(max(0, os.fstat(stream.fileno()).st_size - 256))
            tail = stream.read()
    except OSError:
        return False
    front = head[:4096]
    if not head:
        return True
    if front.startswith(_HDF5):
        return b"libbreast sha256" in tail or (b"breast" in head and b"mm-g-s" in head)
    if b"<VTKFile" in front:
        return b"<!-- sha256 of everything above" in tail or b'Name="history"' in head
    if front.startswith(_MARKED):
        return b"libbreast" in front
    report = front.lstrip()[:1] == b"{" and front.lstrip()[1:].lstrip().startswith(b'"tool"')
    table = tail.endswith(b"\n\r\n") and not tail.endswith(b"\r\n\r\n")
    return report or table


def check_replaceable(target: str | os.PathLike[str], label: str) -> None:
    """Raises BreastError if a file that libbreast did not write stands at the target; `label` is the argument that named it."""
    if os.path.exists(target) and not is_stream(target) and not written_by_us(target):
        raise BreastError(f"{label}: {os.fspath(target)} exists and does not look like a result of libbreast, so that it is not "
                          "replaced: give another output, or remove it")
