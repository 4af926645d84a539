// SPDX-License-Identifier: GPL-3.0-or-later
// What the pipeline reads before it runs a case: case files, the record of the scan to which a
// folder belongs, cohorts, studies, and scripts for Slurm.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <functional>

#include "cases/attempt.hpp"
#include "cases/case_file.hpp"
#include "cases/case_run.hpp"
#include "cases/cohort_files.hpp"
#include "cases/ladder.hpp"
#include "cases/make_text.hpp"
#include "cases/scan_identity.hpp"
#include "cases/slurm.hpp"
#include "cases/variants.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "fixtures/scratch_folder.hpp"

namespace breast {
namespace {

namespace fs = std::filesystem;

std::string reason(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

const std::vector<std::string> keys{"MR", "SIDE", "PRESET", "HEXMESH_OPTIONS", "ELEMENTS"};

std::string refusal(const std::string& text, const std::string& name = "a.case") {
  return reason([&] { parse_case_file(text, name, keys); });
}

TEST(CaseFiles, AreKeysAndValuesWithComments) {
  const CaseFile file = parse_case_file(
      "# a patient\r\nMR = a/b.nrrd\nSIDE=right\t# from her\n\n  HEXMESH_OPTIONS =  --elements 8 --order 1  \n",
      "a.case", keys);
  ASSERT_EQ(file.settings.size(), 3u);
  EXPECT_EQ(file.settings[0], (std::pair<std::string, std::string>("MR", "a/b.nrrd")));
  EXPECT_EQ(file.settings[1].second, "right");
  EXPECT_EQ(file.settings[2].second, "--elements 8 --order 1");
  EXPECT_TRUE(file.has("SIDE"));
  EXPECT_FALSE(file.has("PRESET"));
}

TEST(CaseFiles, AreRefusedByLineAndKey) {
  EXPECT_EQ(refusal("\nMRI = x"),
            "case file a.case, line 2: MRI is no setting of a case; did you mean MR?");
  EXPECT_NE(refusal("include other").find("line 1: this line is not KEY = VALUE"),
            std::string::npos);
  for (const std::string code : {"export X = 1", "SIDE := left", "SIDE ?= left"})
    EXPECT_NE(refusal(code).find("is not KEY = VALUE"), std::string::npos) << code;
  EXPECT_NE(refusal("MR = x\nMR = y").find("line 2: MR is given for the second time"),
            std::string::npos);
  for (const std::string code : {"$(shell x)", "`x`", "a;b", "a'b", "a#b", "a\\b", "a|b", "#x"})
    EXPECT_NE(refusal("MR = " + code).find("MR contains the character"), std::string::npos) << code;
  EXPECT_NE(refusal(std::string("MR = a\x1e") + "b").find("control character"), std::string::npos)
      << "the end of a line of make";
  EXPECT_NE(refusal(std::string(70000, '#')).find("larger than 64 kB"), std::string::npos);
  EXPECT_NE(reason([] { read_case_file("/nowhere.case", keys); }).find("can be read"),
            std::string::npos);
}

TEST(ScanIdentity, KnowsAnotherScanAndSideWhateverItsNameAndTimes) {
  const ScratchFolder folder;
  for (const char* patient : {"A", "B"}) fs::create_directories(folder / patient);
  write_text(folder / "A/1", "slice-a");
  write_text(folder / "B/1", "slice-b");
  const fs::path run = folder / "run";
  EXPECT_EQ(mixed_up(run, "left", folder / "A"), "") << "nothing is remembered yet";
  remember_scan(run, "left", folder / "A");
  EXPECT_EQ(mixed_up(run, "left", folder / "A"), "");
  fs::last_write_time(folder / "A/1", fs::file_time_type::clock::now() - std::chrono::hours(9));
  EXPECT_EQ(mixed_up(run, "left", folder / "A"), "") << "touched, and still the same";
  EXPECT_NE(mixed_up(run, "left", folder / "B").find("another scan"), std::string::npos);
  EXPECT_NE(mixed_up(run, "right", folder / "A").find("holds the left breast"), std::string::npos);
  EXPECT_NE(mixed_up(run, "left", "phantom:small"), "");
  EXPECT_EQ(mixed_up(run, "left", folder / "C"), "") << "make says that it is not there";
  EXPECT_EQ(read_text(run / ".scan").find(folder.path().string()), std::string::npos);
}

TEST(ScanIdentity, OneOfTwoRunsThatBeginAtOnceHasTheFolder) {
  const ScratchFolder folder;
  write_text(folder / "A", "a");
  write_text(folder / "B", "b");
  EXPECT_EQ(mixed_up(folder / "run", "left", folder / "A"), "");
  EXPECT_EQ(mixed_up(folder / "run", "left", folder / "B"), "") << "both have asked";
  remember_scan(folder / "run", "left", folder / "A");
  EXPECT_THROW(remember_scan(folder / "run", "left", folder / "B"), Error);
  EXPECT_EQ(mixed_up(folder / "run", "left", folder / "A"), "");
  remember_scan(folder / "run", "left", folder / "A");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "run"), {}), 1) << "nothing else is left";
}

TEST(ScanIdentity, OfWhatIsNoFileIsRefused) {
  const ScratchFolder folder;
  EXPECT_THROW(remember_scan(folder / "run", "left", "/dev/zero"), Error);
}

TEST(ScanIdentity, RemembersContentAsSha256sumDoes) {
  const ScratchFolder folder;
  write_text(folder / "scan.nrrd", "abc");
  remember_scan(folder / "run", "left", folder / "scan.nrrd");
  // printf abc | sha256sum | sha256sum
  EXPECT_NE(read_text(folder / "run/.scan")
                .find("content\t3037103b5833a3a6a132fee525b05d963dd32445ffa08e9e2e7fd5342a04f332"),
            std::string::npos)
      << read_text(folder / "run/.scan");
}

TEST(Cohorts, AreFoundCheckedAndNamedOnce) {
  const ScratchFolder folder;
  const auto entries = [&] { return cohort_entries(folder.path(), keys); };
  EXPECT_NE(reason(entries).find("holds no case"), std::string::npos);
  fs::create_directories(folder / "a");
  write_text(folder / "a/case.txt", "MR = x.nrrd\n");
  write_text(folder / "b.case", "PRESET = small\n");
  ASSERT_EQ(entries().size(), 2u);
  EXPECT_EQ(entries()[0].name, "a");
  EXPECT_FALSE(entries()[0].phantom);
  EXPECT_TRUE(entries()[1].phantom);
  write_text(folder / "a.case", "MR = y.nrrd\n");
  EXPECT_NE(reason(entries).find("two case files are called a"), std::string::npos);
  fs::rename(folder / "a.case", folder / "c d.case");
  EXPECT_NE(reason(entries).find("c?d.case: a name with such characters is refused"),
            std::string::npos);
  fs::rename(folder / "c d.case", folder / "c.case");
  write_text(folder / "c.case", "SIDE = left\n");
  write_text(folder / "d.case", "MRI = left\n");
  EXPECT_NE(reason(entries).find("c.case: names neither MR nor PRESET"), std::string::npos);
  EXPECT_NE(reason(entries).find("did you mean MR?"), std::string::npos) << "all problems at once";
}

TEST(CaseRuns, SayWhyWithoutFolders) {
  EXPECT_EQ(
      reason_of(
          "make: *** No rule to make target '/secret/x.nrrd', needed by 'runs/n/labels.vtkhdf'.  Stop.\n",
          "runs"),
      "'x.nrrd', which a setting names, does not exist");
  EXPECT_EQ(
      reason_of(
          "make[1]: Entering\nforward: no body in runs/n/supine.vtkhdf\nforward: give up\nmake: *** [x] Error 3\n",
          "runs"),
      "forward: give up");
  EXPECT_EQ(reason_of("forward: no body in runs/n/supine.vtkhdf\n", "runs"),
            "forward: no body in n/supine.vtkhdf");
  EXPECT_EQ(reason_of("make[2]: *** pipelines/x.mk:3: *** SIDE: 'a' is none.  Stop.\n", "runs"),
            "pipelines/x.mk:3: *** SIDE: 'a' is none");
  EXPECT_EQ(reason_of("", "runs"), "");
}

TEST(CaseRuns, KeepWhatBecameOfTheCase) {
  const ScratchFolder folder;
  const fs::path status = folder / "n.status", log = folder / "n.log";
  EXPECT_TRUE(
      run_case({status, log, false, {"sh", "-c", "echo forward: no body; exit 3", "summary"}}));
  EXPECT_EQ(read_text(status), "failed\tforward: no body\n");
  EXPECT_FALSE(is_done(status));
  EXPECT_TRUE(run_case({status, log, true, {"echo", "made", "summary"}}));
  EXPECT_EQ(read_text(log), "made phantom-scan\nmade summary\n") << "its phantom's scan first";
  EXPECT_TRUE(is_done(status));
  EXPECT_FALSE(run_case({status, log, false, {"sh", "-c", "kill -TERM $$"}}));
  EXPECT_NE(read_text(status).find("stopped by a signal"), std::string::npos);
}

TEST(Attempts, KeepTheReasonOfASolveThatEndsEarly) {
  const ScratchFolder folder;
  const fs::path report = folder / "supine.json";
  const std::string file = report.string();
  const auto solve = [&](const std::string& script, const std::vector<fs::path>& inputs = {}) {
    return reason([&] { attempt(report, inputs, {"sh", "-c", script}); });
  };
  write_text(folder / "supine.vtkhdf", "of an earlier attempt");
  EXPECT_EQ(solve("echo '{\"reason\": \"folded\"}' > " + file + "; exit 3"), "");
  EXPECT_NE(read_text(report).find("folded"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder / "supine.vtkhdf"));
  EXPECT_NE(solve("exit 3").find("exit code 3"), std::string::npos) << "not even a report";
  EXPECT_NE(solve("echo x > " + file + "; exit 2").find("exit code 2"), std::string::npos);
  EXPECT_EQ(solve("true"), "");
  EXPECT_NE(read_text(report).find("\"ok\""), std::string::npos) << "of somebody else's program";
  write_text(folder / "reference.json", "no body");
  EXPECT_EQ(solve("exit 1", {folder / "reference.vtkhdf"}), "");
  EXPECT_EQ(read_text(report), "no body") << "what needed it has the same reason";
}

TEST(Ladders, EndAtTheFirstRungThatIsGoodEnough) {
  const ScratchFolder folder;
  // A stub of tabulate that prints the row of a point: the first has no solution, the last meets
  // the bound.
  const fs::path judge = folder / "judge";
  write_text(judge,
             "#!/bin/sh\ncase $3 in\n*-4) ;;\n*-8) printf '%s\\t%s\\tyes\\n' $3 \"$5\" ;;\n"
             "*) printf '%s\\t%s\\tno\\n' $3 \"$5\" ;;\nesac\n");
  fs::permissions(judge, fs::perms::owner_all);
  const auto up = [&](const std::vector<std::string>& points) {
    return climb({folder.path(), "0.5", points, {judge.string()}, {"true"}});
  };
  EXPECT_EQ(up({"q1p0-dome-4", "q2p1-dome-6", "q1p0-dome-8", "q1p0-dome-10"}),
            "point\telements\tstress_free_estimate_mm\tsupine_estimate_mm\tcpu_s\tmeets\n"
            "q2p1-dome-6\t\tno\nq1p0-dome-8\tq2p1-dome-6\tyes\n");
  EXPECT_EQ(read_text(folder / "accuracy.mk"), "ELEMENTS := 8\nELEMENT := q1p0\n");
  EXPECT_NE(up({"q2p1-dome-6"}).find("not met"), std::string::npos);
  EXPECT_EQ(read_text(folder / "accuracy.mk"), "ELEMENTS := 6\nELEMENT := q2p1\n");
  EXPECT_NE(reason([&] { up({"q1p0-dome-4"}); }).find("no mesh of the ladder"), std::string::npos);
}

StudyBase base() {
  return {"run",
          {"mesh", "reference", "supine", "cc"},
          "supine cc",
          {"hexmesh", "mechanics", "materials"},
          {{"hexmesh", "--elements 16"},
           {"mechanics", "--materials seed --element q1p0"},
           {"materials", "seed"}},
          {{"RUN", "run"}, {"tumour", "{tumour}"}}};
}
std::string expanded(const std::string& table) {
  Studies studies(base());
  studies.add("own", table, "own.tsv");
  std::string text = studies.text();
  std::replace(text.begin(), text.end(), make_line_end, '\n');
  return text;
}
bool has_line(const std::string& text, const std::string& line) {
  return ("\n" + text).find("\n" + line + "\n") != std::string::npos;
}

TEST(Variants, AddReplaceAndInheritOptions) {
  const std::string text = expanded(
      "# why\nvariant\tfrom\tstarts_at\tends_at\thexmesh\tmechanics\tmaterials\tif\n"
      "soft\t-\treference\tsupine\t-\t+--scale fat=50\t{RUN}/own.tsv\t-\n"
      "fine\tsoft\tmesh\t-\t--tumour {tumour}:0.1\t-\t-\tsoft\n");
  EXPECT_TRUE(has_line(text, "own_variants += soft")) << text;
  EXPECT_TRUE(has_line(text, "run/studies/own/soft@stages :=  reference supine cc")) << text;
  EXPECT_TRUE(has_line(text, "run/studies/own/soft@ends_at := supine"));
  EXPECT_TRUE(has_line(text, "run/studies/own/soft@hexmesh := --elements 16"));
  EXPECT_TRUE(has_line(
      text,
      "run/studies/own/soft@mechanics := --materials run/own.tsv --element q1p0 --scale fat=50"));
  EXPECT_TRUE(has_line(text, "run/studies/own/fine@from := run/studies/own/soft"));
  EXPECT_TRUE(has_line(
      text,
      "run/studies/own/fine@mechanics := --materials run/own.tsv --element q1p0 --scale fat=50"));
  EXPECT_TRUE(has_line(text, "run/studies/own/fine@hexmesh := --tumour {tumour}:0.1"));
  EXPECT_TRUE(has_line(text, "run/studies/own/fine@ends_at := supine cc"));
  EXPECT_TRUE(has_line(text, "run/studies/own/fine@if := run/studies/own/soft"));
}

TEST(Variants, SayWhichOptionsACellWithoutPlusLeavesOut) {
  const std::string text = expanded(
      "variant\tfrom\tstarts_at\thexmesh\tmechanics\n"
      "soft\t-\treference\t-\t--scale fat=50\n"
      "kept\t-\treference\t-\t+--scale fat=50\n"
      "both\tkept\tmesh\t--tumour none\t--materials other --element=q2p1\n"
      "all\t-\tmesh\t--elements 20\t--element q2p1 --materials other\n");
  EXPECT_TRUE(
      has_line(text, "run/studies/own/soft@drops := mechanics: --materials seed --element q1p0"))
      << text;
  EXPECT_TRUE(has_line(
      text, "run/studies/own/both@drops := hexmesh: --elements 16; mechanics: --scale fat=50"))
      << text;
  EXPECT_EQ(text.find("kept@drops"), std::string::npos) << text;
  EXPECT_EQ(text.find("all@drops"), std::string::npos) << text;
}

TEST(Variants, ComeFromRowsOfOtherStudies) {
  Studies studies(base());
  studies.add("scaled", "variant\tstarts_at\tmechanics\nx\treference\t+--a\n", "scaled.tsv");
  studies.add(
      "again",
      "variant\tfrom\tstarts_at\tmechanics\ny\tscaled/x\tsupine\t+--b\nz\t-\tsupine\t+--c\n",
      "again.tsv", "scaled/x");
  EXPECT_NE(studies.text().find("again/y@mechanics := --materials seed --element q1p0 --a --b"),
            std::string::npos);
  EXPECT_NE(studies.text().find("again/z@mechanics := --materials seed --element q1p0 --a --c"),
            std::string::npos)
      << "the study's own base";
}

TEST(Variants, AreRefusedByColumnStageAndRow) {
  const auto refused = [](const std::string& table) { return reason([&] { expanded(table); }); };
  EXPECT_EQ(refused("variant\tstarts_at\tmechanic\nx\tmesh\t-\n"),
            "own.tsv: 'mechanic' is none of variant, starts_at, ends_at, from, given, if, hexmesh, "
            "mechanics, materials; did you mean mechanics?");
  EXPECT_NE(refused("variant\tstarts_at\nx\trefference\n").find("did you mean reference?"),
            std::string::npos);
  EXPECT_EQ(
      refused("variant\tstarts_at\nx\t-\n"),
      "own.tsv: x does not say in the column starts_at at which stage it begins; write one of mesh, reference, supine, cc");
  EXPECT_EQ(
      refused("variant\tfrom\tstarts_at\nx\ty\tmesh\n"),
      "own.tsv: x comes from 'y', and no row above has this name; write the row from which it comes above it");
  EXPECT_EQ(
      refused("variant\tstarts_at\tfrom\nx\tmesh\n"),
      "own.tsv: x has 2 cells and not 3; separate cells by one tab, and write - for an empty one");
  EXPECT_EQ(refused("variant\tstarts_at\nx\tmesh cc\n"),
            "own.tsv: 'mesh cc' is none of mesh, reference, supine, cc");
  // The byte that ends a line of make would begin another assignment.
  EXPECT_EQ(refused("variant\tstarts_at\tmechanics\nx\tmesh\ta\x1eSHELL := b\r\n"),
            "own.tsv: x holds a control character");
  for (const std::string name : {"x", "a/b", "a b", "-"})
    EXPECT_NE(refused("variant\tstarts_at\nx\tmesh\n" + name + "\tmesh\n")
                  .find("is no name of a row of its own"),
              std::string::npos)
        << name;
  for (const std::string code : {"$(shell x)", "`x`", "; x", "{MR}", "{shell}"})
    EXPECT_NE(refused("variant\tstarts_at\tmechanics\nx\tmesh\t" + code + "\n")
                  .find("may not stand in a study, because make or a shell would read it as code; "
                        "write the cell without it ({NAME} is one of RUN, tumour)"),
              std::string::npos)
        << code;
}

TEST(Slurm, ScriptsAskForWhatTheLargestCaseNeeds) {
  const ScratchFolder folder;
  write_text(folder / "cost.tsv", "element\telements\tcpu_seconds\tpeak_mb\nq1p0\t16\t200\t380\n");
  write_text(folder / "a.case", "MR = x.nrrd\n  ELEMENTS = 32\n");
  write_text(folder / ".cases", "a\t" + (folder / "a.case").string() + "\tscan\n");
  SlurmRequest request;
  request.runs = folder.path();
  request.program = "/opt/it's/cases";
  request.cost = folder / "cost.tsv";
  // The measured cost.tsv of a cohort is used only after three cases are done; here the assumed one
  // is.
  fs::rename(folder / "cost.tsv", folder / "assumed.tsv");
  request.cost = folder / "assumed.tsv";
  const std::string plan = slurm_plan(request);
  EXPECT_NE(plan.find("# sbatch --array=0-0 "), std::string::npos) << plan;
  EXPECT_NE(plan.find("\n#SBATCH --time=165\n"), std::string::npos) << plan;
  EXPECT_NE(plan.find("ELEMENTS=32"), std::string::npos) << plan;
  EXPECT_NE(plan.find("'/opt/it'\\''s/cases' task "), std::string::npos) << plan;
  EXPECT_EQ(plan.find("--partition"), std::string::npos);
  // As large as a case file may be: blanks, and more elements than hexmesh makes.
  write_text(folder / "a.case", std::string(60000, ' ') +
                                    "\nELEMENT=q2p1\n  ELEMENTS = " + std::string(400, '9') + "\n");
  write_text(folder / "assumed.tsv",
             "element\telements\tcpu_seconds\tpeak_mb\nq1p0\t16\t200\t380\nq2p1\t64\t600\t380\n");
  EXPECT_NE(slurm_plan(request).find("\n#SBATCH --time=35\n"), std::string::npos);
  write_text(folder / "a.case", "ELEMENTS = 1e9\n");
  EXPECT_NE(slurm_plan(request).find("q1p0, ELEMENTS=64: "), std::string::npos);
  request.partition = "long";
  request.time = "2:00:00";
  const std::string asked = slurm_plan(request);
  EXPECT_NE(asked.find("\n#SBATCH --partition=long\n"), std::string::npos) << asked;
  EXPECT_NE(asked.find("\n#SBATCH --time=2:00:00\n"), std::string::npos) << asked;
  EXPECT_NE(asked.find("; time as asked"), std::string::npos) << asked;
  write_text(folder / ".cases", "a\tb\n");
  EXPECT_NE(reason([&] { slurm_plan(request); }).find("is no case"), std::string::npos);
}

}  // namespace
}  // namespace breast
