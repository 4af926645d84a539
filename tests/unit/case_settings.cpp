// SPDX-License-Identifier: GPL-3.0-or-later
// The settings of a run: what is refused before make expands anything, and what follows from what
// is given.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "cases/goals.hpp"
#include "cases/make_text.hpp"
#include "cases/scan_identity.hpp"
#include "cases/settings.hpp"
#include "cases/settings_table.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/text/trimmed.hpp"
#include "fixtures/scratch_folder.hpp"
#include "material/material_set.hpp"

namespace breast {
namespace {

namespace fs = std::filesystem;

constexpr const char* settings_table =
    "# what they are\n"
    "setting\tkind\tof\tdefault\tchoices\tmay_hold\n"
    "MR\tpath\tcase\t-\t-\t-\n"
    "MATERIALS\tpath\tcase\t-\tset\t-\n"
    "LANDMARKS\tpath\tcase\t-\t-\t-\n"
    "SUPINE\tpath\tcase\t-\t-\t-\n"
    "SIDE\tname\tcase\tleft\tleft right\t-\n"
    "CASE\tname\tcase\t-\t-\t-\n"
    "PRESET\tname\tcase\t-\taverage paper\t-\n"
    "WALL\tname\tcase\t-\theld slide:%\t:\n"
    "MUSCLE\tname\tcase\t-\t-\t-\n"
    "SURROUNDINGS\tname\tcase\t-\tnumber 0 60\t-\n"
    "PAPER\tname\tcase\t-\t1\t-\n"
    "REDUCTION\tname\tcase\t50\tnumber 1 95\t-\n"
    "PRESSURE\tname\tcase\t-\tnumber\t-\n"
    "AT_LEAST\tname\tcase\t-\tnumber\t-\n"
    "TUMOUR\tname\tcase\t-\tauto none place\t:\n"
    "ELEMENTS\tname\tcase\t16\tinteger 4 64\t-\n"
    "LEAVE_OUT\ttext\tcase\t-\tno-skin no-gland no-backward\t-\n"
    "MECHANICS\ttext\tcase\t-\t-\t-\n"
    "HEXMESH_OPTIONS\ttext\tcase\t-\t-\t-\n"
    "COMPRESS_OPTIONS\ttext\tcase\t-\t-\t-\n"
    "FORWARD\tprogram\tcommand\tforward\t-\t-\n"
    "CLUSTER\tname\tcommand\tlocal\tlocal slurm\t-\n"
    "CHROMIUM\twords\tcommand\t-\t-\t-\n"
    "CASE_FILE\tname\tcommand\t-\t-\t-\n"
    "COST_POINTS\twords\tcommand\t-\trows:cost\t-\n"
    "RUNS\tname\tcommand\truns\t-\t-\n"
    "RUN\tname\tcommand\t-\t-\t-\n";

class CaseSettings : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"materials", "studies"}) fs::create_directories(pipelines() / name);
    write_text(pipelines() / "settings.tsv", settings_table);
    write_text(pipelines() / "goals.tsv",
               "goal\tneeds\ntables\tpaper tumour\ntruth\ttruth\nbudget\tpaper truth held source\n"
               "cohort\tany\ncohort-script\tslurm any\n");
    write_text(pipelines() / "materials/invivo.tsv", "tissue\tc\nfat\t1\nwall\t2\n");
    write_text(pipelines() / "materials/seed2008.tsv", "tissue\tc\nfat\t1\n");
    write_text(pipelines() / "studies/cost.tsv", "variant\tstarts_at\nfine\tmesh\n");
    request_.pipelines = pipelines();
    request_.programs = "bin";
    request_.goals = {"chain"};
  }
  fs::path pipelines() const { return folder_ / "pipelines"; }
  // The lines for make of these settings, each between line breaks.
  std::string lines(const SettingsRequest::Values& given) {
    request_.command_line = given;
    std::string text = make_line_end + settings_for_make(request_);
    std::replace(text.begin(), text.end(), make_line_end, '\n');
    return text;
  }
  bool has_line(const SettingsRequest::Values& given, const std::string& line) {
    return lines(given).find("\n" + line + "\n") != std::string::npos;
  }
  std::string refusal(const SettingsRequest::Values& given) {
    try {
      lines(given);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  ScratchFolder folder_;
  SettingsRequest request_;
};

TEST(Trimmed, LeavesOnlyInnerBlanks) {
  EXPECT_EQ(trimmed("\t a b\r\n"), "a b\r\n") << "a line break is no blank";
  EXPECT_EQ(trimmed(" \f\va b\r"), "a b");
  EXPECT_EQ(trimmed(" \t"), "");
}

TEST_F(CaseSettings, UnknownNamesAndValuesAreRefusedWithASuggestion) {
  EXPECT_EQ(refusal({{"SIDES", "left"}}),
            "SIDES is not a setting; did you mean SIDE? (`make -f Makefile.pipeline help` lists "
            "all settings)");
  EXPECT_EQ(refusal({{"SIDE", "lefft"}}),
            "SIDE: 'lefft' is none of left, right; did you mean left?");
  EXPECT_EQ(refusal({{"MATERIALS", "seed208"}}),
            "MATERIALS: 'seed208' is neither a file nor one of invivo, seed2008; did you mean "
            "seed2008?");
  EXPECT_EQ(refusal({{"MATERIALS", (pipelines() / "materials/invivo.tsv").string()}}), "");
  EXPECT_NE(refusal({{"REDUCTION", "1.2.3"}}).find("REDUCTION: '1.2.3' is not a number"),
            std::string::npos);
  EXPECT_NE(refusal({{"REDUCTION", "."}}), "");
  EXPECT_EQ(refusal({{"REDUCTION", "40.5"}}), "");
  EXPECT_EQ(refusal({{"REDUCTION", "500"}}), "REDUCTION: 500 must be from 1 to 95");
  EXPECT_EQ(refusal({{"REDUCTION", "95"}}), "");
  EXPECT_EQ(refusal({{"ELEMENTS", "0"}}), "ELEMENTS: 0 must be from 4 to 64");
  EXPECT_EQ(refusal({{"ELEMENTS", "6.5"}}), "ELEMENTS: '6.5' is not a whole number");
  EXPECT_EQ(refusal({{"TUMOUR", "1,2"}}),
            "TUMOUR 1,2: expected auto, none, a file, or x,y,z[:radius] in mm");
  EXPECT_NE(refusal({{"TUMOUR", "1,2,3:90"}}).find("radius 90 mm must be above 0"),
            std::string::npos);
  EXPECT_EQ(refusal({{"TUMOUR", (pipelines() / "settings.tsv").string()}}), "");
  EXPECT_EQ(refusal({{"WALL", "slide:3"}}), "");
  EXPECT_NE(refusal({{"WALL", "slid"}}), "");
  EXPECT_EQ(refusal({{"COST_POINTS", "fine"}}), "");
  EXPECT_EQ(refusal({{"COST_POINTS", "fine coarse"}}), "COST_POINTS: 'coarse' is none of fine");
}

TEST_F(CaseSettings, TextThatIsCodeIsRefusedForEveryKind) {
  for (const std::string code : {"$(shell x)", "`x`", "a;b", "a'b", "a#b", "a\\b", "a|b", "a\nb"})
    for (const char* name : {"MR", "MECHANICS", "FORWARD", "share"})
      EXPECT_NE(refusal({{name, code}}).find("may not stand in it"), std::string::npos)
          << name << "=" << code;
  for (const std::string name : {"a=b", "a:b", "a%b", "a~b"}) {
    EXPECT_NE(refusal({{"MR", name}}).find("the character " + name.substr(1, 1)),
              std::string::npos);
    EXPECT_EQ(refusal({{"MECHANICS", name}}), "") << "no harm in options";
  }
  EXPECT_NE(refusal({{"MR", "a b"}}).find("blanks may not stand in 'a b'"), std::string::npos);
  EXPECT_NE(refusal({{"MR", "-x"}}).find("write ./-x"), std::string::npos);
  EXPECT_EQ(refusal({{"TUMOUR", "-5,3,2:4"}}), "");
  EXPECT_NE(refusal({{"TUMOUR", "5:4=x"}}), "") << "after a character that it may contain";
  request_.environment = {{"MR", "$(shell x)"}};
  EXPECT_NE(refusal({}), "") << "make reads the environment, too";
  request_.environment = {{"CHROMIUM", "a 'b'"}, {"PATH", "$x"}};
  EXPECT_EQ(refusal({}), "");
}

TEST_F(CaseSettings, TheModelFollowsFromTheCase) {
  EXPECT_TRUE(has_line({}, "RUN := runs/average")) << lines({});
  EXPECT_TRUE(has_line({}, "MATERIALS := invivo"));
  EXPECT_TRUE(has_line({}, "POPULATION_MATERIALS := " + std::string(default_material_set)));
  EXPECT_TRUE(has_line({}, "PRESSURE := 10")) << "a breast that slides";
  EXPECT_TRUE(has_line({}, "MUSCLE := measured"));
  EXPECT_TRUE(has_line({}, "SURROUNDINGS := 16"));
  EXPECT_TRUE(has_line({}, "FORWARD := bin/forward"));
  EXPECT_TRUE(has_line({{"PRESET", "paper"}}, "MATERIALS := seed2008"));
  EXPECT_TRUE(has_line({{"PRESET", "paper"}}, "PRESSURE := "));
  EXPECT_TRUE(has_line({{"PAPER", "1"}}, "RUN := runs/paper-as-printed"));
  EXPECT_TRUE(has_line({{"PAPER", "1"}}, "AT_LEAST := 30"));
  EXPECT_TRUE(has_line({{"PAPER", "1"}}, "MECHANICS = $(PRINTED_MECHANICS)"));
  EXPECT_TRUE(has_line({{"MATERIALS", "seed2008"}}, "MUSCLE := 0"));
  EXPECT_TRUE(has_line({{"MATERIALS", "seed2008"}}, "SURROUNDINGS := 0"));
  EXPECT_EQ(lines({{"MECHANICS", "--x"}}).find("\nMECHANICS"), std::string::npos)
      << "what is given stays as it is";
  request_.goals = {"tables"};
  EXPECT_TRUE(has_line({}, "PRESET := paper"));
}

TEST_F(CaseSettings, AScanHasItsOwnFolderAndNoTumour) {
  EXPECT_TRUE(has_line({{"MR", "x/pat.001.nii.gz"}, {"SIDE", "right"}}, "CASE := pat.001-right"));
  EXPECT_TRUE(has_line({{"MR", "1.2.840/"}}, "CASE := 1.2.840-left"));
  EXPECT_TRUE(has_line({{"MR", "x.nrrd"}}, "TUMOUR := none"));
  EXPECT_TRUE(has_line({{"MR", "x.nrrd"}}, "no_tumour := yes"));
  EXPECT_TRUE(has_line({{"MR", "x.nrrd"}}, "TRUTH := "));
  EXPECT_TRUE(has_line({{"MR", "x.nrrd"}, {"TUMOUR", "auto"}}, "no_tumour := "));
  EXPECT_TRUE(has_line({}, "no_tumour := "));
  EXPECT_TRUE(has_line({{"HEXMESH_OPTIONS", "--tumour none"}}, "no_tumour := yes"));
  EXPECT_TRUE(has_line({{"SIDE", "right"}}, "CASE := average-right"));
  EXPECT_NE(refusal({{"MR", ""}}).find("MR: is empty"), std::string::npos)
      << "a phantom's result is not that of a scan whose name was lost";
  for (const char* name : {"", "..", ".x", "a/b"})
    EXPECT_NE(refusal({{"CASE", name}}).find("CASE: "), std::string::npos) << name;
  EXPECT_NE(refusal({{"RUNS", ""}}).find("RUNS: is empty"), std::string::npos);
  write_text(folder_ / "scan.nrrd", "abc");
  remember_scan(folder_ / "run", "left", folder_ / "scan.nrrd");
  EXPECT_NE(refusal({{"RUN", (folder_ / "run").string()}}).find("another scan"), std::string::npos);
  request_.goals = {"cohort"};
  EXPECT_EQ(refusal({{"RUN", (folder_ / "run").string()}}), "") << "not about the case in RUN";
}

TEST_F(CaseSettings, ACaseFileIsBetweenTheCommandLineAndTheEnvironment) {
  const std::string file = (folder_ / "a.case").string();
  write_text(file, "REDUCTION = 40\nSIDE = right\n");
  request_.environment = {{"SIDE", "left"}, {"CASE", "mine"}};
  EXPECT_TRUE(has_line({{"CASE_FILE", file}}, "SIDE := right"));
  EXPECT_TRUE(has_line({{"CASE_FILE", file}}, "RUN := runs/mine"));
  EXPECT_FALSE(has_line({{"CASE_FILE", file}, {"REDUCTION", "30"}}, "REDUCTION := 40"));
  write_text(file, "SIDE = lefft\n");
  EXPECT_NE(refusal({{"CASE_FILE", file}}).find("did you mean left?"), std::string::npos);
  write_text(file, "MR = a b.nrrd\n");
  EXPECT_NE(refusal({{"CASE_FILE", file}}).find("blanks"), std::string::npos);
  write_text(file, "FORWARD = /bin/sh\n");
  EXPECT_NE(refusal({{"CASE_FILE", file}}), "") << "not a setting of a case";
}

TEST_F(CaseSettings, SetsAndPartsAreExchangedForTheCase) {
  EXPECT_TRUE(has_line({{"LANDMARKS", "a.tsv"}}, "prior_set := invivo"));
  EXPECT_TRUE(
      has_line({{"LANDMARKS", "a.tsv"}}, "override MATERIALS := runs/average/identified.tsv"));
  EXPECT_NE(refusal({{"SUPINE", "phantom"}, {"MR", "x.nrrd"}}).find("SUPINE: phantom is"),
            std::string::npos);
  EXPECT_EQ(refusal({{"SUPINE", "phantom"}}), "");
  const SettingsRequest::Values without{{"LEAVE_OUT", "no-skin no-gland"}};
  EXPECT_TRUE(has_line(without, "override HEXMESH_OPTIONS += --skin 0"));
  EXPECT_TRUE(has_line(without, "override MATERIALS := runs/average/fat-only.tsv"));
  EXPECT_TRUE(has_line(without,
                       "override whole_set := " + (pipelines() / "materials/invivo.tsv").string()));
  EXPECT_EQ(lines(without).find("PRONE"), std::string::npos);
  EXPECT_TRUE(has_line({{"LEAVE_OUT", "no-gland"}, {"SUPINE", "a.nrrd"}},
                       "override whole_set := runs/average/identified.tsv"));
}

TEST_F(CaseSettings, ATargetIsRefusedIfTheCaseCannotHaveIt) {
  const auto refused = [&](const std::string& goal, const SettingsRequest::Values& given) {
    request_.goals = {"chain", goal};
    return refusal(given);
  };
  EXPECT_EQ(refused("tables", {}), "");
  EXPECT_NE(refused("tables", {{"MR", "x.nrrd"}}).find("tables: needs a tumour"),
            std::string::npos);
  EXPECT_NE(refused("truth", {{"MR", "x.nrrd"}}).find("truth: a scan has no truth"),
            std::string::npos);
  EXPECT_EQ(refused("budget", {}), "") << "PRESET is paper unless given";
  EXPECT_NE(refused("budget", {{"PRESET", "average"}}).find("give PRESET=paper"),
            std::string::npos);
  EXPECT_NE(refused("truth", {{"PRESET", "average"}, {"PAPER", "1"}}).find("with PAPER=1"),
            std::string::npos);
  EXPECT_NE(refused("cohort-script", {}).find("give CLUSTER=slurm"), std::string::npos);
  EXPECT_EQ(refused("cohort-script", {{"CLUSTER", "slurm"}}), "");
  request_.installed = true;
  EXPECT_NE(refused("budget", {}).find("needs the source tree"), std::string::npos);
}

TEST(Rows, BecomeAssignmentsAndATemplate) {
  const Table table = parse_table("a\tb\nx y\t-\n", "t.tsv");
  std::string text = rows_for_make(table, "rule");
  std::replace(text.begin(), text.end(), make_line_end, '\n');
  EXPECT_EQ(text, "cell_a := x y\ncell_b := \n$(eval $(value rule))\n");
  EXPECT_THROW(rows_for_make(parse_table("a\n$(shell x)\n", "t.tsv"), "rule"), Error);
}

}  // namespace
}  // namespace breast
