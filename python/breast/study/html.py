# SPDX-License-Identifier: GPL-3.0-or-later
"""Self-contained HTML pages from the templates beside this module: every text is escaped, nothing is fetched, no script runs.

A page shows blocks, each of which names the macro of templates/blocks.html.jinja that writes it.
"""
from __future__ import annotations

import re
from base64 import b64encode
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ..text_table import read_text
from .files import exists, valid
from .summary import lines_of

_TEMPLATES = Path(__file__).with_name("templates")
_STANDS_OUT = ("fails", "differs", "missing", "failed")
_NUMBER = re.compile(r"[-+0-9.eE]+")
_UNIT = re.compile(r"(?<=\d) (?=(?:mm|cm2|ml|N|kPa|degrees)\b|%)")


@dataclass
class Block:
    """macro: text, small_heading, table, figure, list, pre or warnings; `shows` is what it takes."""

    macro: str
    shows: tuple[Any, ...]


@dataclass
class Section:
    """A heading with its blocks; left out where it has none."""

    title: str
    blocks: list[Block | None] = field(default_factory=list)

    @property
    def shown(self) -> list[Block]:
        return [block for block in self.blocks if block is not None]


def text(*words: str) -> Block:
    return Block("text", ("".join(words),))


def table(header: list[str], rows: list[list[str]]) -> Block:
    """Numbers are right-aligned; cells "fails", "differs", "missing" and "failed" are highlighted."""
    return Block("table", (header, [[(_cell_class(cell), cell) for cell in row] for row in rows]))


def table_of_text(tsv: str) -> Block | None:
    """Tab-separated text as a table; comments are omitted; None if it has no row."""
    rows = [line.split("\t") for line in lines_of(tsv) if line not in ("", "\r") and not line.startswith("#")]
    return table([name.replace("_", " ") for name in rows[0]], rows[1:]) if rows else None


def table_of(file: Path) -> Block | None:
    return table_of_text(read_text(file)) if file.is_file() else None


def figure(png: Path, caption: str) -> Block | None:
    """The picture inline, with its caption; None if the file is absent."""
    return Block("figure", (data_uri(png.read_bytes(), "png"), caption)) if exists(png) else None


def data_uri(picture: bytes, kind: str) -> str:
    return f"data:image/{kind};base64,{b64encode(picture).decode()}"


def page(template: str, folder: Path = _TEMPLATES, **context: Any) -> str:
    """The page of NAME.html.jinja in a folder of templates. Bytes that are not UTF-8 become U+FFFD."""
    import jinja2

    loader = jinja2.FileSystemLoader([folder, _TEMPLATES])
    environment = jinja2.Environment(loader=loader, autoescape=True, trim_blocks=True, lstrip_blocks=True,
                                     undefined=jinja2.StrictUndefined, finalize=_unbroken)
    return valid(environment.get_template(f"{template}.html.jinja").render(**context))


def _unbroken(shown: Any) -> Any:
    """Numbers stay on one line with their units."""
    return _UNIT.sub("\u00a0", shown) if type(shown) is str else shown


def _cell_class(cell: str) -> str:
    return "bad" if cell in _STANDS_OUT else "n" if _NUMBER.fullmatch(cell) else ""
