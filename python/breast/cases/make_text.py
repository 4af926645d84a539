# SPDX-License-Identifier: GPL-3.0-or-later
"""Text that make or a shell would read as code."""
from __future__ import annotations

CODE = "$`;&|<>(){}[]*?!\"'\\^#"
# Of these, a name of one word may hold none either: they mean something in rules, in patterns and to a shell.
NAME_CODE = CODE + "=:%~"


def code_in(text: str) -> str:
    """The first character that a shell or make would interpret as code; "" if there is none."""
    return next((c for c in text if c in CODE), "")


def has_control(text: str) -> bool:
    """Whether the text has a control character."""
    return any(c < " " or c == "\x7f" for c in text)
