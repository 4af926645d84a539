# SPDX-License-Identifier: GPL-3.0-or-later
"""breast: all tools and the pipeline under one name.

A tool replaces this process; what only the pipeline's commands need is imported when one of them is asked for.
"""
from __future__ import annotations

import os
import sys
from collections.abc import Sequence

from .. import __version__
from ..errors import BreastError, Failed
from .commands import PIPELINE_COMMANDS, overview, tool_list, unknown_command
from .installation import Installation


def _print(text: str) -> int:
    try:
        sys.stdout.write(text)
        sys.stdout.flush()
    except OSError:
        sys.stdout = open(os.devnull, "w")  # what could not be written is not tried again at the end
        raise Failed("stdout cannot be written") from None
    return 0


def _become(program: str, words: Sequence[str]) -> int:
    """Replaces this process by a program; returns only by raising Failed."""
    try:
        os.execv(program, [program, *words])
    except OSError as error:
        raise Failed(f"{program} could not be started: {error.strerror}") from None


def _help(installation: Installation, words: Sequence[str], everything: bool = False) -> int:
    from .declaration import help_text
    from .pipeline import pipeline_settings, setting_help, settings_help
    from .request import pipeline_command
    what = words[0] if words else "help"
    if what in PIPELINE_COMMANDS:
        return _print(help_text(pipeline_command(what), everything))
    if what == "settings":
        return _print(settings_help(installation))
    if what in installation.tools:
        return _become(installation.tool(what), ["--help"])
    if what in ("help", "list"):
        return _print(overview(installation))
    setting = setting_help(installation, what)
    if setting:
        return _print(setting)
    raise BreastError(unknown_command(installation, what, pipeline_settings(installation)))


def _run(installation: Installation, command: str, words: Sequence[str]) -> int:
    if command in installation.tools:
        return _become(installation.tool(command), words)
    if command in ("--help", "--help-all", "-h", "help"):
        return _help(installation, words)
    asked = {"--help", "--help-all"} & set(words) if command in PIPELINE_COMMANDS else set()
    if asked:
        return _help(installation, [command], everything="--help" not in asked)
    if command == "--version":
        return _print(f"breast (libbreast) {__version__}\n")
    if command == "list":
        return _print(tool_list(installation))
    if command == "--completions":
        from .completion import completions
        return _print("".join(word + "\n" for word in completions(installation, words)))
    if command not in PIPELINE_COMMANDS:
        raise BreastError(unknown_command(installation, command))
    from .pipeline import run_pipeline
    return run_pipeline(installation, command, words)


def main() -> int:
    words, who = sys.argv[1:], "breast"
    for stream in (sys.stdout, sys.stderr):
        stream.reconfigure(encoding="utf-8", errors="surrogateescape")
    try:
        installation = Installation(sys.argv[0])
        if not words:
            raise BreastError("give a command or a tool; `breast help` lists them")
        if words[0] in PIPELINE_COMMANDS:
            who = "breast " + words[0]
        return _run(installation, words[0], words[1:])
    except BreastError as error:
        reason, code = str(error), error.exit_code
    except MemoryError:
        reason, code = "out of memory", 1
    except KeyboardInterrupt:
        reason, code = "interrupted", 130
    except OSError as error:
        reason, code = f"{error.filename}: {error.strerror}" if error.filename else str(error), 1
    os.write(2, f"{who}: {' '.join(reason.splitlines())}\n".encode("utf-8", "surrogateescape"))
    return code
