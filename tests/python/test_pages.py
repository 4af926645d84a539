# SPDX-License-Identifier: GPL-3.0-or-later
"""The commands and scripts of docs/python.md and of the tutorial run as they are written, on the demonstration; links lead somewhere."""
import os
import re
import subprocess
import unittest
from pathlib import Path

import numpy as np

import small_run

PAGES = small_run.source / "docs"


def blocks(page: str, language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```$", (PAGES / page).read_text(encoding="utf-8"), re.M | re.S)


class Pages(unittest.TestCase):
    def setUp(self) -> None:
        """A folder in which the project's own python/ and docs/ lie, and runs/average is the demonstration."""
        self.folder = small_run.scratch("pages")
        (self.folder / "runs").mkdir()
        for link, there in (("python", small_run.source / "python"), ("docs", PAGES), ("runs/average", small_run.demo())):
            (self.folder / link).symlink_to(there)

    def shell(self, commands: str) -> str:
        environment = {**os.environ, "PYTHONDONTWRITEBYTECODE": "1", "MPLCONFIGDIR": str(self.folder / "matplotlib")}
        done = subprocess.run(["/bin/sh", "-eu", "-c", commands], cwd=self.folder, env=environment, capture_output=True,
                              text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""), commands)
        return done.stdout

    def test_the_examples_of_the_python_page(self) -> None:
        command, examples = blocks("python.md", "sh"), blocks("python.md", "python")
        self.assertEqual((len(command), len(examples)), (1, 5))
        listed = self.shell(command[0])
        for name in ("cc", "geometry", "labels", "mesh", "mlo", "reference", "supine"):
            self.assertRegex(listed, rf"<Run runs/average: .*\b{name}\b")
        (self.folder / "examples.py").write_text("\n".join(examples), encoding="utf-8")
        said = self.shell("PYTHONPATH=python /usr/bin/python3 examples.py").splitlines()
        self.assertRegex(said[0], r"^CC: \d+ to \d+ mm, paddle \d+ N, detector \d+ N$")
        self.assertIn("[ True False]", said[1])
        self.assertIn("fibroglandular", said[-2])

    def test_the_figure_of_the_tutorial(self) -> None:
        page = "tutorials/figure-in-python.md"
        commands = blocks(page, "sh")
        self.assertEqual(len(commands), 1)
        said = self.shell(commands[0])
        self.assertEqual((self.folder / "figure.py").read_text(encoding="utf-8"), "".join(blocks(page, "python")))
        row = re.search(r"^nipple: ([\d.]+) mm from the wall, moves by ([\d.]+) mm$", said, re.M)
        import breast
        report = breast.load(small_run.demo()).reports["supine"]["landmarks"]["nipple"]
        self.assertAlmostEqual(float(row[2]), report["distance_mm"], delta=0.051)
        import matplotlib.image
        picture = matplotlib.image.imread(self.folder / "motion.png")
        self.assertGreater(picture.shape[1], 1000)
        self.assertGreater(np.std(picture[..., :3]), 0.05)  # not blank


class Links(unittest.TestCase):
    def test_links_lead_to_a_file_and_a_heading_and_pictures_have_words(self) -> None:
        def headings(page: Path) -> set[str]:
            titles = re.findall(r"^#+ (.*)$", page.read_text(encoding="utf-8"), re.M)
            return {re.sub(r"[^\w\- ]", "", title.strip().lower()).replace(" ", "-") for title in titles}
        found = 0
        for page in [page for pattern in ("*.md", "docs/**/*.md", "pipelines/**/*.md") for page in small_run.source.glob(pattern)]:
            text = re.sub(r"^```.*?^```$", "", page.read_text(encoding="utf-8"), flags=re.M | re.S)
            for picture, words, to in re.findall(r"(!?)\[([^\]]*)\]\(([^)\s]+)\)", text):
                with self.subTest(page=page.name, to=to):
                    self.assertTrue(not picture or len(words.split()) > 3, "says what it shows")
                    name, _, heading = to.partition("#")
                    if not re.match("https?:", to):
                        found += 1
                        self.assertTrue((page.parent / name).exists())
                        self.assertTrue(not heading or heading in headings(page.parent / name if name else page))
        self.assertGreater(found, 100)


if __name__ == "__main__":
    unittest.main()
