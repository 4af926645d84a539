# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of breast.study share: a folder of files, and shapes without files."""
from pathlib import Path
from unittest import mock

import in_folder

from breast.study.table import Table, parse_table


def table_of(text: str) -> Table:
    return parse_table(text, "table")


class InFolder(in_folder.InFolder):
    def write(self, name: str, text: str = "x") -> Path:
        """A file of the folder, with the folders above it."""
        file = self.folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
        return file

    def shapes(self, **shifts: float) -> None:
        """Shapes named by FOLDER__FILE or FILE, without their ending: the nipple is so many mm beyond its imaged position."""
        def read(file: Path):
            name = file.stem.replace("-", "_")
            shift = shifts.get(f"{file.parent.name.replace('-', '_')}__{name}", shifts.get(name, 0.0))
            return {"nipple": ((1.0, 0.0, 0.0), (1.0 + shift, 0.0, 0.0)),
                    "artificial_tumour": ((0.0, 0.0, 0.0), (0.0, shift / 2, 0.0))}

        patch = mock.patch("breast.study.shapes.read_shape", read)
        patch.start()
        self.addCleanup(patch.stop)
