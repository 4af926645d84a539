# SPDX-License-Identifier: GPL-3.0-or-later
"""Case files: the settings of one patient, one KEY = VALUE per line. They are read as data; nothing in them is executed."""
from __future__ import annotations

import os
import re
from collections.abc import Sequence

from ..command.nearest import suggestion
from ..errors import BreastError
from ..text_table import read_text
from .make_text import code_in, has_control

_MOST_BYTES = 65536
_BLANKS = " \t\r\v\f"
_LINE = re.compile(r"([A-Za-z_]+)[ \t\r\v\f]*=(.*)", re.DOTALL)
_COMMENT = re.compile(r"[ \t]#.*", re.DOTALL)


def _split(line: str) -> tuple[str, str] | None:
    """Key and value of a line without blanks around it; a comment begins at a '#' that follows a blank."""
    found = _LINE.fullmatch(line)
    return (found[1], _COMMENT.sub("", found[2].strip(_BLANKS)).strip(_BLANKS)) if found else None


def parse_case_file(text: str, name: str, known: Sequence[str]) -> dict[str, str]:
    """The settings in the text of a case file; `known` lists the keys that it may contain.

    Raises BreastError, naming the file and the line, for a line that is not KEY = VALUE, an unknown or repeated key, and a value
    with a control character or one that make or a shell would interpret as code; and for a text larger than 64 kB.
    """
    what = "case file " + name
    size = len(text.encode("utf-8", "surrogateescape"))
    if size > _MOST_BYTES:
        raise BreastError(f"{what} has {size} bytes and may not be larger than 64 kB")
    found: dict[str, str] = {}
    for number, line in enumerate(text.split("\n"), 1):
        at, content = f"{what}, line {number}", line.strip(_BLANKS)
        if not content or content.startswith("#"):
            continue
        split = _split(content)
        if split is None:
            raise BreastError(f"{at}: this line is not KEY = VALUE; a case file is data, and nothing in it is executed")
        key, value = split
        if key not in known:
            raise BreastError(f"{at}: {key} is no setting of a case{suggestion(key, known)}")
        if key in found:
            raise BreastError(f"{at}: {key} is given for the second time; remove one of the two lines")
        if code_in(value):
            raise BreastError(f"{at}: {key} contains the character {code_in(value)}, which make or a shell would read as code; give "
                              "a name without it, or a link that has such a name (ln -s)")
        if has_control(value):
            raise BreastError(f"{at}: the value of {key} contains a control character; write the line again in a text editor")
        found[key] = value
    return found


def read_case_file(file: str | os.PathLike[str], known: Sequence[str]) -> dict[str, str]:
    """The same of a file; raises BreastError also if it cannot be read."""
    name = os.fspath(file)
    if not os.path.isfile(name):
        raise BreastError(f"case file {name} does not exist or is not a file that can be read; check CASE_FILE")
    if os.path.getsize(name) > _MOST_BYTES:
        raise BreastError(f"case file {name} has {os.path.getsize(name)} bytes and may not be larger than 64 kB")
    return parse_case_file(read_text(name), name, known)


def setting_in(text: str, key: str) -> str:
    """The value of a key in the text of a case file that was accepted before; "" if it is not there."""
    splits = (_split(line.strip(_BLANKS)) for line in text.split("\n"))
    return next((split[1] for split in splits if split and split[0] == key), "")
