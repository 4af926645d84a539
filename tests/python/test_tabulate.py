# SPDX-License-Identifier: GPL-3.0-or-later
"""tabulate as a program: what it refuses, in one line; that its tables go to stdout alone; all tables of a run in one call."""
import subprocess

import small_run
from breast.study.curve_distance import curve_distance
from breast.study.table import read_table
from study_files import InFolder


class Tabulate(InFolder):
    def run_tool(self, line: str) -> subprocess.CompletedProcess:
        return subprocess.run([small_run.programs / "tabulate", *line.split()], cwd=self.folder, capture_output=True, text=True)

    def test_refuses_what_it_cannot_make(self):
        self.write("damaged.json", '{"status": "conv')
        self.write("ragged.tsv", "a\tb\n1\n")
        for line, says in (
                ("sumary x", "did you mean summary?"), ("cost x", "needs 3"), ("truth a b", "takes 1"),
                ("truth none.tsv", "none.tsv"), ("truth ragged.tsv", "line 2"), ("tables . m.tsv tabel3", "did you mean 'table3'?"),
                ("key damaged.json status", "damaged.json: not a JSON report"),
                ("place absent.json nipple", "has no landmark 'nipple'"), ("least ragged.tsv surgery much a", "'much'"),
                ("report nowhere .", "is not the folder of a run"), ("summary . --pipelines nowhere", "nowhere")):
            done = self.run_tool(line)
            self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1), f"{line}: {done.stderr}")
            self.assertIn(says, done.stderr, line)

    def test_a_verdict_that_differs_fails_and_names_the_value(self):
        self.write("a.json", '{"force_N": 103.25}')
        header = "file\trow\tcolumn\texpected\ttolerance\n"
        self.write("expected.tsv", header + "a.json\t-\tforce_N\t100\t5\n")
        good = self.run_tool("verify expected.tsv . --quiet")
        self.assertEqual((good.returncode, good.stderr), (0, ""))
        self.assertEqual(good.stdout, "file\trow\tcolumn\texpected\tcomputed\ttolerance\tverdict\n"
                                      "a.json\t\tforce_N\t100\t103.25\t5\tok\n")
        self.write("expected.tsv", header + "a.json\t-\tforce_N\t100\t1\n")
        bad = self.run_tool("verify expected.tsv .")
        self.assertEqual((bad.returncode, bad.stdout), (1, ""))
        self.assertIn("a.json - force_N is 103.25, expected 100 within 1", bad.stderr)

    def test_fills_pages_in_place_and_checks_them(self):
        self.write("docs/tables/t.tsv", "a\tb\n1\t2\n")
        self.write("page.md", "x\n<!-- table docs/tables/t.tsv -->\n<!-- end of table -->\n")
        self.assertEqual([self.run_tool(f"pages {how} page.md").returncode for how in ("check", "fill", "check")], [1, 0, 0])
        self.assertIn("| 1 | 2 |", (self.folder / "page.md").read_text())
        self.write("docs/tables/lost.tsv", "a\n1\n")
        lost = self.run_tool("pages check page.md")
        self.assertEqual(lost.returncode, 1)
        self.assertIn("lost.tsv: stands in no page", lost.stderr)

    def test_tables_of_a_run_in_one_call(self):
        pipelines = small_run.source / "pipelines"
        done = self.run_tool(f"tables run {pipelines}/materials/seed2008.tsv table2 --pipelines {pipelines}")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        table = read_table(self.folder / "run/tables/table2.tsv")
        self.assertEqual(table.rows[0], ["fat", "a10_Pa", "310", "310", "0"])

    def test_reads_positions_from_the_files_of_shapes(self):
        chain = small_run.folder()
        table = subprocess.run([small_run.programs / "tabulate", "study", chain.parent, "tumour,nipple", chain.name],
                               capture_output=True, text=True, check=True).stdout
        probed = small_run.tool("probe supine.vtkhdf", chain).splitlines()
        expected = dict(zip(probed[0].split("\t"), probed[1].split("\t")))
        supine = next(line.split("\t") for line in table.splitlines() if "\tsupine\t" in line)
        self.assertEqual(supine[-2:], [expected.get("tumour_mm") or expected["artificial_tumour_mm"], expected["nipple_mm"]])

    def test_distances_of_curves_are_those_of_evaluate(self):
        chain = small_run.folder()
        other = self.folder / "other.vtp"
        small_run.tool(f"cc2mlo cc.vtkhdf mlo.vtkhdf {other} --point 8,28", chain)
        rows = dict(line.split("\t")[:2] for line in small_run.tool(f"evaluate {other} curve.vtp --curves", chain).splitlines())
        mean, most = curve_distance(other, chain / "curve.vtp")
        self.assertAlmostEqual(mean, float(rows["curve_mean_mm"]), delta=1e-3)
        self.assertAlmostEqual(most, float(rows["curve_max_mm"]), delta=1e-3)
