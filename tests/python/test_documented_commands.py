# SPDX-License-Identifier: GPL-3.0-or-later
"""Every command that a page shows is run on the demonstration, or planned, or listed here with the reason why it is not."""
import re
import shlex
import shutil
import unittest
from functools import lru_cache
from pathlib import Path

import small_run

PAGES = ("README.md", "CONTRIBUTING.md", "docs/*.md", "docs/tutorials/*.md", "docs/validation/*.md", "pipelines/studies/README.md")
TOOLS = {file.stem for file in (small_run.source / "docs/tools").glob("*.md")}
STARTERS = TOOLS | {"make", "cmake", "ctest", "ninja", "apt-get", "podman", "mpirun", "ccx"}
NOT_RUN = {
    "apt-get": "installs packages: root and network",
    "podman": "builds a container: network",
    "cmake": "configures, builds or installs the project, in which this test itself runs",
    "ninja": "builds",
    "ctest": "runs tests, of which this is one",
    "tests/": "a test of its own, or one that takes hours",
    "build/release/tests/": "a test of its own",
    "mpirun": "needs PETSc and 16 cores; tests/tools/mpi_tools.cpp runs both programs",
    "ccx": "CalculiX is no part of the project; tests/tools/calculix.cpp runs it where it is installed",
    "export-deck reference.vtkhdf": "for a breast that is held at its wall; tests/tools/calculix.cpp runs it",
    "probe supine.vtkhdf supine-ccx.vtkhdf": "reads CalculiX's solution; tests/tools/calculix.cpp runs it",
    "project-mammogram cc.vtkhdf big.vti": "an image of 0.07 mm takes ten seconds; that of 0.14 mm on the same page is made",
    "breast cohort patients --slurm": "asks make, which first builds; tests/tools/slurm.sh submits cohorts",
    "breast run export": "the export of the tutorial, which tests/tools/tutorial.sh makes and runs",
    "phantom paper.nrrd": "a phantom of full size takes a minute; tests/tools/phantom.cpp makes smaller ones",
}
"""What a command that is neither run nor planned begins with, and why."""
STAND_INS = {"SCAN": "scan.nrrd", "DIR": "patients"}
"""Words of a page that stand for a file of the user."""
USAGE = re.compile(r"…|\.\.\.|→|\b(MR|NAME|ARGUMENT|PROGRAMS?|RUNS?|KIND|FOLDER|TRUTH|P\.nrrd)\b(?!=)|^scan \(")
"""A command that only shows how it is used, or a line of a drawing: there is nothing to run as it stands."""
OF_PAPER = {row.split("\t")[0] for row in (small_run.source / "pipelines/goals.tsv").read_text(encoding="utf-8").splitlines()
            if "paper" in row.partition("\t")[2].split()}
"""Targets whose phantom is another one than that of the demonstration."""
IN_CODE = re.compile(r"`([^`]+)`")
NAMES_A_FILE = re.compile(r"\S+\.(vtkhdf|vti|vtp|nrrd|tsv|h5|json)\b")


def _joined(lines: list[tuple[int, str]]) -> list[tuple[int, str]]:
    """Lines, with those that end in a backslash continued."""
    whole: list[tuple[int, str]] = []
    for number, line in lines:
        if whole and whole[-1][1].endswith("\\"):
            whole[-1] = (whole[-1][0], whole[-1][1][:-1].rstrip() + " " + line.strip())
        else:
            whole.append((number, line.strip()))
    return whole


def commands_of(text: str) -> list[tuple[int, str]]:
    """Commands, with the number of their line, in indented blocks and, where they name a target or a file, in running text.

    Blocks of a language are left out: tests/tools/tutorial.sh and test_pages.py run those as a whole.
    """
    fenced, blocks, running = False, [], []
    for number, line in enumerate(text.splitlines(), 1):
        if line.startswith("```"):
            fenced = not fenced
        elif not fenced:
            (blocks if line.startswith("    ") else running).append((number, line))
    found = []
    for number, line in _joined(blocks):
        for one in re.split(r"\s#\s", line)[0].split(" | "):
            first = next((word for word in one.split() if "=" not in word), "")
            if first in STARTERS or first.startswith(("tests/", "build/release/tests/")):
                found.append((number, one.strip()))
    prose = "\n".join(line for _, line in running)
    for code in IN_CODE.finditer(prose):
        words = " ".join(code[1].split())
        if words.split(" ")[0] in STARTERS and (words.startswith(("make -", "breast ")) or NAMES_A_FILE.search(words)):
            found.append((running[prose.count("\n", 0, code.start())][0], words))
    return found


@lru_cache(maxsize=None)
def all_commands() -> dict[str, str]:
    """Every command that can be run as it stands, once, with the place where it stands first."""
    commands: dict[str, str] = {}
    for page in [page for pattern in PAGES for page in sorted(small_run.source.glob(pattern))]:
        for number, words in commands_of(page.read_text(encoding="utf-8")):
            for name, file in STAND_INS.items():
                words = re.sub(rf"\b{name}\b(?!=)", file, words)
            if not USAGE.search(words):
                commands.setdefault(words, f"{page.relative_to(small_run.source)}:{number}")
    return commands


def exception_of(words: str) -> str:
    return next((start for start in NOT_RUN if words.startswith(start)), "")


class DocumentedCommands(unittest.TestCase):
    """In a folder like a clone of the project, with a scan and case files beside it."""

    @classmethod
    def setUpClass(cls) -> None:
        cls.clone = small_run.planning_folder("documented")

    def check(self, folder: Path, words: str, *more: str) -> None:
        with self.subTest(words, place=all_commands()[words]):
            done = small_run.run_in(folder, [*shlex.split(words), *more])
            self.assertEqual(done.returncode, 0, f"{done.stdout[-300:]}{done.stderr[-800:]}")

    def of(self, *starts: str) -> list[str]:
        """The commands that begin with one of these words and are no exceptions."""
        return [words for words in all_commands() if words.split()[0] in starts and not exception_of(words)]

    def test_every_exception_is_needed(self) -> None:
        used = {exception_of(words) for words in all_commands()}
        self.assertEqual(sorted(set(NOT_RUN) - used), [])

    def test_targets_of_make_are_planned(self) -> None:
        """Settings, targets and what these need are checked, and every rule on the way must exist; nothing is computed.

        Commands that differ in their target only are planned together, and alone if that fails. Of a make that starts others, those
        are left out: they are of the same makefile.
        """
        alike: dict[tuple[str, ...], list[str]] = {}
        for words in self.of("make"):
            parts = shlex.split(words)
            targets = [part for part in parts[1:] if re.fullmatch(r"[a-z][a-z0-9-]*", part)]
            settings = sorted(part for part in parts if "=" in part)
            alike.setdefault((str(bool(OF_PAPER.intersection(targets))), str("check" in targets), *settings), []).append(words)
        for commands in alike.values():
            together = dict.fromkeys(word for words in commands for word in shlex.split(words)[1:] if not word.startswith("-j"))
            if small_run.run_in(self.clone, ["make", "-n", "MAKE=true", *together]).returncode != 0:
                for words in commands:
                    self.check(self.clone, words, "-n", "MAKE=true")

    def test_the_command_breast(self) -> None:
        for words in self.of("breast"):
            planned = words.split()[1] in ("run", "demo", "page", "cohort")
            if planned or words.split()[1] in ("list", "help"):
                self.check(self.clone, words, *(["--dry-run"] if planned else []))

    def test_tools_on_the_demonstration(self) -> None:
        """Those of a page in order, in a folder with the files of a run, both mammograms as DICOM, and a scan; that of the run is beside."""
        dicom = small_run.scratch("documented-dicom")
        for view in ("cc", "mlo"):
            small_run.tool(f"project-mammogram {small_run.demo()}/{view}.vtkhdf {dicom}/{view}.vti --dicom {dicom}/{view}.dcm", dicom)
        small_run.link_to(small_run.scratch("phantom"), (small_run.demo().parent / "phantom").glob("*.nrrd"))
        done: set[str] = set()
        pages: dict[str, list[str]] = {}
        for words in self.of("breast", *TOOLS):
            call = words.removeprefix("breast ")
            if call.split()[0] in TOOLS - {"breast"} and call not in done:
                done.add(call)
                pages.setdefault(all_commands()[words].split(":")[0], []).append(words)
        for commands in pages.values():
            folder = small_run.scratch("documented-page")
            for file in small_run.demo().iterdir():
                if file.is_file():
                    shutil.copy(file, folder)
            small_run.link_to(folder, [*dicom.glob("*.dcm"), self.clone / "scan.nrrd"])
            for words in commands:
                self.check(folder, words)

    def test_examples_of_the_tools_have_the_options_that_they_use(self) -> None:
        for page in sorted((small_run.source / "docs/tools").glob("*.md")):
            before, _, examples = page.read_text(encoding="utf-8").partition("## Examples")
            known = set(re.findall(r"--[a-z][a-z0-9-]*", before))
            for example in re.findall(r"(?<=^```\n)[^`]+", examples, re.M):
                used = set(re.findall(r"(?<=\s)--[a-z][a-z0-9-]*", example)) if example.split()[0] == page.stem else set()
                self.assertLessEqual(used, known, f"{page.name}: {example}")


if __name__ == "__main__":
    unittest.main()
