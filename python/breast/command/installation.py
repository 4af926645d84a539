# SPDX-License-Identifier: GPL-3.0-or-later
"""The installation to which a running `breast` belongs: its tools and its pipeline.

The installation of a program PREFIX/bin/breast is PREFIX/libexec/breast and PREFIX/share/breast; in a build tree it is the program's own
folder and the source tree three folders up. tools.tsv lists the tools of the build with their summaries.
"""
from __future__ import annotations

import os

from ..errors import Failed


class Installation:
    """programs: folder of the tools; pipeline: Makefile.pipeline; tools: those that are there, with their summaries, by name.

    Raises Failed if the program belongs to no installation.
    """

    def __init__(self, program: str) -> None:
        folder = os.path.dirname(os.path.realpath(program))
        prefix = os.path.dirname(folder)
        self.is_package = os.path.isdir(os.path.join(prefix, "libexec/breast"))
        if self.is_package:
            self.programs = os.path.join(prefix, "libexec/breast")
            self.root = os.path.join(prefix, "share/breast")
            table = os.path.join(self.root, "tools.tsv")
        else:
            self.programs = folder
            self.root = os.path.dirname(os.path.dirname(prefix))
            table = os.path.join(prefix, "tools.tsv")
        self.pipeline = os.path.join(self.root, "Makefile.pipeline")
        self.tools = {name: summary for name, summary in _entries(table) if os.access(self.tool(name), os.X_OK)}
        if not self.tools:
            raise Failed(f"no tools in {self.programs}: the installation of {program} is incomplete")

    def tool(self, name: str) -> str:
        return os.path.join(self.programs, name)

    @property
    def pipelines(self) -> str:
        """Folder of the settings, materials and studies."""
        return os.path.join(self.root, "pipelines")

    @property
    def documentation(self) -> str:
        return os.path.join(os.path.dirname(self.root), "doc/libbreast") if self.is_package else os.path.join(self.root, "docs")


def _entries(table: str) -> list[tuple[str, str]]:
    try:
        with open(table, encoding="utf-8") as file:
            return sorted((line.rstrip("\n").split("\t")[0], line.rstrip("\n").split("\t")[1]) for line in file)
    except OSError:
        return []
