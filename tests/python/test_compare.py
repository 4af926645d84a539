# SPDX-License-Identifier: GPL-3.0-or-later
"""The tool compare: two runs beside each other, as a table and as a page."""
import json
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
import small_run
from breast import Run
from breast.errors import BreastError
from breast.study.compare_page import compare_page
from breast.study.compared_model import differences, options_of
from breast.study.compared_runs import Pair
from breast.study.table import parse_table

sys.path.insert(0, str(small_run.source / "tests" / "page"))
from browser import Browser, chromium  # noqa: E402


def compared(*words):
    """Exit code, stdout and stderr of the tool."""
    ended = subprocess.run([small_run.programs / "compare", *map(str, words)], capture_output=True, text=True)
    return ended.returncode, ended.stdout, ended.stderr


class OnReports(unittest.TestCase):
    """Folders that hold reports alone."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_of(self, name, **reports):
        run = self.folder / name
        run.mkdir(parents=True)
        for stage, report in reports.items():
            (run / f"{stage}.json").write_text(json.dumps(report))
        return run

    def test_options_of_a_command(self):
        self.assertEqual(options_of("hexmesh a.vtkhdf mesh.vtkhdf --elements 16 --dome --scale fat=1 --scale skin=2 --order=2"),
                         {"hexmesh files": "a.vtkhdf mesh.vtkhdf", "hexmesh --elements": "16", "hexmesh --dome": "given",
                          "hexmesh --scale": "fat=1 skin=2", "hexmesh --order": "2"})

    def test_numbers_and_what_differs(self):
        def view(force, friction):
            return {"side": "left", "command": f"compress r.vtkhdf cc.vtkhdf --view CC{friction}", "status": "converged",
                    "force_N": force, "thickness_mm": 50,
                    "coverage": {"projected_cm2": force - 2.4, "contact_percent_of_projected": 108.2},
                    "landmarks": {"tumour": {"position": [1, 2, 3 + force], "error_estimate_mm": 0.25}}}
        pair = Pair(self.run_of("a", cc=view(80, "")), self.run_of("b", cc=view(90, " --friction 0.3")))
        rows = {row.quantity: row for row in pair.rows}
        self.assertEqual((rows["CC: force of the paddle"].first, rows["CC: force of the paddle"].difference), ("80.0", "+10.0"))
        self.assertEqual(rows["CC: thickness"].difference, "0.0")
        # Contact on the rounded edge lies behind the image: as a share of the image it would be more than 100 %.
        self.assertEqual(rows["CC: projection of the breast in the image"].first, "77.6")
        self.assertEqual([row.quantity for row in pair.rows if row.unit == "%"], [])
        tumour = rows["tumour in CC"]
        self.assertEqual((tumour.second, tumour.difference, tumour.first_error), ("1.0 2.0 93.0", "10.00", "0.25"))
        self.assertEqual([(row.quantity, row.first, row.second) for row in pair.of_topic("model")],
                         [("compress --friction (CC)", "-", "0.3")])
        self.assertEqual(len(pair.remarks), 1)  # neither says of which scan it is
        self.assertEqual(parse_table(pair.table().text(), "table").rows, pair.table().rows)

    def test_runs_of_different_breasts(self):
        def report(side):
            return {"side": side, "breast_ml": 500, "landmarks": {"nipple": {"imaged": [1, 2, 3]}}}
        pair = Pair(self.run_of("a/x", labels=report("left"), mesh=report("left")),
                    self.run_of("b/x", labels=report("right"), mesh=report("right")))
        self.assertEqual({row.topic for row in pair.rows}, {"breast"})
        self.assertEqual(pair.remarks, ["the first run is of the left breast and the second of the right: places and curves are not "
                                        "compared"])
        self.assertEqual(pair.names(), ("a/x", "b/x"))
        self.assertIn("The first run is of the left breast", compare_page(pair))

    def test_what_cannot_be_compared_is_refused(self):
        some = self.run_of("a", labels={"breast_ml": 500})
        with self.assertRaisesRegex(BreastError, "holds no report of a stage"):
            Pair(some, self.run_of("empty"))
        with self.assertRaisesRegex(BreastError, "nothing can be compared"):
            Pair(some, self.run_of("c", cc={"force_N": 80})).rows

    def test_a_view_without_grip_is_said_before_its_numbers(self):
        def view(status):
            return {"view": "CC", "status": status, "accepted": status == "converged", "reason": "slips", "force_N": 20}
        page = compare_page(Pair(self.run_of("a", cc=view("converged")), self.run_of("b", cc=view("not_gripped"))))
        self.assertEqual(page.count("CC: the simulated plates do not hold the breast."), 1)
        self.assertLess(page.index("do not hold the breast"), page.index("force of the paddle"))

    def test_text_of_a_report_is_no_markup(self):
        hostile = {"command": "segment <script>alert(1)</script> l.vtkhdf", "breast_ml": 500, "warnings": ["<script>"]}
        page = compare_page(Pair(self.run_of("<b>", labels=hostile), self.run_of("b", labels={**hostile, "command": "segment"})))
        self.assertIn("&lt;script&gt;alert(1)", page)
        self.assertNotRegex(page, "<script|<b><b>")


class OnRuns(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        """The small run, and the same breast with stiffer fat up to the supine shape."""
        cls.first, cls.second = small_run.folder(), small_run.scratch("stiffer") / "average"
        shutil.copytree(cls.first, cls.second)
        small_run.tool("backward mesh.vtkhdf reference.vtkhdf --materials seed2008 --scale fat=130 --report reference.json", cls.second)
        small_run.tool("forward reference.vtkhdf supine.vtkhdf --materials seed2008 --scale fat=130 --report supine.json", cls.second)
        cls.pair = Pair(cls.first, cls.second)

    def test_places_are_those_of_the_files(self):
        rows = {row.quantity: row for row in self.pair.of_topic("landmarks")}
        runs = Run(self.first), Run(self.second)
        tumour = runs[0].mesh.landmark("tumour").name.replace("_", " ")
        for shape, name in (("reference", "stress-free"), ("supine", "supine"), ("cc", "in CC"), ("mesh", "in the scan")):
            a, b = (run.state(shape).landmark_position("tumour") for run in runs)
            row = rows[f"{tumour} {name}"]
            self.assertAlmostEqual(float(row.difference), float(np.linalg.norm(a - b)), delta=0.006)
            self.assertEqual(row.first, " ".join(f"{x:.1f}" for x in a))
        self.assertGreater(float(rows[f"{tumour} supine"].difference), 0.1)
        self.assertNotEqual(rows[f"{tumour} supine"].first_error, "-")
        self.assertEqual(rows[f"{tumour} on the CC image"].difference, "0.00")
        self.assertEqual(self.pair.remarks, [])

    def test_equal_curves_are_at_no_distance(self):
        self.assertEqual([row.difference for row in self.pair.of_topic("curve")], ["0.0", "0.00", "0.00"])

    def test_only_what_differs_in_the_model(self):
        found = {what: (a, b) for what, a, b in differences(self.first, self.second)}
        # Where a set is named is no difference: the first run's supine shape has it from the stress-free file.
        for option in ("backward --scale (stress-free)", "forward --scale (supine)"):
            self.assertEqual(found.pop(option), ("-", "fat=130"))
        self.assertTrue(found)
        for what, (a, b) in found.items():
            self.assertRegex(what, r"^fat a\w+_Pa \(stress-free, supine\)$")
            self.assertAlmostEqual(float(b) / float(a), 1.3, 4)
        self.assertEqual(differences(self.first, self.first), [])

    def test_the_page_and_the_table(self):
        out = small_run.scratch("compare") / "out"
        code, said, notes = compared(self.first, self.second, "--out", out)
        self.assertEqual((code, notes), (0, ""))
        self.assertIn("What differs in settings and model", said)
        page = (out / "compare.html").read_text()
        self.assertEqual(parse_table((out / "compare.tsv").read_text(), "table").rows, self.pair.table().rows)
        images = re.findall(r"<img[^>]*>", page)
        self.assertEqual(len(images), 4)  # CC and MLO of both
        alts = [re.search('alt="([^"]+)"', image)[1] for image in images]
        self.assertEqual(len(set(alts)), 4)
        self.assertTrue(all('src="data:image/png;base64,' in image for image in images))
        levels = [int(level) for level in re.findall(r"<h([1-6])", page)]
        self.assertTrue(levels[0] == 1 and levels.count(1) == 1 and all(b - a <= 1 for a, b in zip(levels, levels[1:])), levels)
        self.assertEqual(page.count("<th"), page.count("<th scope=col>"))
        self.assertNotIn(str(self.first.parent), page)
        self.assertEqual(compared(self.first, self.second, "--out", out)[0], 0)  # its own files are replaced
        (out / "compare.tsv").write_text("somebody's\tnotes\n")
        self.assertEqual(compared(self.first, self.second, "--out", out)[0], 2)

    @unittest.skipUnless(chromium(), "no Chromium: apt-get install chromium")
    def test_the_page_is_as_wide_as_the_screen(self):
        """Of a monitor and of a phone: wide tables scroll in themselves, and no picture is cut."""
        file = small_run.scratch("width") / "compare.html"
        file.write_text(compare_page(self.pair))
        browser = Browser(chromium(), 240)
        self.addCleanup(browser.close)
        for width in (1400, 390):
            browser.size(width, 900, touch=width < 700)
            browser.open(file.as_uri())
            self.assertEqual(browser.value("[innerWidth, document.documentElement.scrollWidth]"), [width, width])
            self.assertEqual(browser.value("[...document.querySelectorAll('img, table, p, li, h1, h2, h3')].filter(e => { const box = "
                                           f"e.getBoundingClientRect(); return box.left < 0 || box.right > {width}; }}).length"), 0)
            self.assertGreater(browser.value("Math.min(...[...document.images].map(e => e.getBoundingClientRect().width))"), 100)

    def test_refusals_are_one_line(self):
        for words in ((self.first, self.first), (self.first, self.first / "none"), (self.first, small_run.scratch("empty"))):
            code, said, notes = compared(*words)
            self.assertEqual((code, said, len(notes.splitlines())), (2, "", 1), notes)


if __name__ == "__main__":
    unittest.main()
