# SPDX-License-Identifier: GPL-3.0-or-later
"""The record of the run from which a table of the documents was made."""
import contextlib
import subprocess
from pathlib import Path

from breast_validation import documents
from in_folder import StandingInFolder


class CommitOfATable(StandingInFolder):
    def setUp(self) -> None:
        super().setUp()
        for name in ("docs/tables/table.tsv", "program.cpp"):
            Path(name).parent.mkdir(parents=True, exist_ok=True)
            Path(name).write_text("one\n")
        self.git("init", "-q")
        self.git("add", ".")
        self.git("-c", "user.name=somebody", "-c", "user.email=somebody@example.org", "-c", "commit.gpgsign=false",
                 "commit", "-q", "-m", "first")

    def git(self, *words: str) -> None:
        subprocess.run(["git", *words], check=True)

    def test_the_table_that_is_being_made_is_no_change_of_the_programs(self) -> None:
        Path("docs/tables/table.tsv").write_text("two\n")
        self.assertRegex(documents._commit_here(), r"^[0-9a-f]{7,}$")
        with contextlib.chdir("docs"):
            self.assertRegex(documents._commit_here(), r"^[0-9a-f]{7,}$", "from any folder of the tree")
        Path("program.cpp").write_text("two\n")
        self.assertRegex(documents._commit_here(), r"^[0-9a-f]{7,}-dirty$")
        with contextlib.chdir("docs"):
            self.assertRegex(documents._commit_here(), r"^[0-9a-f]{7,}-dirty$", "from any folder of the tree")
