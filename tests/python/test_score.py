# SPDX-License-Identifier: GPL-3.0-or-later
"""The tool score: errors at points that were seen, by posture, band and case."""
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import breast
import numpy as np
import small_run
from breast.errors import BreastError
from breast.study.score import CURVE, Score, summary_of, table_of
from breast.study.seen import by_case, pairs_in, postures_in, read_seen
from breast.study.table import Table, parse_table
from in_folder import StandingInFolder


def scored(*words):
    """Exit code, tables of stdout and last line of stderr of the tool."""
    ended = subprocess.run([small_run.programs / "score", *map(str, words)], capture_output=True, text=True)
    return ended.returncode, [parse_table(text, "stdout") for text in ended.stdout.split("\n\n") if text], ended.stderr.strip()


class Sums(unittest.TestCase):
    def test_the_narrowest_band_that_holds_the_point(self):
        for deviations, band in ((0.5, "50 %"), (-1.2, "90 %"), (1.9, "95 %"), (-2.5, "outside"), (None, "-")):
            self.assertEqual(Score("a", "l", CURVE, 1, None, deviations).band(), band)

    def test_quantiles_and_shares(self):
        scores = [Score(f"case{n % 2}", str(n), CURVE, float(n), None, n / 4) for n in range(1, 11)]
        row = next(iter(summary_of([*scores, Score("case0", "x", "supine", 3.0, 9.0)])))
        self.assertEqual([row[name] for name in ("points", "cases", "mean_mm", "median_mm", "p90_mm", "largest_mm")],
                         ["10", "2", "5.500", "5.000", "9.000", "10.000"])
        self.assertEqual([row[f"in_{p}_percent"] for p in (50, 90, 95)], ["20.0", "60.0", "70.0"])
        self.assertEqual(table_of(scores[:1]).rows, [["case1", "1", CURVE, "1.000", "-", "0.250", "50 %"]])


class Points(StandingInFolder):
    def test_marks_are_paired_by_their_labels(self):
        Path("m.fcsv").write_text("# CoordinateSystem = LPS\n# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n"
                                  "1,1,2,3,0,0,0,1,1,1,0,prone-3,,\n2,4,5,6,0,0,0,1,1,1,0,supine-3,,\n")
        table = read_seen(Path("m.fcsv"))
        self.assertEqual((table.cell(0, "landmark"), table.point(0, "prone_"), table.point(0, "supine_")), ("3", (1, 2, 3), (4, 5, 6)))
        Path("m.fcsv").write_text(Path("m.fcsv").read_text().replace("supine-3", "supine-4"))
        with self.assertRaisesRegex(BreastError, "no partner"):
            read_seen(Path("m.fcsv"))

    def test_what_is_missing_is_said(self):
        with self.assertRaisesRegex(BreastError, "no prone_x_mm"):
            postures_in(Table(["landmark", "supine_x_mm", "supine_y_mm", "supine_z_mm"]))
        with self.assertRaisesRegex(BreastError, "no mlo_v_mm"):
            pairs_in(Table(["landmark", "cc_u_mm", "cc_v_mm", "mlo_u_mm"]))
        with self.assertRaisesRegex(BreastError, "no cc_image"):
            pairs_in(Table(["landmark", "cc_x_px", "cc_y_px", "mlo_x_px", "mlo_y_px"]))

    def test_points_of_cases(self):
        Path("all.tsv").write_text("case\tcc_u_mm\na\t1\nb\t2\na\t3\n")
        self.assertEqual({case: len(table.rows) for case, table in by_case(Path("all.tsv"), ["a", "b", "c"]).items()}, {"a": 2, "b": 1})
        with self.assertRaisesRegex(BreastError, "'b', which is none of the runs"):
            by_case(Path("all.tsv"), ["a"])
        os.mkdir("points")
        Path("points/a.tsv").write_text("cc_u_mm\n1\n")
        self.assertEqual(list(by_case(Path("points"), ["a", "b"])), ["a"])


class OnRuns(unittest.TestCase):
    def test_of_a_phantom_it_gives_the_figures_of_the_pipeline(self):
        run = small_run.demo()
        truth = run.parent / "phantom" / f"{run.name}-truth" / "landmarks.tsv"
        code, (rows, summary), said = scored(run, truth)
        self.assertEqual(code, 0, said)
        own = parse_table(small_run.tool(f"probe mesh.vtkhdf reference.vtkhdf supine.vtkhdf --truth {truth}", run), "probe")
        for row in summary:
            for name, landmark in (("mean_mm", "mean"), ("largest_mm", "largest")):
                self.assertAlmostEqual(float(row[name]), own.number_at(landmark, f"{row['where']}_error_mm"), 3)
        self.assertEqual([row["where"] for row in summary], ["stress_free", "supine"])
        self.assertEqual(len(rows.rows), 2 * (len(own.rows) - 2))

    def test_the_points_of_a_study_give_the_figures_of_the_validation_pages(self):
        """The same truth as a study would give it, without what libbreast adds to its own tables: the rows of docs/validation are
        those of `tabulate truth-rows`, and of `cc2mlo --truth` for the places in the mammograms."""
        run = small_run.demo()
        shapes = {"prone": "mesh", "supine": "supine", "cc": "cc", "mlo": "mlo"}
        own = parse_table((run.parent / "phantom" / f"{run.name}-truth" / "landmarks.tsv").read_text(), "landmarks")
        left = [row for row in own if row["side"] == "left"]
        loaded = breast.load(run)
        prone = np.array([[float(row[f"prone_{axis}_mm"]) for axis in "xyz"] for row in left])
        places = {"prone": prone, "supine": np.array([[float(row[f"supine_{axis}_mm"]) for axis in "xyz"] for row in left])}
        # Between plates, the model's own places moved by a known vector stand for the truth, which takes an hour to solve.
        for view in ("cc", "mlo"):
            places[view] = loaded.transport(prone, "imaged", view).points + [2.0, -1.0, 2.0]
        inside = np.isfinite(np.hstack(list(places.values()))).all(axis=1)
        self.assertGreater(inside.sum(), 20)
        with tempfile.TemporaryDirectory() as folder:
            points = Path(folder) / "points.tsv"
            lines = ["\t".join(["landmark", "side", *(f"{p}_{axis}_mm" for p in places for axis in "xyz")])]
            for n in np.flatnonzero(inside):
                lines.append("\t".join([left[n]["landmark"], "left", *(f"{x:.6f}" for p in places for x in places[p][n])]))
            points.write_text("\n".join(lines) + "\n")
            sealed = Path(folder) / "sealed.tsv"  # as probe and cc2mlo take it
            sealed.write_bytes(("\n".join(lines) + "\n\r\n").encode())
            code, (_, summary), said = scored(run, points)
            self.assertEqual(code, 0, said)
            found = {row["where"]: row for row in summary}
            self.assertEqual(list(found), ["supine", "cc", "mlo", CURVE])
            seen = Path(folder) / "run"
            seen.mkdir()
            files = " ".join(str(run / f"{shape}.vtkhdf") for shape in shapes.values())
            (seen / "truth.tsv").write_text(small_run.tool(f"probe {files} --truth {sealed}", run))
            rows = parse_table(small_run.tool(f"tabulate truth-rows {seen}", run), "truth-rows")
            self.assertEqual([row["shape"] for row in rows], ["supine", "cc", "mlo"])
            for row in rows:
                for name, page in (("mean_mm", "error_mm"), ("largest_mm", "largest_mm"), ("moved_mm", "moved_mm")):
                    self.assertEqual(f"{float(found[row['shape']][name]):.1f}", row[page], row["shape"])
            for view in ("cc", "mlo"):
                self.assertAlmostEqual(float(found[view]["mean_mm"]), 3.0, 2)
            small_run.tool(f"cc2mlo {run}/cc.vtkhdf {run}/mlo.vtkhdf {folder}/c.vtp --truth {sealed} --table {folder}/c.tsv", run)
            curve = parse_table((Path(folder) / "c-summary.tsv").read_text(), "c-summary")
            self.assertAlmostEqual(float(found[CURVE]["mean_mm"]), curve.number_at("mean", "true_to_curve_mm"), 2)
            self.assertAlmostEqual(float(found[CURVE]["largest_mm"]), curve.number_at("largest", "true_to_curve_mm"), 2)

    def test_a_study_of_lesions(self):
        run = small_run.demo()
        with tempfile.TemporaryDirectory() as folder:
            study = Path(folder)
            (study / "runs").mkdir()
            for case in ("one", "two", "bad"):
                (study / "runs" / case).symlink_to(run.resolve())
            points = study / "lesions.tsv"
            model = parse_table((run / "curve.tsv").read_text(), "curve.tsv")
            at = [model.cell(0, name) for name in ("cc_u_mm", "cc_v_mm", "model_u_mm", "model_v_mm")]
            lines = ["case\tlandmark\tcc_u_mm\tcc_v_mm\tmlo_u_mm\tmlo_v_mm", *("\t".join([case, "lesion", *at]) for case in ("one", "two")),
                     "bad\tlesion\t900\t900\t0\t0"]
            points.write_text("\n".join(lines) + "\n")
            code, (rows, summary), said = scored(study / "runs", points, "--summary", study / "summary.tsv")
            self.assertEqual(code, 0, said)
            self.assertIn("bad is not scored", said)
            self.assertEqual([(row["case"], row["where"]) for row in rows], [("one", CURVE), ("two", CURVE)])
            self.assertTrue(all(float(row["error_mm"]) < 0.01 for row in rows), rows.rows)  # the model's own place is on its curve
            self.assertEqual(summary.cell(0, "cases"), "2")
            self.assertEqual(parse_table((study / "summary.tsv").read_text(), "summary").rows, summary.rows)
            code, _, said = scored(run, study)
            self.assertEqual((code, len(said.splitlines())), (2, 1))


if __name__ == "__main__":
    unittest.main()
