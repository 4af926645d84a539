// SPDX-License-Identifier: GPL-3.0-or-later
// Slopes, shares, quantiles and verdicts of the tables of studies, against closed forms and numbers worked by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/text/lists.hpp"
#include "fixtures/scratch_folder.hpp"
#include "study/cells.hpp"
#include "study/cohort/cohort_page.hpp"
#include "study/cohort/cohort_table.hpp"
#include "study/experiments/budget.hpp"
#include "study/experiments/compressions.hpp"
#include "study/experiments/cost.hpp"
#include "study/experiments/coverage.hpp"
#include "study/experiments/draws.hpp"
#include "study/experiments/leaveout.hpp"
#include "study/experiments/outcomes.hpp"
#include "study/experiments/pressed.hpp"
#include "study/paper/changed_set.hpp"
#include "study/paper/conclusions.hpp"
#include "study/paper/findings.hpp"
#include "study/paper/scaled_table.hpp"
#include "study/paper/slopes.hpp"
#include "study/verify.hpp"

namespace breast {
namespace {

TEST(Slopes, ParabolaIsDifferentiatedExactly) {
  const auto f = [](double s) { return 3 - 2 * s + 5 * s * s; };
  EXPECT_NEAR(parabola_slope(-0.1, 0.2, f(0), f(-0.1), f(0.2)), -2, 1e-12);
  EXPECT_NEAR(parabola_slope(0.4, 0.7, f(0), f(0.4), f(0.7)), -2, 1e-12);
}

// A landmark whose displacement is exp(slope x + curve x^3), x = ln s, along a fixed direction.
ResolvedPlaces places(double slope, double curve, const std::array<double, 4>& stiffness) {
  const Vec3 along = Vec3(1, 2, 2) / 3;
  const auto place = [&](double s) -> Vec3 {
    const double x = std::log(s);
    return Vec3(10, 0, 0) + along * std::exp(slope * x + curve * x * x * x);
  };
  ResolvedPlaces r{Vec3(10, 0, 0), place(1), stiffness, {}};
  for (std::size_t i = 0; i < 4; ++i) r.places[i] = place(stiffness[i]);
  return r;
}

TEST(Slopes, AgreeWithinTheErrorOfTheirSteps) {
  const Vec3 derivative = Vec3(1, 2, 2) / 3 * -0.6;
  const ResolvedPlaces r = places(-0.6, 0.05, {0.9, 1.1, 0.5, 2});
  const SlopeComparison c = compare_slopes({-0.6, derivative}, r);
  // Of a cubic the three-point formula gives slope - curve * a * b.
  EXPECT_NEAR(c.difference, 0.05 * std::log(0.9) * std::log(1.1), 1e-9);
  EXPECT_NEAR(c.step_error, std::abs(c.difference), 1e-9);
  EXPECT_TRUE(c.agrees);
  EXPECT_FALSE(compare_slopes({-0.61, derivative}, r).agrees)
      << "a slope a per cent off is no step error";
  EXPECT_LT(c.vector_percent, 1);
  EXPECT_GT(compare_slopes({-0.6, -derivative}, r).vector_percent, 190);
}

TEST(Slopes, BetweenTwoRows) {
  EXPECT_NEAR(slope_between(90, std::pow(90, -0.61), 110, std::pow(110, -0.61)), -0.61, 1e-12);
}

Table table_of(const std::string& text) {
  return parse_table(text, "table");
}

TEST(Conclusions, HoldOnlyWithinTheirBoundsAndWithAValue) {
  const Table bounds =
      table_of("conclusion\ttext\tlowest\thighest\na\tA\t-0.5\t0\nb\tB\t1\t1\nc\tC\t0\t1\n");
  const Table values = table_of("conclusion\tvalue\na\t0.1\nb\t1\nc\t-\n");
  const Table judged = judge(bounds, {{"ours", values}});
  EXPECT_EQ(judged.columns.back(), "ours_verdict");
  EXPECT_EQ(judged.cell(0, "ours_verdict"), "fails");
  EXPECT_EQ(judged.cell(1, "ours_verdict"), "holds");
  EXPECT_EQ(judged.cell(2, "ours_verdict"), "not evaluated");
  EXPECT_THROW(judge(bounds, {{"ours", table_of("a\t0.1\nb\t1\n")}}), Error)
      << "values without a header";
}

TEST(Conclusions, OfRowsAndOfSlopesAreTheSameNumbers) {
  const auto rows = [](double slope) {
    Table table{{"stiffness_percent", "nipple_mm", "tumour_mm"}, {}};
    for (const double s : {90.0, 110.0}) {
      const std::string u = format_number(8 * std::pow(s / 100, slope));
      table.rows.push_back({general(s), u, u});
    }
    return table;
  };
  const Table stiff =
      table_of("stiffness_percent\tnipple_mm\ttumour_mm\n100\t8\t4\n1000\t8\t3\n2000\t8.4\t-\n");
  const Table values = conclusions_from_rows({rows(-0.7), rows(-0.1), rows(-0.02), stiff}, "");
  EXPECT_EQ(cell_at(values, "fat_nipple", "value"), "-0.7000");
  EXPECT_EQ(cell_at(values, "order_tumour", "value"), "1");
  EXPECT_EQ(cell_at(values, "tumour_1000", "value"), "-25.000");
  EXPECT_EQ(cell_at(values, "tumour_2000", "value"), "5.000");
  const Table slopes = table_of(
      "landmark\tparameter\tdlnu\nnipple\tfat\t-0.7\nartificial_tumour\tfat\t-0.7\n"
      "nipple\tfibroglandular\t-0.1\nnipple\tskin\t-0.2\n");
  const Table of_slopes = conclusions_from_slopes(slopes, stiff);
  EXPECT_EQ(cell_at(of_slopes, "fat_tumour", "value"), "-0.7000")
      << "an artificial tumour is found";
  EXPECT_EQ(cell_at(of_slopes, "order_nipple", "value"), "0");
  EXPECT_EQ(cell_at(of_slopes, "order_tumour", "value"), "-");
  EXPECT_EQ(cell_at(conclusions_from_slopes({}, stiff), "fat_nipple", "value"), "-")
      << "no solution";
}

// Shapes without files, named by file or by folder and file: the nipple is `shift` mm beyond its
// imaged position.
ShapeReader shapes(const std::map<std::string, double>& shifts) {
  return [shifts](const std::filesystem::path& file) -> Shape {
    const std::string place = file.parent_path().filename() / file.filename();
    const auto own = shifts.find(place);
    const double shift = own == shifts.end() ? shifts.at(file.filename()) : own->second;
    return {{"nipple", Vec3(1, 0, 0), Vec3(1 + shift, 0, 0)},
            {"artificial_tumour", Vec3(0, 0, 0), Vec3(0, shift / 2, 0)}};
  };
}

TEST(ScaledTable, PutsThePapersRowBesideOursAndDashesWhereThereIsNoSolution) {
  const ScratchFolder folder;
  for (const char* variant : {"fat-10", "fat-50", "soft-10", "soft-50", "soft-100"})
    std::filesystem::create_directories(folder / variant);
  for (const char* file : {"fat-50/supine.vtkhdf", "base.vtkhdf"}) write_text(folder / file, "x");
  write_text(folder / "base.json", R"({"error_estimate_mm": 0.1234})");
  write_text(folder / "fat-10/reference.json",
             R"({"status": "not_converged", "reason": "line_search"})");
  const Table paper = table_of(
      "stiffness_percent\ttumour_mm\ttumour_rel_mm\tnipple_mm\tnipple_rel_mm\n10\t9\t6\t21\t12\n50\t4\t1\t12\t4\n100\t3\t0\t8\t0\n");
  const auto read = shapes({{"supine.vtkhdf", 12.34}, {"base.vtkhdf", 8.5}});
  const Table table = scaled_table(paper, folder / "fat", folder / "base.vtkhdf", read, "fitted");
  EXPECT_EQ(table.cell(0, "nipple_mm"), "-");
  EXPECT_EQ(table.cell(0, "paper_nipple_mm"), "21");
  EXPECT_EQ(table.cell(1, "nipple_mm"), "12.340");
  EXPECT_EQ(table.cell(1, "difference_nipple_mm"), "0.340");
  EXPECT_EQ(table.cell(1, "nipple_rel_mm"), "3.840");
  EXPECT_EQ(table.cell(1, "tumour_mm"), "6.170");
  EXPECT_EQ(table.cell(1, "remark"), "-");
  EXPECT_EQ(table.cell(2, "estimate_mm"), "0.123");
  EXPECT_EQ(table.cell(2, "remark"), "fitted");
  std::filesystem::remove(folder / "fat-50/supine.vtkhdf");
  EXPECT_THROW(scaled_table(paper, folder / "fat", folder / "base.vtkhdf", read, ""), Error)
      << "missing, and no reason given";
  write_text(folder / "fat-50/supine.json",
             R"({"status": "unstable", "explanation": "It buckles."})");
  EXPECT_EQ(
      scaled_table(paper, folder / "fat", folder / "base.vtkhdf", read, "").cell(1, "nipple_mm"),
      "-")
      << "its report says why";
  for (const char* percent : {"10", "50", "100"})
    write_text(folder / ("soft-" + std::string(percent) + "/reference.json"),
               R"({"status": "not_converged", "reason": "none"})");
  const Table none =
      scaled_table(paper, folder / "soft", folder / "soft-100/supine.vtkhdf", read, "");
  EXPECT_EQ(none.cell(2, "tumour_mm"), "-") << "not even the base has a solution";
}

TEST(ChangedSets, ExchangeWhatTheirNamesSay) {
  const Table set = table_of(
      "tissue\tlaw\ta20_Pa\ta02_Pa\ta11_Pa\nfat\tp\t1\t2\t3\nfibroglandular\tp\t4\t5\t6\n");
  EXPECT_EQ(changed_set(set, "columns").text(),
            "tissue\tlaw\ta20_Pa\ta02_Pa\ta11_Pa\nfat\tp\t2\t3\t1\nfibroglandular\tp\t5\t6\t4\n");
  EXPECT_EQ(changed_set(set, "fat-only").text(),
            "tissue\tlaw\ta20_Pa\ta02_Pa\ta11_Pa\nfat\tp\t1\t2\t3\nfibroglandular\tp\t1\t2\t3\n");
  EXPECT_THROW(changed_set(set, "fat"), Error);
  EXPECT_THROW(changed_set(table_of("tissue\ta20_Pa\nfat\t1\n"), "fat-only"), Error);
}

TEST(Coverage, OfOneSampleIsWilsonsAndOfManyTheScatterOfTheirOwn) {
  const Share one = coverage({45}, {50});
  EXPECT_NEAR(one.percent, 90, 1e-12);
  EXPECT_NEAR(one.from, 78.64, 0.01);  // Wilson 1927, 45 of 50
  EXPECT_NEAR(one.to, 95.65, 0.01);
  const Share equal = coverage({9, 9, 9}, {10, 10, 10});
  EXPECT_DOUBLE_EQ(equal.from, equal.to) << "samples that agree leave no scatter";
  const Share apart = coverage({10, 0}, {10, 10});
  EXPECT_EQ(apart.from, 0);
  EXPECT_EQ(apart.to, 100);
}

TEST(Coverage, RowsOfABand) {
  const BandRows rows = read_band_rows(
      "# sample 3 failed\n1\ta\t0.5\t1\n1\tb\t-1\t1\n2\ta\t3\t1\n2\tb\t0\t1\n", "rows");
  const Table table = coverage_table({rows});
  EXPECT_EQ(table.cell(0, "samples"), "2");
  EXPECT_EQ(table.cell(0, "failed"), "1");
  EXPECT_EQ(table.cell(0, "in_50_percent"), "50.0");
  EXPECT_EQ(table.cell(0, "in_95_percent"), "75.0");
  EXPECT_EQ(table.cell(0, "rms_mm"), "1.60");
  EXPECT_THROW(read_band_rows("1\ta\t0.5\n", "rows"), Error);
  EXPECT_THROW(read_band_rows("# nothing\n", "rows"), Error);
  EXPECT_EQ(quantile({3, 1, 2}, 0.5), 2);
  EXPECT_EQ(quantile({5}, 0.01), 5);
}

TEST(Leaveout, TakesSmallestChangesFirstAndNothingBeyondTheBound) {
  const Table table = table_of(
      "variant\tsupine_tumour_mm\tsupine_nipple_mm\tcurve_max_mm\nskin\t0.2\t0.5\t3\ngland\t0.1\t0.3\t0.1\nno-gravity-in-compression\t0\t0\t0.2\n");
  const std::vector<std::string> parts{"skin", "gland", "no-gravity-in-compression"};
  const auto surgery = changes(table, "surgery", parts);
  ASSERT_EQ(surgery.size(), 2u) << "no compression in surgery";
  EXPECT_EQ(surgery.front().part, "gland");
  EXPECT_EQ(surgery.back().change, 0.5);
  EXPECT_EQ(least_model(surgery, 0.8).size(), 2u);
  EXPECT_EQ(least_model(surgery, 0.79).size(), 1u);
  EXPECT_TRUE(least_model(surgery, 0.1).empty());
  EXPECT_EQ(least_model(changes(table, "matching", parts), 1).size(), 2u);
  EXPECT_THROW(changes(table, "cost", parts), Error);
}

TEST(Cost, ASolveCarriesTheErrorOfItsStart) {
  const StageReport a = StageReport::parse(R"({"error_estimate_mm": 0.2})", "a"),
                    b = StageReport::parse(R"({"error_estimate_mm": 0.3})", "b");
  EXPECT_NEAR(carried_estimate(a, b).value(), 0.5, 1e-15);
  EXPECT_FALSE(carried_estimate(a, StageReport()));
}

TEST(Cost, RowsOfPointsAndTheLadder) {
  const ScratchFolder folder;
  for (const std::string point : {"q1p0-dome-4", "q2p1-dome-6-direct"}) {
    std::filesystem::create_directories(folder / point);
    for (const std::string shape : {"/reference", "/supine"}) {
      write_text(folder / (point + shape + ".vtkhdf"), "x");
      write_text(
          folder / (point + shape + ".json"),
          R"({"elements": 68, "unknowns": 300, "newton_iterations": 5, "error_estimate_mm": 0.1, "seconds": {"total": 1.5}, "cpu_seconds": 1.25, "peak_mb": 20.4})");
    }
  }
  std::filesystem::create_directories(folder / "q1p0-dome-8");
  write_text(folder / "q1p0-dome-8/reference.json",
             R"({"status": "not_converged", "reason": "no body"})");
  const auto read = shapes({{"q1p0-dome-4/reference.vtkhdf", 4},
                            {"q1p0-dome-4/supine.vtkhdf", 8},
                            {"q2p1-dome-6-direct/reference.vtkhdf", 4.5},
                            {"q2p1-dome-6-direct/supine.vtkhdf", 8.25}});
  const Table table = cost_table(folder.path(), "q2p1-dome-6-direct",
                                 {"q1p0-dome-4", "q2p1-dome-6-direct", "q1p0-dome-8"}, read);
  EXPECT_EQ(join(table.rows[0], " "),
            "q1p0-dome-4 q1p0 dome auto 68 300 5+5 2.50 3.00 20 0.5000 0.2500 0.1000 0.2000");
  EXPECT_EQ(table.cell(1, "solver"), "direct");
  EXPECT_EQ(table.cell(2, "cpu_s"), "-");
  EXPECT_EQ(accuracy_row(folder.path(), "q1p0-dome-4", "", 0.2, read)->back(), "yes");
  EXPECT_EQ(accuracy_row(folder.path(), "q1p0-dome-4", "", 0.19, read)->back(), "no");
  EXPECT_EQ(accuracy_row(folder.path(), "q2p1-dome-6-direct", "", 9, read)->back(), "no")
      << "the first rung of 27-node elements only starts";
  EXPECT_EQ(accuracy_row(folder.path(), "q2p1-dome-6-direct", "q1p0-dome-4", 0.5, read)->back(),
            "yes");
  EXPECT_FALSE(accuracy_row(folder.path(), "q1p0-dome-8", "", 1, read));
}

TEST(Budget, SaysWhyACellIsMissing) {
  const ScratchFolder folder;
  std::filesystem::create_directories(folder / "budget/chain");
  std::filesystem::create_directories(folder / "studies/budget/tissue");
  write_text(folder / "labels.json", R"({"cpu_seconds": 2.5})");
  write_text(folder / "mesh.json", R"({"cpu_seconds": 1})");
  write_text(folder / "budget/chain/landmarks.tsv",
             "landmark\tstress_free_error_mm\tsupine_error_mm\nmean\t0.5\t1.2345\nlargest\t1\t2\n");
  write_text(folder / "budget/chain/curves-summary.tsv",
             "statistic\ttrue_to_curve_mm\nmean\t3\np95\t4\n");
  write_text(
      folder / "studies/budget/tissue/cc.json",
      R"({"status": "not_converged", "reason": "folded", "explanation": "An element folds."})");
  const Table table = budget_table(folder.path(), {"tissue"});
  EXPECT_EQ(join(table.rows[0], " "), "chain 0.500 1.000 1.234 2.000 3.000 4.000 - 3.50 -");
  EXPECT_EQ(table.cell(1, "missing"), "cc: folded");
  EXPECT_EQ(table.cell(1, "cpu_s"), "2.50");
}

TEST(Studies, OfManySolvesAreCountedByKind) {
  const std::string header =
      "study\ttruth\telements\tpairs\tcpu_s\tconverged\tidentifiable\twithin_10_percent\twithin_2_sd\tdirections\tall_within_2_sd\tmotion_mm\tleft_out_mm\ttrue_mm\tprobability\n";
  const Table one = table_of(
      header +
      "same\ta\t500\t6\t1\t1\t2\t1\t2\t4\t3\t40\t1\t2\t0.5\nsame\ta\t500\t8\t3\t1\t2\t2\t2\t4\t4\t44\t2\t4\t0.01\n");
  const Table two = table_of(header + "surface\ta\t500\t100\t9\t0\t0\t0\t0\t0\t0\t40\t-\t3\t-\n" +
                             "same\ta\t900\t5\t2\t1\t0\t0\t0\t4\t4\t41\t1\t2\t0.5\n");
  const Table table = identification_table({one, two});
  EXPECT_EQ(join(table.rows[0], " "), "same a 2 500 2 7.0 8 2.0 4 75 100 88 42 1.50 3.00 4.00 50");
  EXPECT_EQ(table.cell(1, "alarms_%"), "-");
  EXPECT_EQ(table.cell(1, "known_5_percent"), "-");
  EXPECT_EQ(table.cell(2, "elements") + " " + table.cell(2, "draws"),
            "900 1");  // another mesh, another row

  const Table mechanics = table_of(
      "case\tdirection\toutcome\tresidual\tmin_det_F\tnewton\tseconds\nx\tforward\tconverged\t1e-9\t0.5\t7\t1\ny\tforward\tconverged\t2e-9\t0.25\t5\t2\nz\tbackward\trefused\t-\t-\t0\t0\n");
  const Table contact = table_of(
      "case\toutcome\tresidual\tmin_det_F\tnewton\tseconds\tverdict\np\tconverged\t1e-8\t0.5\t9\t3\tfailure\n");
  const Table stability = stability_table(mechanics, contact);
  EXPECT_EQ(join(stability.rows[0], " "), "forward converged 2 2.0e-09 0.250 7 3.0 -");
  EXPECT_EQ(join(stability.rows[1], " "), "backward refused 1 - - 0 0.0 z");
  EXPECT_EQ(join(stability.rows[2], " "),
            "compression converged, not as stated 1 1.0e-08 0.500 9 3.0 p");
}

TEST(Verify, ToleratesAndNamesWhatDiffers) {
  EXPECT_EQ(verdict_of("1.0", "1.04", "0.05"), "ok");
  EXPECT_EQ(verdict_of("1.0", "1.051", "0.05"), "differs");
  EXPECT_EQ(verdict_of("converged", "stopped_early", "0"), "differs");
  EXPECT_EQ(verdict_of("0", "", "1"), "missing");
  const ScratchFolder folder;
  write_text(folder / "a.json", R"({"status": "converged", "force_N": 103.25})");
  write_text(folder / "t.tsv", "file\tartificial_tumour_mm\nsupine.vtkhdf\t3.5\n");
  const std::string expected =
      "# why\nfile\trow\tcolumn\texpected\ttolerance\na.json\t-\tstatus\tconverged\t0\na.json\t-\tforce_N\t100\t1\n"
      "t.tsv\tsupine.vtkhdf\ttumour_mm\t3.4\t0.2\nnone.tsv\tx\ty\t1\t1\n";
  const Verification result = verify(table_of(expected), folder.path());
  EXPECT_EQ(result.failed, 2);
  EXPECT_EQ(result.table.cell(1, "computed"), "103.25");
  EXPECT_EQ(result.table.cell(2, "verdict"), "ok");
  EXPECT_EQ(result.table.cell(3, "verdict"), "missing");
  const std::string anew = expected_anew(expected, folder.path());
  EXPECT_NE(anew.find("# why\n"), std::string::npos);
  EXPECT_NE(anew.find("force_N\t103.25\t1\n"), std::string::npos);
  EXPECT_NE(anew.find("tumour_mm\t3.4\t0.2\n"), std::string::npos) << "what agrees keeps its value";
}

TEST(CohortCost, ComesFromTheDearestCaseOrGrowsWithTheMesh) {
  const Table measured = table_of(
      "case\telements\twall_seconds\tcpu_seconds\tpeak_mb\na\t4000\t9\t600\t400\nb\t4000\t9\t60\t800\nc\t4000\t9\t60\t40\n");
  const Table assumed = table_of("element\telements\tcpu_seconds\tpeak_mb\nq1p0\t16\t200\t380\n");
  EXPECT_EQ(case_cost(&measured, assumed, 1, "q1p0", 16).minutes, 35);
  EXPECT_EQ(case_cost(&measured, assumed, 1, "q1p0", 16).memory_mb, 1456);
  EXPECT_EQ(case_cost(&measured, assumed, 2, "q1p0", 16).minutes, 20);
  const CaseCost larger = case_cost(nullptr, assumed, 1, "q1p0", 32);
  EXPECT_EQ(larger.minutes, 5 + 3 * 200 * 16 / 60);
  EXPECT_EQ(larger.memory_mb, 256 + 3 * 380 * 8 / 2);
  EXPECT_NE(larger.source.find("ELEMENTS=32"), std::string::npos);
  EXPECT_THROW(case_cost(nullptr, assumed, 1, "q9", 16), Error);
}

TEST(Outcomes, SayWhatBecameOfEveryStageOfAVariant) {
  const ScratchFolder folder;
  std::filesystem::create_directories(folder / "soft");
  write_text(folder / "soft/reference.json",
             R"({"status": "converged", "reason": "", "elements": 68, "cpu_seconds": 1.5})");
  write_text(folder / "soft/reference.vtkhdf", "x");
  write_text(folder / "soft/supine.json",
             R"({"status": "not_converged", "reason": "line_search"})");
  const Table table = outcomes_table(folder.path(), {"nipple", "tumour"}, {"soft", "absent"},
                                     shapes({{"reference.vtkhdf", 4}}));
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(join(table.rows[0], " "), "soft reference converged - 68 1.50 4.0000 2.0000");
  EXPECT_EQ(join(table.rows[1], " "), "soft supine not_converged line_search - - - -");
}

TEST(Plates, RowsSayWhatTheReportsDoAndDashesWhereTheySayNothing) {
  const ScratchFolder folder;
  for (const std::string variant : {"coarse", "fine"}) {
    std::filesystem::create_directories(folder / variant);
    write_text(folder / (variant + "/cc.vtkhdf"), "x");
    write_text(
        folder / (variant + "/cc.json"),
        R"({"view": "CC", "status": "converged", "elements": 68, "force_N": 80, "pressure_kPa": 9.96,
                   "newton_iterations": 150, "plates": {"paddle": {"force_N": 80, "force_behind_edge_N": 10},
                   "detector": {"force_N": 0, "force_behind_edge_N": 0}}})");
  }
  const Table plates = plates_table(folder.path(), "next", {"coarse", "fine", "absent"},
                                    shapes({{"coarse/cc.vtkhdf", 4}, {"fine/cc.vtkhdf", 3}}));
  ASSERT_EQ(plates.rows.size(), 2u);
  EXPECT_EQ(plates.cell(0, "view") + " " + plates.cell(0, "paddle_behind_edge_percent") + " " +
                plates.cell(0, "detector_behind_edge_percent") + " " +
                plates.cell(0, "mean_pressure_kPa"),
            "CC 12.5 - 10.0");
  EXPECT_EQ(plates.cell(0, "tumour_mm") + " " + plates.cell(0, "nipple_mm"), "0.50 1.00");
  EXPECT_EQ(plates.cell(1, "nipple_mm"), "-") << "the next variant has no shape";
  const Table breasts = compressions_table({folder / "fine/cc.json", folder / "absent/mlo.json"});
  ASSERT_EQ(breasts.rows.size(), 2u);
  EXPECT_EQ(breasts.cell(0, "breast") + " " + breasts.cell(0, "paddle_N"), "fine 80.0");
  EXPECT_EQ(breasts.cell(1, "view") + " " + breasts.cell(1, "status"), "mlo -");
}

TEST(Pressed, PutsCalculixBesideTheSumOfOurSteps) {
  const Table ours = table_of(
      "force_N\tnewton\tcpu_seconds\tstatus\n10\t4\t0.5\tconverged\n25.5\t6\t0.75\tstopped_early\n");
  const Table table = pressed_table({"block", 60, 0.9, "26.1", 120, 12.5}, ours);
  EXPECT_EQ(join(table.rows[0], " "),
            "block 60 64.0 26.1 25.5 120 10 12.50 1.25 10.0 stopped_early");
}

TEST(Distribution, MeanAndDeviation) {
  const Distribution d = distribution_of({3, 1, 2});
  EXPECT_DOUBLE_EQ(d.mean, 2);
  EXPECT_DOUBLE_EQ(d.sd, 1);
  EXPECT_EQ(d.values.front(), 1);
  EXPECT_EQ(distribution_of({0.1, 0.1, 0.1}).sd, 0);
}

}  // namespace
}  // namespace breast
