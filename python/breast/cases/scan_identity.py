# SPDX-License-Identifier: GPL-3.0-or-later
"""The scan and the side to which the run in a folder belongs, so that the scans of two patients never share a folder.

A scan is a file, a folder of slices, or phantom:PRESET. The file RUN/.scan contains the side, the SHA-256 hash of the scan's
content (for a phantom its name), and a stamp of its files (device, inode, size and times), by which an unchanged scan is recognised
without reading it again. It contains no path. Size and modification time alone are not sufficient, because archives may unpack the
slices of two patients with equal sizes and times.
"""
from __future__ import annotations

import hashlib
import os
from pathlib import Path

from ..errors import BreastError
from ..output import write_text
from ..text_table import read_text


def _is_phantom(scan: str) -> bool:
    return scan.startswith("phantom:")


def _hash_of_text(text: str) -> str:
    return hashlib.sha256(os.fsencode(text)).hexdigest()


def _hash_of_file(file: str) -> str:
    digest = hashlib.sha256()
    try:
        with open(file, "rb") as stream:
            while piece := stream.read(1 << 20):
                digest.update(piece)
    except OSError:
        raise BreastError(f"{file}: this file of the scan could not be read to its end; check the file and the disk") from None
    return digest.hexdigest()


def _files_below(folder: str) -> list[str]:
    found = [os.path.relpath(os.path.join(above, name), folder) for above, _, names in os.walk(folder, followlinks=True)
             for name in names]
    return sorted((name for name in found if os.path.isfile(os.path.join(folder, name))), key=os.fsencode)


def _state_of(file: str) -> str:
    try:
        s = os.stat(file)
    except OSError as error:
        raise BreastError(f"{file}: this file of the scan cannot be read ({error.strerror}); check its name and permissions") from None
    times = (f"{ns // 10**9}.{ns % 10**9}" for ns in (s.st_mtime_ns, s.st_ctime_ns))
    return f"{s.st_dev} {s.st_ino} {s.st_size} {' '.join(times)}\n"


def _check_kind(scan: str) -> None:
    """Refuses a device or a pipe, which might never end."""
    if not _is_phantom(scan) and os.path.exists(scan) and not os.path.isdir(scan) and not os.path.isfile(scan):
        raise BreastError(f"{scan}: neither a file nor a folder: give the scan's own file")


def _stamp_of(scan: str) -> str:
    if _is_phantom(scan):
        return scan
    if not os.path.isdir(scan):
        return _hash_of_text(_state_of(scan))
    return _hash_of_text("".join(f"{name} {_state_of(os.path.join(scan, name))}" for name in _files_below(scan)))


def content_of(scan: str) -> str:
    """The hash of a file or folder by content, of hashes in the format of sha256sum."""
    if _is_phantom(scan):
        return scan
    if not os.path.isdir(scan):
        return _hash_of_text(_hash_of_file(scan) + "  -\n")
    return _hash_of_text("".join(f"{_hash_of_file(os.path.join(scan, name))}  ./{name}\n" for name in _files_below(scan)))


def _remembered(record: str, key: str) -> str:
    return next((line.removeprefix(key + "\t") for line in record.split("\n") if line.startswith(key + "\t")), "")


def mixed_up(run: Path, side: str, scan: str) -> str:
    """A sentence that says why the scan and the side must not be used in RUN, which holds another run; "" if they may be used.

    Returns "" also if the scan does not exist, which make reports. Raises BreastError if a file of the scan cannot be read.
    """
    _check_kind(scan)
    if not (run / ".scan").exists() or not (_is_phantom(scan) or os.path.exists(scan)):
        return ""
    record = read_text(run / ".scan")
    held = _remembered(record, "side")
    if held != side:
        return (f"{run} holds the {held} breast of its scan, and the run asked for is of the {side} one; give it another folder with "
                "CASE=NAME, or remove the folder")
    if _remembered(record, "stamp") == _stamp_of(scan) or _remembered(record, "content") == content_of(scan):
        return ""
    return (f"{run} holds the run of another scan; give this one another folder with CASE=NAME, or remove the folder if the scan "
            "itself was replaced")


def remember_scan(run: Path, side: str, scan: str) -> None:
    """Records the scan and the side in RUN/.scan; creates the folder RUN if it does not exist.

    Raises BreastError if the folder holds another run, or a file of the scan cannot be read.
    """
    _check_kind(scan)
    run.mkdir(parents=True, exist_ok=True)
    record = f"side\t{side}\ncontent\t{content_of(scan)}\nstamp\t{_stamp_of(scan)}\n"
    # Of two runs that begin at once, one has the folder: a link is made by the first alone.
    own = run / f".scan-of-{os.getpid()}"
    write_text(own, record)
    try:
        os.link(own, run / ".scan")
        return
    except FileExistsError:
        pass
    finally:
        own.unlink()
    reason = mixed_up(run, side, scan)
    if reason:
        raise BreastError(reason)
    write_text(run / ".scan", record)
