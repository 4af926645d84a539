# SPDX-License-Identifier: GPL-3.0-or-later
"""File names for make and its shell: those that can be used directly, and links for the others."""
from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

from ..cases.make_text import NAME_CODE
from ..errors import BreastError


def _plain(c: str) -> bool:
    # A byte of a name that is not UTF-8 is one of these surrogates.
    return c > " " and c != "\x7f" and c not in NAME_CODE and not "\ud800" <= c <= "\udfff"


def plain_for_make(path: str) -> bool:
    """Whether make and a shell read a path as a plain name: no blank, no control character, none of the characters that settings
    refuse in names, no dash in front, and valid UTF-8."""
    return bool(path) and not path.startswith("-") and all(map(_plain, path))


def plain_name(name: str) -> str:
    """The name with every character that is not plain replaced by an underscore."""
    return "".join(c if _plain(c) and not (at == 0 and c == "-") else "_" for at, c in enumerate(name))


def _mark_of(file: str) -> str:
    """A name that is the same for the same file and differs from those of other files: FNV-1a of its path."""
    value = 1469598103934665603
    for byte in os.fsencode(file):
        value = ((value ^ byte) * 1099511628211) & 0xFFFFFFFFFFFFFFFF
    return f"{value:x}"


def _link_to(target: str, link: Path) -> None:
    link.parent.mkdir(parents=True, exist_ok=True)
    if link.is_symlink() and os.readlink(link) == target:
        return
    link.unlink(missing_ok=True)
    link.symlink_to(target)


def _link_files(folder: str, links: Path) -> None:
    """A folder of links to the files of a folder, which are numbered if a name is not plain."""
    links.mkdir(parents=True, exist_ok=True)
    kept = set()
    for number, own in enumerate(sorted(os.listdir(folder), key=os.fsencode), 1):
        name = own if plain_for_make(own) else f"file-{number}-{plain_name(own)}"
        kept.add(name)
        _link_to(os.path.join(folder, own), links / name)
    for entry in links.iterdir():
        if entry.name not in kept:
            entry.unlink()


def _ways(file: str, whole: str) -> Iterator[str]:
    """The names by which a file can be called: as given, from the present folder, from the root."""
    yield file
    yield os.path.relpath(whole)
    yield whole


def name_for_make(given: str, links: Path) -> str:
    """A path of `given` for make, run in the present folder.

    It is `given` itself, or relative to that folder, if that is plain; otherwise it is a link in `links`, which is created. If a file
    or folder has a plain name of its own, the folder above it is linked (so that a detached header keeps its data beside it). A
    folder that contains a file with a name that is not plain (slices of a scan) is linked file by file. The link is the same
    whenever the file is. Raises BreastError for a detached header with a name that is not plain, and if `given` does not exist.
    """
    if not os.path.exists(given):
        raise BreastError(f"'{given}' does not exist")
    file = given.rstrip("/") or "/"
    named = os.path.basename(file) not in (".", "..", "")
    whole = (os.path.join(os.path.realpath(os.path.dirname(os.path.abspath(file))), os.path.basename(file)) if named
             else os.path.realpath(file))
    own = os.path.basename(whole)
    farm = os.path.isdir(whole) and not all(map(plain_for_make, os.listdir(whole)))
    for name in () if farm else _ways(file, whole):
        if os.path.basename(name) == own and plain_for_make(name):
            return name
    link = links / _mark_of(whole) / plain_name(own)
    if farm:
        _link_files(whole, link)
        return str(link)
    if plain_for_make(own):
        above = links / _mark_of(os.path.dirname(whole))
        _link_to(os.path.dirname(whole), above)
        return str(above / own)
    if own.endswith((".nhdr", ".mhd")):
        raise BreastError(f"'{file}': a header whose data are in another file needs a name without blanks and without any of {NAME_CODE}; "
                          "rename it")
    _link_to(whole, link)
    return str(link)


def folder_for_make(folder: str) -> str:
    """A name of a folder of results that make can handle; the folder is created and must be writable.

    Raises BreastError, naming the option --runs, if there is no such name.
    """
    whole = os.path.realpath(folder)
    name = next((way for way in _ways(folder, whole) if plain_for_make(way) and way != "."), "")
    if not name:
        raise BreastError(f"--runs '{folder}': make cannot write to a folder with such a name; start from the folder above it, or "
                          "give a name without blanks, quotes and brackets")
    try:
        os.makedirs(name, exist_ok=True)
    except OSError:
        raise BreastError(f"--runs '{folder}': is not a folder and cannot be created") from None
    # Tested by writing rather than by permissions, because root has all permissions and still cannot write to /proc.
    links = Path(name) / ".names"
    try:
        if not links.is_dir():
            links.mkdir()
            links.rmdir()
    except OSError:
        raise BreastError(f"--runs '{folder}': is not writable") from None
    return name
