# SPDX-License-Identifier: GPL-3.0-or-later
"""Words with which a shell can complete a `breast` command line."""
from __future__ import annotations

from collections.abc import Sequence

from .commands import COMMANDS, PIPELINE_COMMANDS
from .installation import Installation


def _options_of(installation: Installation, command: str) -> str:
    """The options of a tool or command, as help_completion lists them."""
    if command in PIPELINE_COMMANDS:
        from .declaration import help_completion
        from .request import pipeline_command
        return help_completion(pipeline_command(command))
    if command in installation.tools:
        from .child import capture_child
        return capture_child([installation.tool(command), "--help-completion"]).out
    return ""


def completions(installation: Installation, words: Sequence[str]) -> list[str]:
    """Candidates for the last of `words` (the words after `breast`, the last one incomplete), not yet filtered by its beginning; empty if
    a file name is expected. Options are obtained from the tools themselves."""
    names = [*COMMANDS, *installation.tools]
    if len(words) < 2:
        return names
    command, last = words[0], words[-1]
    if command == "help":
        return [*names, "settings"] if len(words) == 2 else []
    before = len(words) - 2
    if words[before] == "=" and before > 0:  # bash splits "--element=q1p0" at the equals sign
        before -= 1
    options = [line.split("\t") for line in _options_of(installation, command).splitlines()]
    for name, kind, choices in options:
        if name == words[before] and kind != "flag":
            return choices.split()
    if last.startswith("-"):
        return [name for name, _, _ in options]
    # A setting begins with a capital; anything else is a file.
    if command not in PIPELINE_COMMANDS or not "A" <= last[:1] <= "Z":
        return []
    from .pipeline import pipeline_settings
    return [setting + "=" for setting in pipeline_settings(installation)]
