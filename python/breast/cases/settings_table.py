# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings of the pipeline (pipelines/settings.tsv) and the values that each of them accepts."""
from __future__ import annotations

import os
import re
from pathlib import Path
from typing import NamedTuple

from ..command.nearest import suggestion
from ..errors import BreastError
from ..text_table import parse_number, read_table
from .make_text import NAME_CODE, code_in, has_control

_RADIUS_MM = 50.0  # the largest of a tumour


class Setting(NamedTuple):
    """A row of settings.tsv; kind: path, name, text, words or program; of_case: whether a case file may contain it; value, default, help:
    what it is given, what it is otherwise if settings.mk does not say it plainly, and what it does, in words."""

    name: str
    kind: str
    of_case: bool = False
    choices: tuple[str, ...] = ()
    may_hold: str = ""
    value: str = ""
    default: str = ""
    help: str = ""

    @property
    def is_words(self) -> bool:
        return self.kind in ("text", "words", "program")


def read_settings(pipelines: Path) -> list[Setting]:
    """The settings of the pipeline in the folder `pipelines`, in the order of the table."""
    return [Setting(row["setting"], row["kind"], row["of"] == "case", tuple(row["choices"].split()), row["may_hold"],
                    *(row.get(column, "") for column in ("value", "default", "help")))
            for row in read_table(pipelines / "settings.tsv").records()]


def check_characters(setting: Setting, value: str) -> None:
    """Raises BreastError, naming the setting and the character, if make or a shell would interpret a part of the value as code; for a
    setting of one word also if it contains a blank or begins with a dash."""
    name = setting.name
    advice = "write the value without it" if setting.is_words else "give a name without it, or a link that has such a name (ln -s)"
    if has_control(value.replace("\t", "")):
        raise BreastError(f"{name}: a control character may not stand in it; {advice}")
    code = code_in(value)
    if not setting.is_words and not code:
        code = next((c for c in value if c in NAME_CODE and c not in setting.may_hold), "")
    if code:
        raise BreastError(f"{name}: the character {code} may not stand in it, because make or a shell would read it as code; {advice}")
    if setting.is_words:
        return
    if len(value.split()) > 1:
        raise BreastError(f"{name}: blanks may not stand in '{value}'; give a name without blanks, or a link that has such a name "
                          "(ln -s)")
    if value.startswith("-") and name != "TUMOUR":  # the coordinates of a tumour may be negative
        raise BreastError(f"{name}: '{value}' begins with a dash and would be read as an option; write ./{value}")


def _check_number(setting: Setting, word: str) -> None:
    name, choices = setting.name, setting.choices
    if not re.fullmatch(r"[0-9.]+", word) or word.count(".") > 1 or word == ".":
        raise BreastError(f"{name}: '{word}' is not a number; write digits and at most one decimal point, as 40 or 2.5")
    if choices[0] == "integer" and "." in word:
        raise BreastError(f"{name}: '{word}' is not a whole number")
    if len(choices) >= 3 and not parse_number(choices[1], name) <= parse_number(word, name) <= parse_number(choices[2], name):
        raise BreastError(f"{name}: {word} must be from {choices[1]} to {choices[2]}")


def _check_place(setting: Setting, word: str) -> None:
    """Refuses a word that is neither one of the choices, nor a file, nor x,y,z[:radius] in mm."""
    name = setting.name
    if word in setting.choices or os.path.isfile(word):
        return
    if "," not in word:
        raise BreastError(f"{name}: '{word}' is neither a file, nor auto, nor none, nor x,y,z[:radius] in mm")
    place, colon, radius = word.partition(":")
    if place.count(",") != 2:
        raise BreastError(f"{name} {word}: expected auto, none, a file, or x,y,z[:radius] in mm")
    for part in place.split(","):
        parse_number(part, name)
    if colon and not 0 < parse_number(radius, name + " radius") <= _RADIUS_MM:
        raise BreastError(f"{name} {word}: radius {parse_number(radius, name):g} mm must be above 0 and at most {_RADIUS_MM:g}")


def _accepted(setting: Setting, word: str, pipelines: Path) -> list[str]:
    """What a word of the setting may be; % stands for any text."""
    kind = setting.choices[0]
    if kind.startswith("rows:"):
        study = read_table(pipelines / "studies" / (kind.removeprefix("rows:") + ".tsv"))
        return [row["variant"] for row in study]
    if kind == "set":
        return ["%"] if os.path.exists(word) else sorted(file.stem for file in (pipelines / "materials").glob("*.tsv"))
    return list(setting.choices)


def check_choice(setting: Setting, value: str, pipelines: Path) -> None:
    """Raises BreastError, naming the setting, the value and what is accepted, if the value is not among the choices.

    A choice is a word, in which % stands for any text, or one of these kinds. `number` or `integer`: optionally followed by the
    least and the greatest value. `place`, after the words: a file, or x,y,z[:radius] in mm. `set`: a material set in `pipelines` or
    a file. `rows:STUDY`: a row of that study. An empty value is accepted.
    """
    for word in value.split() if setting.choices else ():
        if setting.choices[0] in ("number", "integer"):
            _check_number(setting, word)
        elif setting.choices[-1] == "place":
            _check_place(setting, word)
        else:
            accepted = _accepted(setting, word, pipelines)
            if not any(word.startswith(c.partition("%")[0]) if "%" in c else word == c for c in accepted):
                what = "is neither a file nor one of" if setting.choices[0] == "set" else "is none of"
                raise BreastError(f"{setting.name}: '{word}' {what} {', '.join(accepted)}{suggestion(word, accepted)}")
