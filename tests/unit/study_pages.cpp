// SPDX-License-Identifier: GPL-3.0-or-later
// What runs say: reports that need not be there, warnings once with their advice, summaries, pages whose every text is escaped.
#include <gtest/gtest.h>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/text/base64.hpp"
#include "core/text/lists.hpp"
#include "core/text/utf8.hpp"
#include "fixtures/scratch_folder.hpp"
#include "study/cells.hpp"
#include "study/cohort/cohort_page.hpp"
#include "study/cohort/cohort_table.hpp"
#include "study/cohort/side_table.hpp"
#include "study/pages/html.hpp"
#include "study/pages/markdown.hpp"
#include "study/pages/report_page.hpp"
#include "study/stage_report.hpp"
#include "study/summary.hpp"
#include "study/warnings.hpp"

namespace breast {
namespace {

TEST(StageReports, AnswerNothingWhereNothingIs) {
  const StageReport report = StageReport::parse(
      R"({"a": 1.50, "none": null, "n": 3, "t": "x", "yes": true, "deep": {"total": 2, "b": {"only": 7}}, "list": ["p", 1, "q"],
          "landmarks": {"artificial_tumour": {"imaged": [1, 2, 3]}, "bad": {"imaged": [1, null, 3]}}})",
      "r");
  EXPECT_EQ(report.text("a"), "1.5");
  EXPECT_EQ(report.text("n"), "3");
  EXPECT_EQ(report.text("yes"), "true");
  EXPECT_EQ(report.text("none"), "");
  EXPECT_EQ(report.text("deep"), "");
  EXPECT_EQ(report.number("deep/total"), 2);
  EXPECT_FALSE(report.number("t") || report.number("none") || report.number("deep/total/x") ||
               report.number("list/0"));
  EXPECT_EQ(report.first("only"), 7);
  EXPECT_FALSE(report.first("absent"));
  EXPECT_EQ(report.texts("list"), (std::vector<std::string>{"p", "q"}));
  EXPECT_EQ(report.place("tumour", "imaged")->z(), 3);
  EXPECT_FALSE(report.place("bad", "imaged") || report.place("nipple", "imaged") ||
               report.place("tumour", "position"));
  EXPECT_TRUE(StageReport::read("/nowhere/at/all.json").empty());
  EXPECT_THROW(StageReport::parse("[1]", "r"), Error);
  EXPECT_THROW(StageReport::parse("{\"a\": ", "r"), Error);
  EXPECT_THROW(StageReport::parse(std::string(100000, '['), "r"), Error);
  std::string keys = "{\"a\": 1";
  for (int n = 0; n < 30000; ++n) keys += ", \"k" + std::to_string(n) + "\": 0";
  EXPECT_THROW(StageReport::parse(keys + "}", "r"), Error) << "sought one by one";
  EXPECT_EQ(StageReport::parse("{\"a\": \"caf\xe9\"}", "r").text("a"), "caf\xEF\xBF\xBD")
      << "another program's Latin-1";
}

TEST(StageReports, SayWhyASolveHasNoResult) {
  const ScratchFolder folder;
  EXPECT_FALSE(failure_of(folder / "x")) << "never tried";
  write_text(
      folder / "x.json",
      R"({"status": "unstable", "reason": "buckled", "explanation": "It would\nnot stay."})");
  EXPECT_EQ(failure_of(folder / "x"), "It would not stay.");
  std::filesystem::create_directories(folder / "v");
  std::filesystem::copy_file(folder / "x.json", folder / "v/reference.json");
  EXPECT_EQ(posture_failure_of(folder / "v"), "It would not stay.");
  write_text(folder / "x.vtkhdf", "x");
  EXPECT_FALSE(failure_of(folder / "x")) << "a state kept in spite of its status is a result";
  std::filesystem::create_directories(folder / "y");
  write_text(folder / "y/supine.json", R"({"status": "not_converged", "reason": "line_search"})");
  EXPECT_EQ(posture_failure_of(folder / "y"), "line_search");
}

TEST(Cells, Utf8AndColumns) {
  EXPECT_EQ(valid_utf8("\xC3\xA9t\xC3\xA9"), "\xC3\xA9t\xC3\xA9");
  EXPECT_EQ(valid_utf8("\xED\xA0\x80"), "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD") << "a surrogate";
  EXPECT_EQ(valid_utf8("\xC0\xAF"), "\xEF\xBF\xBD\xEF\xBF\xBD") << "an overlong slash";
  EXPECT_EQ(aligned("# no\na\tbb\nccc\td\n"), "  a    bb\n  ccc  d\n");
  EXPECT_EQ(folded("one two three", 8), "one two \nthree\n");
}

TEST(Warnings, StandOnceWithTheirStagesAndTheAdviceInTheLastOfItsGroup) {
  const std::vector<Advice> advice{{"plates? not", "Move them."},
                                   {"quality of (contrast|wall)", "Look."}};
  const auto gathered = gather({{"labels", {"quality of wall", "odd"}},
                                {"cc", {"plates not balanced", "quality of contrast"}},
                                {"mlo", {"plates not balanced"}}},
                               advice);
  ASSERT_EQ(gathered.size(), 4u);
  EXPECT_EQ(gathered[0].text, "quality of wall");
  EXPECT_EQ(gathered[0].remedy, "") << "said once, in the last of its group";
  EXPECT_EQ(gathered[1].text, "quality of contrast");
  EXPECT_EQ(gathered[1].remedy, "Look.");
  EXPECT_EQ(gathered[2].text, "odd");
  EXPECT_EQ(gathered[3].stages, "cc, mlo");
  EXPECT_EQ(gathered[3].remedy, "Move them.");
}

TEST(Warnings, APatternThatIsNoneIsNamedWithItsLine) {
  const ScratchFolder folder;
  write_text(folder / "advice.tsv", "# comment\ngood\tx\n(bad\ty\n");
  try {
    read_advice(folder / "advice.tsv");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("line 3"), std::string::npos) << error.what();
  }
}

TEST(Html, EscapesEveryTextAndMarksVerdicts) {
  EXPECT_EQ(escaped("<a href='x'>&\""), "&lt;a href=&#39;x&#39;&gt;&amp;&quot;");
  EXPECT_EQ(base64("Man"), "TWFu");
  EXPECT_EQ(base64("Ma"), "TWE=");
  EXPECT_EQ(base64("M"), "TQ==");
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64(std::string("\xff\0\x80", 3)), "/wCA");
  const std::string table = html_table("# no\na_b\tc\n1.5\tfails\n<i>\tx\n");
  EXPECT_EQ(
      table,
      "<table><tr>\n<th>a b</th>\n<th>c</th>\n</tr>\n<tr><td class=n>1.5</td><td class=bad>fails</td></tr>\n"
      "<tr><td>&lt;i&gt;</td><td>x</td></tr>\n</table>\n");
  EXPECT_EQ(html_table("# nothing\n"), "");
}

TEST(Markdown, FillsTablesBetweenTheirMarks) {
  const auto read = [](const std::string& file) {
    return file == "t.tsv" ? std::string("a\tb\n1\t2\n# rows 1\n") : std::string("# none\n");
  };
  const auto run = [](const std::string&) { return std::string("Run: not recorded."); };
  const std::string filled =
      with_tables("x\n<!-- table t.tsv -->\nold\n<!-- end of table -->\ny\n", "page", read, run);
  EXPECT_EQ(
      filled,
      "x\n<!-- table t.tsv -->\n\n| a | b |\n|---|---|\n| 1 | 2 |\n\nRun: not recorded.\n\n<!-- end of table -->\ny\n");
  EXPECT_EQ(with_tables(filled, "page", read, run), filled) << "filling again changes nothing";
  EXPECT_THROW(with_tables("<!-- table t.tsv -->\nold\n", "page", read, run), Error)
      << "without an end";
  EXPECT_THROW(with_tables("<!-- table u.tsv -->\n<!-- end of table -->\n", "page", read, run),
               Error)
      << "a table without a row";
}

TEST(Markdown, SaysOfWhichRunATableIs) {
  const Table none{{"table", "date", "commit", "machine"}, {}};
  EXPECT_EQ(run_line(none, "docs/tables/t.tsv"), "Run: not recorded.");
  const Table one = with_run(none, "docs/tables/t.tsv", "2026-11-23", "abc1234", "2 cores, X");
  EXPECT_EQ(run_line(one, "docs/tables/t.tsv"), "Run: 2026-11-23, commit abc1234, 2 cores, X.");
  const Table two =
      with_run(with_run(one, "a.tsv", "none", "-", "-"), "t.tsv", "2026-11-24", "d", "y");
  EXPECT_EQ(run_line(two, "a.tsv"), "Not from a run.");
  EXPECT_EQ(two.rows.size(), 2u) << "a table has one run, the last";
  EXPECT_EQ(run_line(two, "t.tsv"), "Run: 2026-11-24, commit d, y.");
}

TEST(Markdown, NumbersOfPagesAreThoseOfTheirSources) {
  const ScratchFolder folder;
  write_text(folder / "page.md", "about 12 mm, then 7 mm\n");
  write_text(folder / "code.cpp", "constexpr int a = 12, b = 8;\n");
  const std::string page = (folder / "page.md").string(), code = folder.path().string();
  Table numbers{{"page", "page_pattern", "source", "source_pattern"},
                {{page, "about ([0-9]+)", code, "a = ([0-9]+)"},
                 {page, "then ([0-9]+)", code, "b = ([0-9]+)"},
                 {page, "never ([0-9]+)", code, "b = ([0-9]+)"}}};
  const auto wrong = wrong_numbers(numbers);
  ASSERT_EQ(wrong.size(), 2u);
  EXPECT_NE(wrong[0].find("says '7'"), std::string::npos);
  EXPECT_NE(wrong[1].find("says 'nothing'"), std::string::npos);
}

TEST(ReportPage, NamesNoFolderAndBeginsWithWarnings) {
  const ScratchFolder folder;
  const std::filesystem::path run = folder / "a<b>";
  std::filesystem::create_directories(run / "leaveout");
  write_text(run / "cc.json",
             R"({"status": "converged", "thickness_mm": 41.27, "warnings": ["<script>"]})");
  write_text(run / "displacements.tsv", "file\tnipple_mm\nsupine.vtkhdf\t3.5\n");
  write_text(
      run / "population.tsv",
      "quantity\tmean\twomen_mean\twomen_sd\twithin_one_sd\nnipple_moved_mm\t97.3\t101\t33\tyes\n");
  write_text(run / ".labels.settings", "/home/me/bin/segment /secret/scan.nrrd --side left\n");
  const std::string page = report_page(run, {folder.path(), {}, {"A limit."}, "", "Made today."});
  EXPECT_NE(page.find("labels: segment scan.nrrd --side left\n"), std::string::npos);
  EXPECT_EQ(page.find("secret"), std::string::npos);
  EXPECT_EQ(page.find("<script>"), std::string::npos);
  EXPECT_NE(page.find("case a&lt;b&gt;"), std::string::npos);
  EXPECT_LT(page.find("Warnings: 1"), page.find("<h2>Landmarks"));
  EXPECT_NE(page.find("<td>41.27"), std::string::npos);
  EXPECT_NE(page.find("<li>A limit."), std::string::npos);
  EXPECT_NE(page.find("<td>nipple moved<td class=n>97.3<td class=n>101"), std::string::npos);
}

TEST(Cohort, FailuresComeFirstAndASilentCaseIsOne) {
  const ScratchFolder folder;
  write_text(folder / ".cases", "good\tx\tscan\nlost\tx\tscan\nnever\tx\tscan\nbad\tx\tscan\n");
  write_text(folder / "good.status", "done\t\n");
  write_text(folder / "lost.status", "running\t\n");
  write_text(folder / "bad.status", "failed\tno such scan\n");
  std::filesystem::create_directories(folder / "good");
  write_text(
      folder / "good/labels.json",
      R"({"quality": {"contrast": 0.4, "wall": 1}, "seconds": {"total": 2.4}, "cpu_seconds": 3, "peak_mb": 99.6, "warnings": ["w"]})");
  write_text(folder / "good/mesh.json",
             R"({"volume_ml": 512.3, "min_scaled_jacobian": 0.09, "elements": 4000})");
  write_text(folder / "good/motion.tsv",
             "case\tside\tnipple_moved_mm\tother_mm\ngood\tleft\t90\t5\n");
  const Table women = parse_table("quantity\tmean\tsd\nnipple_moved_mm\t60\t10\n", "women");
  const auto cases = read_cases(folder.path());
  const Table table = cohort_table(folder.path(), cases, {}, women);
  EXPECT_EQ(table.rows.back().front(), "good");
  EXPECT_EQ(cell_at(table, "lost", "status"), "failed");
  EXPECT_EQ(cell_at(table, "bad", "reason"), "no such scan");
  EXPECT_EQ(cell_at(table, "never", "reason"), "never started");
  EXPECT_EQ(
      cell_at(table, "good", "look"),
      "1 warnings; quality of contrast 0.40; element shape 0.09; nipple_moved_mm 90 (women 60, sd 10)");
  EXPECT_EQ(join(cohort_cost(folder.path(), cases).rows.front(), " "), "good 4000 2 3 100");
  const CohortPages pages{folder.path(),
                          table,
                          cohort_cost(folder.path(), cases),
                          {},
                          women,
                          {false, [](const auto&, int) { return std::string(); },
                           [](const auto&) { return std::string(); }}};
  const std::string page = cohort_page(pages), contours = contours_page(pages);
  EXPECT_LT(page.find("<h2>Failed"), page.find("<h2>Done"));
  EXPECT_NE(page.find("4 cases: 1 done, 3 failed, 1 ask for a look."), std::string::npos);
  EXPECT_NE(contours.find("no contours"), std::string::npos);
  EXPECT_EQ(page.find(folder.path().parent_path().string() + "/"), std::string::npos)
      << "names no folder";
}

TEST(Cohort, SidesSayHowFarTheyGetAndWhatWasMended) {
  const ScratchFolder folder;
  write_text(folder / ".cases", "left\tx\tscan\nright\tx\tscan\n");
  write_text(folder / "left.status", "done\t\n");
  write_text(folder / "right.status", "failed\tno chest wall\n");
  std::filesystem::create_directories(folder / "left");
  for (const char* stage : {"labels", "geometry", "mesh"})
    write_text(folder / "left" / (std::string(stage) + ".vtkhdf"), "x");
  write_text(folder / "left/labels.json",
             R"({"chest_wall": {"sigma_mean_mm": 1.52}, "cpu_seconds": 9, "peak_mb": 305})");
  write_text(folder / "left/geometry.json",
             R"({"fit": {"mean_mm": 0.1, "p95_mm": 0.31}, "mended": ["the rim was moved"]})");
  write_text(
      folder / "left/mesh.json",
      R"({"min_scaled_jacobian": 0.431, "volume_ml": 512.3, "mended": ["layers"], "cpu_seconds": 2})");
  write_text(folder / "left/labels-truth.tsv", "quantity\tvalue\nbody_dice\t0.9921\nwall_p95_mm\t1.6\n");
  const Table table = side_table(folder.path(), read_cases(folder.path()));
  EXPECT_EQ(join(table.rows[0], " "),
            "left mesh 0.992 - - 1.6 1.5 0.10 0.31 0.43 512 11 305 the rim was moved; layers -");
  EXPECT_EQ(cell_at(table, "right", "reached"), "-");
  EXPECT_EQ(cell_at(table, "right", "reason"), "no chest wall");
}

}  // namespace
}  // namespace breast
