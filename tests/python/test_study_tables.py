# SPDX-License-Identifier: GPL-3.0-or-later
"""Slopes, shares, quantiles and verdicts of the tables of studies, against closed forms and numbers worked by hand."""
import math
from pathlib import Path

import study_files
from breast.errors import BreastError, Failed
from breast.study.cohort_pages import distribution
from breast.study.cost import Point, accuracy_row, cost_table
from breast_validation.draws import coverage, coverage_table, identification_table, quantile, read_band_rows, stability_table
from breast.study.outcomes import outcomes_table
from breast.study.leaveout import changes, least_model
from breast.study.paper_tables import changed_set, scaled_table
from breast.study.slopes import compare_slopes, parabola_slope, slope_between
from breast.study.table import Table, general, read_table, shortest
from breast.study.verdicts import MEASURES, judge, measured, model_of_rows, model_of_slopes
from breast.study.verify import verdict_of, verify
from breast.study.views import views_table
from breast_validation.expected import expected_anew
from breast_validation.plates import compressions_table, plates_table
from breast_validation.solves import pressed_table
from breast_validation.truth import budget_table
from study_files import InFolder, table_of

CONCLUSIONS = Path(study_files.__file__).parent.parent.parent / "pipelines/paper/conclusions.tsv"


class Numbers(InFolder):
    def test_shortest_text(self):
        self.assertEqual([shortest(x) for x in (0, 1, 100000, 10000, 0.001, 0.0001, 1e22, -2.25e-9, 123456.7, 1024)],
                         ["0", "1", "1e+05", "10000", "0.001", "1e-04", "1e+22", "-2.25e-09", "123456.7", "1024"])

    def test_a_table_reads_back_or_is_not_written(self):
        self.assertEqual(Table(["a", "b"], [["", "nan"], ["-", "1"]]).text(), "a\tb\n\t\n\t1\n")
        for cell in ("x\ty", "x\ny", "#x"):
            with self.assertRaisesRegex(Failed, "cannot be written as tab-separated text"):
                Table(["a", "b"], [[cell, "1"]]).text()
        with self.assertRaisesRegex(BreastError, "line 2, a: 'inf' is not finite"):
            table_of("a\nInf\n".replace("Inf", "inf"))


class Slopes(InFolder):
    def test_a_parabola_is_differentiated_exactly(self):
        def f(s):
            return 3 - 2 * s + 5 * s * s

        self.assertAlmostEqual(parabola_slope(-0.1, 0.2, f(0), f(-0.1), f(0.2)), -2, delta=1e-12)
        self.assertAlmostEqual(parabola_slope(0.4, 0.7, f(0), f(0.4), f(0.7)), -2, delta=1e-12)

    def test_agree_within_the_error_of_their_steps(self):
        """A landmark whose displacement is exp(slope x + curve x^3), x = ln s, along a fixed direction."""
        slope, curve, stiffness = -0.6, 0.05, (0.9, 1.1, 0.5, 2)

        def place(s):
            length = math.exp(slope * math.log(s) + curve * math.log(s) ** 3)
            return 10 + length / 3, 2 * length / 3, 2 * length / 3

        def compared(tangent, derivative):
            return compare_slopes(tangent, derivative, (10, 0, 0), place(1), stiffness, [place(s) for s in stiffness])

        derivative = (-0.2, -0.4, -0.4)
        c = compared(-0.6, derivative)
        # Of a cubic the three-point formula gives slope - curve * a * b.
        self.assertAlmostEqual(c.difference, 0.05 * math.log(0.9) * math.log(1.1), delta=1e-9)
        self.assertAlmostEqual(c.step_error, abs(c.difference), delta=1e-9)
        self.assertTrue(c.agrees)
        self.assertFalse(compared(-0.61, derivative).agrees, "a slope a per cent off is no step error")
        self.assertLess(c.vector_percent, 1)
        self.assertGreater(compared(-0.6, (0.2, 0.4, 0.4)).vector_percent, 190)

    def test_between_two_rows(self):
        self.assertAlmostEqual(slope_between(90, 90**-0.61, 110, 110**-0.61), -0.61, delta=1e-12)


class Verdicts(InFolder):
    def test_hold_only_within_their_bounds_and_with_a_value(self):
        bounds = table_of("conclusion\ttext\tlowest\thighest\tsource\na\tA\t-0.5\t0\tp\nb\tB\t1\t1\tp\nc\tC\t0\t1\tp\n")
        judged = judge(bounds, {"ours": table_of("conclusion\tvalue\na\t0.1\nb\t1\nc\t-\n")})
        self.assertEqual([row["ours_verdict"] for row in judged], ["fails", "holds", "not evaluated"])
        with self.assertRaises(BreastError):
            judge(bounds, {"ours": table_of("a\t0.1\nb\t1\n")})  # values without a header

    def test_every_conclusion_has_a_measure_and_two_bounds_around_the_papers_value(self):
        conclusions = read_table(CONCLUSIONS)
        self.assertEqual({row["conclusion"] for row in conclusions}, set(MEASURES))
        paper = CONCLUSIONS.parent
        tables = [read_table(paper / f"table{n}.tsv") for n in (3, 4, 5, 6)]
        judged = judge(conclusions, {"paper": measured(model_of_rows(tables))})
        self.assertEqual([row["paper_verdict"] for row in judged], ["holds"] * 10 + ["not evaluated"] * 4)

    def test_a_slope_that_is_fifty_times_too_small_fails(self):
        values = table_of("conclusion\tvalue\nskin_tumour\t-0.0003\nskin_nipple\t-0.0006\nfibroglandular_nipple\t0.09\n")
        judged = {row["conclusion"]: row["ours_verdict"] for row in judge(read_table(CONCLUSIONS), {"ours": values})}
        for name in ("tumour displacement, skin", "nipple displacement, skin", "nipple displacement, fibroglandular"):
            self.assertEqual(judged[f"slope of {name}"], "fails")

    def test_of_figure_6(self):
        """The tumour is 2.1 mm behind the edge of the CC image, and most of its curve outside the MLO image."""
        image = '{"pixel_mm": 0.25, "width_pixels": 100, "height_pixels": 80, "landmarks": {"artificial_tumour": {"uv_mm": [%s]}}}'
        self.write("cc-mammogram.json", image % "-2.1, 9")
        self.write("mlo-mammogram.json", image % "20, 16.5")
        self.write("curve.json", '{"inside_image_percent": 36.7, "max_bend_mm": 1.6, "curve_mm": 51.5}')
        empty = Table(["stiffness_percent"])
        values = measured(model_of_rows([empty] * 4, run=self.folder))
        self.assertEqual([values.at(f"fig6_{what}", "value") for what in ("cc", "mlo", "curve")], ["-2.1", "3.5", "36.7"])
        self.assertEqual(values.at("fig7_bend", "value"), "3.1")
        judged = judge(read_table(CONCLUSIONS), {"ours": values})
        self.assertEqual([row["ours_verdict"] for row in judged][-4:], ["fails", "holds", "fails", "holds"])

    def test_of_rows_and_of_slopes_are_the_same_numbers(self):
        def rows(slope):
            cells = [(general(s), shortest(8 * (s / 100) ** slope)) for s in (90.0, 110.0)]
            return Table(["stiffness_percent", "nipple_mm", "tumour_mm"], [[s, u, u] for s, u in cells])

        stiff = table_of("stiffness_percent\tnipple_mm\ttumour_mm\n100\t8\t4\n1000\t8\t3\n2000\t8.4\t-\n")
        values = measured(model_of_rows([rows(-0.7), rows(-0.1), rows(-0.02), stiff]))
        for name, value in (("fat_nipple", "-0.7000"), ("order_tumour", "1"), ("tumour_1000", "-25.000"), ("tumour_2000", "5.000")):
            self.assertEqual(values.at(name, "value"), value)
        slopes = table_of("landmark\tparameter\tdlnu\nnipple\tfat\t-0.7\nartificial_tumour\tfat\t-0.7\n"
                          "nipple\tfibroglandular\t-0.1\nnipple\tskin\t-0.2\n")
        values = measured(model_of_slopes(slopes, stiff))
        self.assertEqual(values.at("fat_tumour", "value"), "-0.7000", "an artificial tumour is found")
        self.assertEqual([values.at(f"order_{landmark}", "value") for landmark in ("nipple", "tumour")], ["0", "-"])
        self.assertEqual(measured(model_of_slopes(None, stiff)).at("fat_nipple", "value"), "-", "no solution")


class Scaled(InFolder):
    PAPER = ("stiffness_percent\ttumour_mm\ttumour_rel_mm\tnipple_mm\tnipple_rel_mm\n"
             "10\t9\t6\t21\t12\n50\t4\t1\t12\t4\n100\t3\t0\t8\t0\n")

    def scaled(self, prefix="fat", base="base.vtkhdf", remark=""):
        return scaled_table(table_of(self.PAPER), self.folder / prefix, self.folder / base, remark)

    def test_the_papers_row_stands_beside_ours_and_dashes_where_there_is_no_solution(self):
        for file in ("fat-50/supine.vtkhdf", "base.vtkhdf"):
            self.write(file)
        self.write("base.json", '{"error_estimate_mm": 0.1234}')
        self.write("fat-10/reference.json", '{"status": "not_converged", "reason": "line_search"}')
        self.shapes(supine=12.34, base=8.5)
        first, second, third = self.scaled(remark="fitted")
        self.assertEqual((first["nipple_mm"], first["paper_nipple_mm"]), ("-", "21"))
        self.assertEqual([second[c] for c in ("nipple_mm", "difference_nipple_mm", "nipple_rel_mm", "tumour_mm", "remark")],
                         ["12.340", "0.340", "3.840", "6.170", "-"])
        self.assertEqual((third["estimate_mm"], third["remark"]), ("0.123", "fitted"))

    def test_a_missing_solve_needs_a_reason(self):
        self.write("base.vtkhdf")
        self.write("fat-10/supine.json", '{"status": "unstable"}')
        self.shapes(base=8.5)
        with self.assertRaisesRegex(Failed, "fat-50/supine.vtkhdf: is missing"):
            self.scaled()
        self.write("fat-50/supine.json", '{"status": "unstable", "explanation": "It buckles."}')
        self.assertEqual(self.scaled().cell(1, "nipple_mm"), "-")
        for percent in ("10", "50", "100"):
            self.write(f"soft-{percent}/reference.json", '{"status": "not_converged", "reason": "none"}')
        none = self.scaled("soft", "soft-100/supine.vtkhdf")
        self.assertEqual(none.cell(2, "tumour_mm"), "-", "not even the base has a solution")


class ChangedSets(InFolder):
    def test_exchange_what_their_names_say(self):
        header = "tissue\tlaw\ta20_Pa\ta02_Pa\ta11_Pa\n"
        materials = table_of(header + "fat\tp\t1\t2\t3\nfibroglandular\tp\t4\t5\t6\n")
        self.assertEqual(changed_set(materials, "columns").text(), header + "fat\tp\t2\t3\t1\nfibroglandular\tp\t5\t6\t4\n")
        self.assertEqual(changed_set(materials, "fat-only").text(), header + "fat\tp\t1\t2\t3\nfibroglandular\tp\t1\t2\t3\n")
        with self.assertRaises(BreastError):
            changed_set(materials, "fat")
        with self.assertRaisesRegex(BreastError, "no row for the tissue fibroglandular"):
            changed_set(table_of("tissue\ta20_Pa\nfat\t1\n"), "fat-only")


class Coverage(InFolder):
    def test_of_one_sample_is_wilsons_and_of_many_the_scatter_of_their_own(self):
        percent, low, high = coverage([45], [50])
        self.assertAlmostEqual(percent, 90)
        self.assertAlmostEqual(low, 78.64, delta=0.01)  # Wilson 1927, 45 of 50
        self.assertAlmostEqual(high, 95.65, delta=0.01)
        _, low, high = coverage([9, 9, 9], [10, 10, 10])
        self.assertEqual(low, high, "samples that agree leave no scatter")
        self.assertEqual(coverage([10, 0], [10, 10])[1:], (0, 100))

    def test_rows_of_a_band(self):
        rows = read_band_rows("# sample 3 failed\n1\ta\t0.5\t1\n1\tb\t-1\t1\n2\ta\t3\t1\n2\tb\t0\t1\n", "rows")
        row = next(iter(coverage_table([rows])))
        self.assertEqual([row[c] for c in ("samples", "failed", "in_50_percent", "in_95_percent", "rms_mm")],
                         ["2", "1", "50.0", "75.0", "1.60"])
        for text in ("1\ta\t0.5\n", "# nothing\n"):
            with self.assertRaises(BreastError):
                read_band_rows(text, "rows")
        self.assertEqual((quantile([3, 1, 2], 0.5), quantile([5], 0.01), quantile([], 0.5)), (2, 5, 0))


class Leaveout(InFolder):
    def test_takes_smallest_changes_first_and_nothing_beyond_the_bound(self):
        table = table_of("variant\tsupine_tumour_mm\tsupine_nipple_mm\tcurve_max_mm\n"
                         "skin\t0.2\t0.5\t3\ngland\t0.1\t0.3\t0.1\nno-gravity-in-compression\t0\t0\t0.2\n")
        parts = ["skin", "gland", "no-gravity-in-compression"]
        surgery = changes(table, "surgery", parts)
        self.assertEqual(surgery, [("gland", 0.3), ("skin", 0.5)], "no compression in surgery")
        self.assertEqual([len(least_model(surgery, mm)) for mm in (0.8, 0.79, 0.1)], [2, 1, 0])
        self.assertEqual(len(least_model(changes(table, "matching", parts), 1)), 2)
        with self.assertRaises(BreastError):
            changes(table, "cost", parts)


class Cost(InFolder):
    REPORT = ('{"elements": 68, "unknowns": 300, "newton_iterations": 5, "error_estimate_mm": 0.1, "seconds": {"total": 1.5}, '
              '"cpu_seconds": 1.25, "peak_mb": 20.4}')

    def test_a_solve_carries_the_error_of_its_start(self):
        self.write("reference.json", '{"error_estimate_mm": 0.2}')
        self.assertEqual(Point(self.folder).estimates(), (0.2, None))
        self.write("supine.json", '{"error_estimate_mm": 0.3}')
        self.assertEqual(Point(self.folder).estimates(), (0.2, 0.5))

    def test_rows_of_points_and_the_ladder(self):
        for point in ("q1p0-dome-4", "q2p1-dome-6-direct"):
            for shape in ("reference", "supine"):
                self.write(f"{point}/{shape}.vtkhdf")
                self.write(f"{point}/{shape}.json", self.REPORT)
        self.write("q1p0-dome-8/reference.json", '{"status": "not_converged", "reason": "no body"}')
        self.shapes(q1p0_dome_4__reference=4, q1p0_dome_4__supine=8, q2p1_dome_6_direct__reference=4.5,
                    q2p1_dome_6_direct__supine=8.25)
        table = cost_table(self.folder, "q2p1-dome-6-direct", ["q1p0-dome-4", "q2p1-dome-6-direct", "q1p0-dome-8"])
        self.assertEqual(" ".join(table.rows[0]),
                         "q1p0-dome-4 q1p0 dome auto 68 300 5+5 2.50 3.00 20 0.5000 0.2500 0.1000 0.2000")
        self.assertEqual((table.cell(1, "solver"), table.cell(2, "cpu_s")), ("direct", "-"))
        for point, coarser, wanted, verdict in (
                ("q1p0-dome-4", "", 0.2, "yes"), ("q1p0-dome-4", "", 0.19, "no"),
                ("q2p1-dome-6-direct", "", 9, "no"),  # the first rung of 27-node elements only starts
                ("q2p1-dome-6-direct", "q1p0-dome-4", 0.5, "yes")):
            self.assertEqual(accuracy_row(self.folder, point, coarser, wanted)[-1], verdict)
        self.assertIsNone(accuracy_row(self.folder, "q1p0-dome-8", "", 1))


class Experiments(InFolder):
    def test_the_budget_says_why_a_cell_is_missing(self):
        self.write("labels.json", '{"cpu_seconds": 2.5}')
        self.write("mesh.json", '{"cpu_seconds": 1}')
        self.write("budget/chain/landmarks.tsv",
                   "landmark\tstress_free_error_mm\tsupine_error_mm\nmean\t0.5\t1.2345\nlargest\t1\t2\n")
        self.write("budget/chain/curves-summary.tsv", "statistic\ttrue_to_curve_mm\nmean\t3\np95\t4\n")
        self.write("studies/budget/tissue/cc.json",
                   '{"status": "not_converged", "reason": "folded", "explanation": "An element folds."}')
        chain, tissue = budget_table(self.folder, ["tissue"])
        self.assertEqual(" ".join(chain.values()), "chain 0.500 1.000 1.234 2.000 3.000 4.000 - 3.50 -")
        self.assertEqual((tissue["missing"], tissue["cpu_s"]), ("cc: folded", "2.50"))

    def test_outcomes_say_what_became_of_every_stage_of_a_variant(self):
        self.write("soft/reference.json", '{"status": "converged", "reason": "", "elements": 68, "cpu_seconds": 1.5}')
        self.write("soft/reference.vtkhdf")
        self.write("soft/supine.json", '{"status": "not_converged", "reason": "line_search"}')
        self.shapes(reference=4)
        rows = [" ".join(row) for row in outcomes_table(self.folder, ["nipple", "tumour"], ["soft", "absent"]).rows]
        self.assertEqual(rows, ["soft reference converged - 68 1.50 4.0000 2.0000", "soft supine not_converged line_search - - - -"])

    def test_plates_say_what_the_reports_do_and_dashes_where_they_say_nothing(self):
        for variant in ("coarse", "fine"):
            self.write(f"{variant}/cc.vtkhdf")
            self.write(f"{variant}/cc.json",
                       '{"view": "CC", "status": "converged", "elements": 68, "force_N": 80, "pressure_kPa": 9.96, '
                       '"newton_iterations": 150, "plates": {"paddle": {"force_N": 80, "force_behind_edge_N": 10}, '
                       '"detector": {"force_N": 0, "force_behind_edge_N": 0}}}')
        self.shapes(coarse__cc=4, fine__cc=3)
        coarse, fine = plates_table(self.folder, "next", ["coarse", "fine", "absent"])
        self.assertEqual([coarse[c] for c in ("view", "paddle_behind_edge_percent", "detector_behind_edge_percent",
                                              "mean_pressure_kPa", "tumour_mm", "nipple_mm")],
                         ["CC", "12.5", "-", "10.0", "0.50", "1.00"])
        self.assertEqual(fine["nipple_mm"], "-", "the next variant has no shape")
        first, second = compressions_table([self.folder / "fine/cc.json", self.folder / "absent/mlo.json"])
        self.assertEqual((first["breast"], first["paddle_N"]), ("fine", "80.0"))
        self.assertEqual((second["view"], second["status"]), ("mlo", "-"))

    def test_views_are_judged_anew_by_their_numbers(self):
        plates = '"plates": {"paddle": {"edge_force_percent": 10}, "detector": {"edge_force_percent": %d}}'
        view = ('{"status": "converged", "thickness_mm": 60, "force_N": 110, "pressure_kPa": 10, "min_scaled_jacobian": 0.2, '
                '"turn_deg": 20, "coverage": {"contact_percent_of_projected": %d, "volume_percent": 60, "nipple_in_front_mm": %d%s}, ')
        self.write("a/cc.json", view % (39, 70, ', "nipple_to_muscle_mm": 74') + plates % 45 + "}")
        self.write("a/mlo.json", view % (50, 96, ', "nipple_to_muscle_mm": 76') + plates % 5 + "}")
        self.write("b/cc.json", view % (50, 80, "") + plates % 5 + "}")
        cc, mlo, other, mean_cc, mean_mlo = views_table([self.folder / "a", self.folder / "b", self.folder / "absent"])
        self.assertEqual(cc["missed"], "contact_percent, detector_edge_percent, turn_deg")
        self.assertEqual((mlo["missed"], mlo["cc_minus_mlo_mm"]), ("volume_percent", "-6.0"))
        self.assertEqual((other["missed"], other["cc_minus_mlo_mm"]), ("turn_deg", "-"))
        self.assertEqual((mean_cc["missed"], mean_cc["nipple_line_mm"]), ("1 of 2 miss none", "75.0"))
        self.assertEqual(mean_mlo["missed"], "0 of 1 miss none")

    def test_pressed_puts_calculix_beside_the_sum_of_our_steps(self):
        ours = table_of("force_N\tnewton\tcpu_seconds\tstatus\n10\t4\t0.5\tconverged\n25.5\t6\t0.75\tstopped_early\n")
        self.assertEqual(" ".join(pressed_table(ours, "block", 60, 0.9, "26.1", 120, 12.5).rows[0]),
                         "block 60 64.0 26.1 25.5 120 10 12.50 1.25 10.0 stopped_early")


class ManySolves(InFolder):
    HEADER = ("study\ttruth\telements\tpairs\tcpu_s\tconverged\tidentifiable\twithin_10_percent\twithin_2_sd\tdirections\t"
              "all_within_2_sd\tmotion_mm\tleft_out_mm\ttrue_mm\tprobability\n")

    def test_identification_is_counted_by_kind(self):
        one = table_of(self.HEADER + "same\ta\t500\t6\t1\t1\t2\t1\t2\t4\t3\t40\t1\t2\t0.5\n"
                                     "same\ta\t500\t8\t3\t1\t2\t2\t2\t4\t4\t44\t2\t4\t0.01\n")
        two = table_of(self.HEADER + "surface\ta\t500\t100\t9\t0\t0\t0\t0\t0\t0\t40\t-\t3\t-\n"
                                     "same\ta\t900\t5\t2\t1\t0\t0\t0\t4\t4\t41\t1\t2\t0.5\n")
        first, second, third = identification_table([one, two])
        self.assertEqual(" ".join(first.values()), "same a 2 500 2 7.0 8 2.0 4 75 100 88 42 1.50 3.00 4.00 50")
        self.assertEqual((second["alarms_%"], second["known_5_percent"]), ("-", "-"))
        self.assertEqual((third["elements"], third["draws"]), ("900", "1"), "another mesh, another row")

    def test_extreme_cases_are_counted_by_outcome(self):
        mechanics = table_of(
            "case\tdirection\toutcome\tresidual\tmin_det_F\tnewton\tseconds\nx\tforward\tconverged\t1e-9\t0.5\t7\t1\n"
            "y\tforward\tconverged\t2e-9\t0.25\t5\t2\nz\tbackward\trefused\t-\t-\t0\t0\n")
        contact = table_of("case\toutcome\tresidual\tmin_det_F\tnewton\tseconds\tverdict\np\tconverged\t1e-8\t0.5\t9\t3\tfailure\n")
        self.assertEqual([" ".join(row) for row in stability_table(mechanics, contact).rows],
                         ["forward converged 2 2.0e-09 0.250 7 3.0 -", "backward refused 1 - - 0 0.0 z",
                          "compression converged, not as stated 1 1.0e-08 0.500 9 3.0 p"])


class Verify(InFolder):
    def test_tolerates_and_names_what_differs(self):
        for arguments, verdict in ((("1.0", "1.04", "0.05"), "ok"), (("1.0", "1.051", "0.05"), "differs"),
                                   (("converged", "stopped_early", "0"), "differs"), (("0", "", "1"), "missing")):
            self.assertEqual(verdict_of(*arguments), verdict)
        self.write("a.json", '{"status": "converged", "force_N": 103.25}')
        self.write("t.tsv", "file\tartificial_tumour_mm\nsupine.vtkhdf\t3.5\n")
        expected = ("# why\nfile\trow\tcolumn\texpected\ttolerance\na.json\t-\tstatus\tconverged\t0\na.json\t-\tforce_N\t100\t1\n"
                    "t.tsv\tsupine.vtkhdf\ttumour_mm\t3.4\t0.2\nnone.tsv\tx\ty\t1\t1\n")
        result = verify(table_of(expected), self.folder)
        self.assertEqual([row["verdict"] for row in result], ["ok", "differs", "ok", "missing"])
        self.assertEqual(result.cell(1, "computed"), "103.25")
        anew = expected_anew(expected, self.folder)
        self.assertTrue(anew.startswith("# why\n"))
        self.assertIn("force_N\t103.25\t1\n", anew)
        self.assertIn("tumour_mm\t3.4\t0.2\n", anew, "what agrees keeps its value")


class Distributions(InFolder):
    def test_mean_and_deviation(self):
        women = table_of("quantity\tmean\tsd\n")
        for cells, expected in (("3 1 2", ["3", "2", "1", "1", "3"]), ("0.1 0.1 0.1", ["3", "0.1", "0", "0.1", "0.1"]),
                                ("7", ["1", "7", "0", "7", "7"])):
            values = table_of("x\ty\n" + "".join(f"{cell}\t0\n" for cell in cells.split()))
            self.assertEqual(distribution(values, "x", women)["cells"], expected)
