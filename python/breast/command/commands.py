# SPDX-License-Identifier: GPL-3.0-or-later
"""The commands of `breast` other than the tools, and its pages of help."""
from __future__ import annotations

from collections.abc import Iterable, Mapping

from .installation import Installation

COMMANDS = {
    "run": "from a breast MR scan to the page of both mammographic views (the whole chain)",
    "demo": "the same on a simulated breast whose true shapes are known",
    "page": "only the page, without the table and the pictures that `run` and `demo` also make",
    "cohort": "the whole chain on every patient (case file) of a folder",
    "list": "list the tools, one per line",
    "help": "help on a command, a tool or a setting; `help settings` lists what SETTING=value may be",
}
PIPELINE_COMMANDS = ("run", "demo", "page", "cohort")
SUMMARY = "from a breast MR scan to a mechanical model: all tools and the pipeline under one name"


def _aligned(entries: Mapping[str, str], indent: str) -> str:
    width = max(map(len, entries))
    return "".join(f"{indent}{name:{width + 2}}{summary}".rstrip() + "\n" for name, summary in entries.items())


def tool_list(installation: Installation) -> str:
    """Lines of "NAME  summary"."""
    return _aligned(installation.tools, "")


def overview(installation: Installation) -> str:
    """The output of `breast help`."""
    return (f"breast - {SUMMARY}\n\nUsage: breast COMMAND|TOOL [ARGUMENT]...\n\nCommands:\n{_aligned(COMMANDS, '  ')}"
            "\n`run` chains these tools: segment, fit-hermite, hexmesh, backward, forward, compress (CC, MLO), project-mammogram, cc2mlo,\n"
            "sensitivity (for the bands), match-lookup, tabulate (the page).\n"
            f"\nTools:\n{_aligned(installation.tools, '  ')}"
            "\nExamples:\n  breast demo\n  breast run scan.nrrd\n  breast help compress\n"
            f"\nDocumentation: {installation.documentation}; manual pages: man breast, man breast-compress\n")


def unknown_command(installation: Installation, given: str, more: Iterable[str] = ()) -> str:
    """"'segmnt' is no command, tool or setting; did you mean 'segment'?", with up to three names, also of `more`."""
    from .nearest import nearest
    names, near = [*COMMANDS, *installation.tools, *more], []
    while len(near) < 3 and (best := nearest(given, names)):
        near.append(best)
        names.remove(best)
    hint = f"did you mean {' or '.join(map(repr, near))}?" if near else "`breast help` lists them"
    return f"'{given}' is no command, tool or setting; {hint}"
