// SPDX-License-Identifier: GPL-3.0-or-later
// tabulate as a program: what it refuses, in one line, and that its tables go to stdout alone.
#include <gtest/gtest.h>

#include "core/atomic_file.hpp"
#include "fixtures/run_tool.hpp"
#include "fixtures/scratch_folder.hpp"

namespace breast {
namespace {

class Tabulate : public testing::Test {
 protected:
  ToolResult run(const std::string& line) { return run_line("tabulate " + line, folder_.path()); }
  void refused(const std::string& line, const std::string& says) {
    const ToolResult result = run(line);
    EXPECT_EQ(result.exit_code, 2) << line << ": " << result.err;
    EXPECT_EQ(result.error_lines(), 1) << line << ": " << result.err;
    EXPECT_EQ(result.out, "") << line;
    EXPECT_NE(result.err.find(says), std::string::npos) << line << ": " << result.err;
  }
  ScratchFolder folder_;
};

TEST_F(Tabulate, RefusesWhatItCannotMake) {
  write_text(folder_ / "damaged.json", "{\"status\": \"conv");
  write_text(folder_ / "ragged.tsv", "a\tb\n1\n");
  refused("sumary x", "did you mean 'summary'?");
  refused("slopes x", "needs 4");
  refused("truth a b", "takes 1");
  refused("truth none.tsv", "none.tsv");
  refused("truth ragged.tsv", "line 2");
  refused("key damaged.json status", "damaged.json: not a JSON report");
  refused("place absent.json nipple", "has no landmark 'nipple'");
  refused("least ragged.tsv surgery much a", "'much'");
  refused("summary . --pipelines nowhere", "nowhere");
}

TEST_F(Tabulate, AVerdictThatDiffersFailsAndNamesTheValue) {
  write_text(folder_ / "a.json", "{\"force_N\": 103.25}");
  write_text(folder_ / "expected.tsv",
             "file\trow\tcolumn\texpected\ttolerance\na.json\t-\tforce_N\t100\t5\n");
  const ToolResult good = run("verify expected.tsv . --quiet");
  EXPECT_EQ(good.exit_code, 0) << good.err;
  EXPECT_EQ(
      good.out,
      "file\trow\tcolumn\texpected\tcomputed\ttolerance\tverdict\na.json\t\tforce_N\t100\t103.25\t5\tok\n");
  EXPECT_EQ(good.err, "");
  write_text(folder_ / "expected.tsv",
             "file\trow\tcolumn\texpected\ttolerance\na.json\t-\tforce_N\t100\t1\n");
  const ToolResult bad = run("verify expected.tsv .");
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_EQ(bad.out, "");
  EXPECT_NE(bad.err.find("a.json - force_N is 103.25, expected 100 within 1"), std::string::npos)
      << bad.err;
}

TEST_F(Tabulate, FillsPagesInPlaceAndChecksThem) {
  std::filesystem::create_directories(folder_ / "docs/tables");
  write_text(folder_ / "docs/tables/t.tsv", "a\tb\n1\t2\n");
  write_text(folder_ / "page.md", "x\n<!-- table docs/tables/t.tsv -->\n<!-- end of table -->\n");
  EXPECT_EQ(run("pages check page.md").exit_code, 1);
  EXPECT_EQ(run("pages fill page.md").exit_code, 0);
  EXPECT_EQ(run("pages check page.md").exit_code, 0);
  EXPECT_NE(read_text(folder_ / "page.md").find("| 1 | 2 |"), std::string::npos);
  write_text(folder_ / "docs/tables/lost.tsv", "a\n1\n");
  const ToolResult lost = run("pages check page.md");
  EXPECT_EQ(lost.exit_code, 1);
  EXPECT_NE(lost.err.find("lost.tsv: stands in no page"), std::string::npos) << lost.err;
}

}  // namespace
}  // namespace breast
