# SPDX-License-Identifier: GPL-3.0-or-later
"""What runs say: reports that need not be there, warnings once with their advice, summaries, pages whose every text is escaped."""
import base64
import io
import json
import re
import unittest

from breast.errors import BreastError
from breast.study.advice import Advice, Warned, gather, read_advice
from breast.study.cohort import cohort_cost, cohort_table, read_cases
from breast.study.sides import side_table
from breast.study.stage_report import StageReport, failure_of, posture_failure_of
from breast.study.summary import _curve_text, aligned, folded
from breast.study.table import Table
from breast_validation.documents import markdown_table, run_line, with_run, with_tables, wrong_numbers
from breast_validation.same_scan import flag_correlations, flag_table, same_scan_table, spearman
from study_files import InFolder, table_of

try:
    import jinja2  # noqa: F401
    from PIL import Image
    from breast.study.cohort_pages import CohortPages, cohort_page, contours_page
    from breast.study.html import page, table_of_text
    from breast.study.report import report_page
    without_jinja = ""
except ImportError:
    without_jinja = "python3-jinja2 is not installed"


class Summaries(InFolder):
    def test_name_the_page_with_and_without_a_tumour_and_say_when_there_is_no_curve(self):
        self.assertEqual(_curve_text(self.folder), "")
        self.write("page.html", "x")
        self.assertIn("The page to read: ", _curve_text(self.folder))
        self.write("curve.tsv", "query\n0\n")
        self.assertIn("CC point to MLO curve: ", _curve_text(self.folder))
        self.write("mlo.json", '{"accepted": false, "status": "not_gripped"}')
        said = _curve_text(self.folder)
        self.assertTrue(said.startswith("No curve: one of the views is no compression.\nThe page to read: "), said)


class StageReports(InFolder):
    def test_answer_nothing_where_nothing_is(self):
        report = StageReport.parse(
            '{"a": 1.50, "none": null, "n": 3, "t": "x", "yes": true, "deep": {"total": 2, "b": {"only": 7}}, '
            '"list": ["p", 1, "q"], "landmarks": {"artificial_tumour": {"imaged": [1, 2, 3]}, "bad": {"imaged": [1, null, 3]}}}', "r")
        self.assertEqual([report.text(key) for key in ("a", "n", "yes", "none", "deep")], ["1.5", "3", "true", "", ""])
        self.assertEqual((report.number("deep/total"), report.first("only"), report.first("absent")), (2, 7, None))
        for path in ("t", "none", "yes", "deep/total/x", "list/0"):
            self.assertIsNone(report.number(path))
        self.assertEqual(report.texts("list"), ["p", "q"])
        self.assertEqual(report.place("tumour", "imaged"), (1, 2, 3))
        for landmark, what in (("bad", "imaged"), ("nipple", "imaged"), ("tumour", "position")):
            self.assertIsNone(report.place(landmark, what))
        self.assertFalse(StageReport.read("/nowhere/at/all.json"))

    def test_refuse_what_is_no_report(self):
        for text in ("[1]", '{"a": ', "[" * 100000, '{"a": NaN}', '{"a": 1e999}', '{"a":' * 80 + "1" + "}" * 80):
            with self.assertRaisesRegex(BreastError, "r: not a JSON report; remove it, or run its stage again"):
                StageReport.parse(text, "r")
        file = self.folder / "latin.json"
        file.write_bytes(b'{"a": "caf\xe9"}')
        self.assertEqual(StageReport.read(file).text("a"), "caf\ufffd", "another program's Latin-1")

    def test_say_why_a_solve_has_no_result(self):
        solve = self.folder / "x"
        self.assertIsNone(failure_of(solve), "never tried")
        report = '{"status": "unstable", "reason": "buckled", "explanation": "It would\\nnot stay."}'
        self.write("x.json", report)
        self.assertEqual(failure_of(solve), "It would not stay.")
        self.write("v/reference.json", report)
        self.assertEqual(posture_failure_of(self.folder / "v"), "It would not stay.")
        self.write("x.vtkhdf")
        self.assertIsNone(failure_of(solve), "a state kept in spite of its status is a result")
        self.write("y/supine.json", '{"status": "not_converged", "reason": "line_search"}')
        self.assertEqual(posture_failure_of(self.folder / "y"), "line_search")


class Warnings(InFolder):
    def test_stand_once_with_their_stages_and_the_advice_in_the_last_of_its_group(self):
        advice = [Advice(re.compile("plates? not"), "Move them."), Advice(re.compile("quality of (contrast|wall)"), "Look.")]
        gathered = gather([("labels", ["quality of wall", "odd"]), ("cc", ["plates not balanced", "quality of contrast"]),
                           ("mlo", ["plates not balanced"])], advice)
        self.assertEqual(gathered, [Warned("labels", "quality of wall"), Warned("cc", "quality of contrast", "Look."),
                                    Warned("labels", "odd"), Warned("cc, mlo", "plates not balanced", "Move them.")])

    def test_a_pattern_that_is_none_is_named_with_its_line(self):
        with self.assertRaisesRegex(BreastError, "line 3"):
            read_advice(self.write("advice.tsv", "# comment\ngood\tx\n(bad\ty\n"))

    def test_columns_and_lines(self):
        self.assertEqual(aligned("# no\na\tbb\nccc\td\n"), "  a    bb\n  ccc  d\n")
        self.assertEqual(folded("one two three", 8), "one two\nthree\n")


class Documents(InFolder):
    def test_tables_are_filled_between_their_marks(self):
        def read(file):
            return "a\tb\n1\t2\n# rows 1\n" if file == "t.tsv" else "# none\n"

        def filled(page_text):
            return with_tables(page_text, "page", read, lambda file: "Run: not recorded.")

        wanted = ("x\n<!-- table t.tsv -->\n\n| a | b |\n|---|---|\n| 1 | 2 |\n\nRun: not recorded.\n\n<!-- end of table -->\ny\n")
        self.assertEqual(filled("x\n<!-- table t.tsv -->\nold\n<!-- end of table -->\ny\n"), wanted)
        self.assertEqual(filled(wanted), wanted, "filling again changes nothing")
        for page_text in ("<!-- table t.tsv -->\nold\n", "<!-- table u.tsv -->\n<!-- end of table -->\n"):
            with self.assertRaises(BreastError):
                filled(page_text)  # without an end; a table without a row
        self.assertEqual(markdown_table("a\tb\n\t1\n", "t"), "| a | b |\n|---|---|\n| - | 1 |\n")

    def test_a_table_says_of_which_run_it_is(self):
        none = Table(["table", "date", "commit", "machine"])
        self.assertEqual(run_line(none, "docs/tables/t.tsv"), "Run: not recorded.")
        one = with_run(none, "docs/tables/t.tsv", "2026-11-23", "abc1234", "2 cores, X")
        self.assertEqual(run_line(one, "docs/tables/t.tsv"), "Run: 2026-11-23, commit abc1234, 2 cores, X.")
        two = with_run(with_run(one, "a.tsv", "none", "-", "-"), "t.tsv", "2026-11-24", "d", "y")
        self.assertEqual(run_line(two, "a.tsv"), "Not from a run.")
        self.assertEqual(len(two.rows), 2, "a table has one run, the last")
        self.assertEqual(run_line(two, "t.tsv"), "Run: 2026-11-24, commit d, y.")

    def test_numbers_of_pages_are_those_of_their_sources(self):
        page_file = self.write("page.md", "about 12 mm, then 7 mm\n")
        self.write("code.cpp", "constexpr int a = 12, b = 8;\n")
        rows = [[str(page_file), said, str(self.folder), f"{source} = ([0-9]+)"] for said, source in
                (("about ([0-9]+)", "a"), ("then ([0-9]+)", "b"), ("never ([0-9]+)", "b"))]
        wrong = wrong_numbers(Table(["page", "page_pattern", "source", "source_pattern"], rows))
        self.assertEqual(len(wrong), 2)
        self.assertIn("says '7'", wrong[0])
        self.assertIn("says 'nothing'", wrong[1])


@unittest.skipIf(without_jinja, without_jinja)
class Pages(InFolder):
    def test_a_report_names_no_folder_and_begins_with_warnings(self):
        run = self.folder / "a<b>"
        self.write("a<b>/cc.json", '{"status": "converged", "thickness_mm": 41.27}')
        self.write("a<b>/displacements.tsv", "file\tnipple_mm\n<i>\t3.5\n")
        self.write("a<b>/verify.tsv", "a_b\tverdict\n1.5\tfails\n")
        self.write("a<b>/population.tsv", "quantity\tmean\twomen_mean\twomen_sd\twithin_one_sd\nnipple_moved_mm\t97.3\t101\t33\tyes\n")
        self.write("a<b>/.labels.settings", "/home/me/bin/segment /secret/scan.nrrd --side left\n")
        made = report_page(run, self.folder, [Warned("cc", "<script>", "'&\"")], ["A limit."], "", "Made today.")
        for text in ("labels: segment scan.nrrd --side left\n", "case a&lt;b&gt;", "<td class=n>41.27</td>", "<li>A limit.",
                     "<td>nipple moved</td><td class=n>97.3</td><td class=n>101</td>", "&#39;&amp;&#34;", "<td>&lt;i&gt;</td>",
                     "<th scope=col>a b</th>", "<td class=n>1.5</td><td class=bad>fails</td>"):
            self.assertIn(text, made)
        for text in ("secret", "<script>", str(self.folder)):
            self.assertNotIn(text, made)
        self.assertLess(made.index("Warnings: 1"), made.index("<h2>Landmarks"))

    def test_a_report_has_the_three_studies_or_the_command_that_makes_them(self):
        self.write("run/leaveout/table.tsv", "variant\tsaved_s\nskin\t4\n")
        made = report_page(self.folder / "run", self.folder, [], [], "", "")
        for title in ("Error against run time", "Stability", "What can be left out, and what that saves"):
            self.assertIn(f"<h2>{title}</h2>", made)
        self.assertIn("with the goal cost makes it", made)
        self.assertIn("with the goal stability makes it", made)
        self.assertNotIn("with the goal leaveout", made)
        self.assertNotIn("Figure 4", made, "a section without a picture is left out")

    def test_bytes_that_are_not_utf_8_do_not_stop_a_page(self):
        block = table_of_text("a\nlatin \udce9\n")
        made = page("report", title="t", style="report.css", name="n", made="", failed=[], warnings=[], artificial=False, first=[block],
                    sections=[])
        self.assertIn("<td>latin \ufffd</td>", made)
        self.assertIsNone(table_of_text("# nothing\n"))


class Cohort(InFolder):
    def cases(self):
        self.write(".cases", "good\tx\tscan\nlost\tx\tscan\nnever\tx\tscan\nbad\tx\tscan\n")
        self.write("good.status", "done\t\n")
        self.write("lost.status", "running\t\n")
        self.write("bad.status", "failed\tno such scan\n")
        self.write("good/labels.json", json.dumps({
            "quality": {"contrast": 0.4, "wall": 1}, "seconds": {"total": 2.4}, "cpu_seconds": 3, "peak_mb": 99.6, "warnings": ["w"]}))
        self.write("good/mesh.json", '{"volume_ml": 512.3, "min_scaled_jacobian": 0.09, "elements": 4000}')
        self.write("good/motion.tsv", "case\tside\tnipple_moved_mm\tother_mm\ngood\tleft\t90\t5\n")
        return read_cases(self.folder), table_of("quantity\tmean\tsd\nnipple_moved_mm\t60\t10\n")

    def test_failures_come_first_and_a_silent_case_is_one(self):
        cases, women = self.cases()
        table = cohort_table(self.folder, cases, [], women)
        self.assertEqual(table.rows[-1][0], "good")
        self.assertEqual((table.at("lost", "status"), table.at("bad", "reason"), table.at("never", "reason")),
                         ("failed", "no such scan", "never started"))
        self.assertEqual(table.at("good", "look"), "1 warnings; quality of contrast 0.40; element shape 0.09; "
                                                   "nipple_moved_mm 90 (women 60, sd 10)")
        self.assertEqual(" ".join(cohort_cost(self.folder, cases).rows[0]), "good 4000 2 3 100")

    @unittest.skipIf(without_jinja, without_jinja)
    def test_pages(self):
        cases, women = self.cases()
        pages = CohortPages(self.folder, cohort_table(self.folder, cases, [], women), cohort_cost(self.folder, cases),
                            table_of("case\tside\tnipple_moved_mm\ngood\tleft\t90\n"), women)
        made, contours = cohort_page(pages), contours_page(pages)
        self.assertLess(made.index("<h2>Failed"), made.index("<h2>Done"))
        self.assertIn("4 cases: 1 done, 3 failed, 1 ask for a look.", made)
        self.assertIn("<td>60 (10)<td><div class=strip><b style=\"left:20.0%;width:40.0%\"></b><i style=\"left:100.0%\">", made)
        self.assertIn("no contours", contours)
        self.assertIn("<tr><td>good<td", made)
        self.write("good/page.html", "x")
        self.assertIn('<tr><td><a href="good/page.html">good</a><td', cohort_page(pages))
        self.assertNotIn(f"{self.folder.parent}/", made, "names no folder")

        def pictured(width, height):
            Image.new("L", (width, height), 90).save(self.folder / "good/contours.png")
            found = re.search(r"data:image/jpeg;base64,([^\"' ]+)", contours_page(pages))
            return Image.open(io.BytesIO(base64.b64decode(found[1]))).size if found else None
        self.assertEqual(pictured(2000, 1474), (5 * 340, 280), "five of the slices of segment")
        self.assertIsNone(pictured(300, 300), "another program's picture")
        self.write("good/contours.png", "no picture")
        self.assertIn("no contours", contours_page(pages))

    def test_sides_say_how_far_they_get_and_what_was_mended(self):
        self.write(".cases", "left\tx\tscan\nright\tx\tscan\n")
        self.write("left.status", "done\t\n")
        self.write("right.status", "failed\tno chest wall\n")
        for stage in ("labels", "geometry", "mesh"):
            self.write(f"left/{stage}.vtkhdf")
        self.write("left/labels.json", '{"chest_wall": {"sigma_mean_mm": 1.52}, "cpu_seconds": 9, "peak_mb": 305}')
        self.write("left/geometry.json", '{"fit": {"mean_mm": 0.1, "p95_mm": 0.51}, "volumes_ml": {"labels": 500}, "mended": ["the rim was moved"]}')
        self.write("left/mesh.json", '{"min_scaled_jacobian": 0.431, "volume_ml": 512.3, "mended": ["layers"], "cpu_seconds": 2}')
        self.write("left/reference.json", '{"closure_mm": 2.345e-10}')
        self.write("left/labels-truth.tsv", "quantity\tvalue\nbody_dice\t0.9921\nfibroglandular_in_breast_dice\t0.95\n"
                   "wall_on_breast_mean_mm\t0.4\nwall_on_breast_p95_mm\t2.3\nwall_mean_mm\t5\n")
        left, right = side_table(self.folder, read_cases(self.folder))
        self.assertEqual(" ".join(left.values()),
                         "left done mesh 0.992 0.950 0.4 2.3 5.0 - 1.5 0.10 0.51 0.43 512 500 2.3e-10 11 305 the rim was moved; layers "
                         "supine, wall_p95_mm, fit_p95_mm -")
        self.assertEqual((right["reached"], right["missed"], right["reason"]), ("-", "supine", "no chest wall"))

    def test_changed_scans_are_compared_with_the_unchanged_one_or_its_mirror_image(self):
        def case(name, side, nipple, volume, moved, wall, dice):
            for stage in ("labels", "geometry", "mesh", "reference", "supine"):
                self.write(f"{name}/{stage}.vtkhdf")
            self.write(f"{name}.status", "done\t\n")
            self.write(f"{name}/labels.json", json.dumps(
                {"side": side, "cut_by_view_cm2": 0, "landmarks": {"nipple": {"imaged": nipple}},
                 "quality": {"wall": dice, "tissue": 1, "extent": dice}}))
            self.write(f"{name}/geometry.json", json.dumps({"volumes_ml": {"labels": volume}}))
            self.write(f"{name}/mesh.json", json.dumps({"volume_ml": volume}))
            self.write(f"{name}/supine.json", json.dumps({"landmarks": {"nipple": {"displacement_from_scan_mm": moved}}}))
            self.write(f"{name}/labels-same.tsv", f"quantity\tvalue\nwall_mean_mm\t{wall}\nbreast_dice\t{dice}\n")
            self.write(f"{name}/labels-truth.tsv", f"quantity\tvalue\nwall_on_breast_mean_mm\t{wall}\n"
                       f"fibroglandular_in_breast_dice\t{dice}\n")

        names = ("a--unchanged", "a--mirrored", "a--30-mm-less-above", "a--noise-of-15-percent")
        self.write(".cases", "".join(f"{name}\tx\tscan\n" for name in names))
        case(names[0], "left", [80, -40, 0], 500, [30, 40, 0], 0, 1)
        case(names[1], "right", [-80, -40, 1], 505, [-30, 40, 0], 0.25, 0.98)
        case(names[2], "left", [80, -44, 0], 480, [30, 45, 0], 1.6, 0.9)
        self.write(f"{names[3]}.status", "failed\tno chest wall\n")
        cases = read_cases(self.folder)
        rows = [" ".join(row.values()) for row in same_scan_table(self.folder, cases)]
        self.assertEqual(rows, [
            "a unchanged supine 0.0 500 0.0 0.0 0.00 50.0 0.0 0.0 0 none -",
            "a mirrored supine 1.0 505 1.0 1.0 0.25 50.0 0.0 0.0 0 none -",
            "a 30 mm less above supine 4.0 480 -4.0 -4.0 1.60 54.1 8.2 5.0 0 nipple_mm, volume_percent, wall_mm, supine_percent -",
            "a noise of 15 % - - - - - - - - - - nipple_mm, volume_percent, wall_mm, supine_percent no chest wall"])
        flags = flag_table(self.folder, cases)
        self.assertEqual([" ".join(row) for row in flag_correlations(flags).rows], ["wall 3 1.00", "gland 3 -", "extent 2 1.00"])

    def test_ranks_that_are_tied_share_their_mean(self):
        self.assertAlmostEqual(spearman([0, 0, 1, 2], [1, 2, 3, 4]), 0.9486833)
        self.assertAlmostEqual(spearman([1, 2, 3], [9, 4, 1]), -1)
        self.assertIsNone(spearman([1, 1], [1, 2]))
        self.assertIsNone(spearman([], []))
