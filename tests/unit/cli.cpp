// SPDX-License-Identifier: GPL-3.0-or-later
// A declared tool: parsing, checks before any file is opened, exit codes, history, report.
#include <gtest/gtest.h>

#include <new>
#include <stdexcept>

#include "cli/mechanics_options.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "fixtures/scratch_folder.hpp"

namespace breast {
namespace {

// One run of a small tool inside this process.
struct Trial {
  ScratchFolder folder;
  std::filesystem::path in, out, table;
  std::vector<double> gravity{0, -9810, 0};
  std::string posture = "prone";
  double skin = 2;
  std::optional<double> force;
  MechanicsChoices choices;
  std::function<void(Run&)> body = [](Run&) {};
  std::function<void(Tool&)> more = [](Tool&) {};  // declarations
  std::string err, stdout_text;
  bool ran = false;

  Trial() { write_text(folder / "mesh.vtkhdf", "mesh"); }

  int run(std::vector<std::string> arguments) {
    Tool tool("trial", "tries the common face");
    tool.input(in, "MESH.vtkhdf", "mesh").output(out, "OUT.vtkhdf", "result");
    tool.numbers(gravity, "--gravity", "gx,gy,gz", 3, "mm/s2");
    tool.choice(posture, "--posture", {"prone", "supine"}, "posture");
    tool.number(skin, "-t,--skin", "MM", "thickness", 0, 40);
    tool.number(force, "--force", "N", "force", 0, 500);
    tool.output_file(table, "--table", "FILE.tsv", "table");
    declare_mechanics(tool, choices, "MESH");
    more(tool);
    tool.check([this] {
      if (skin == 13) throw input_error("--skin 13: unlucky");
    });
    arguments.insert(arguments.begin(), "trial");
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    const int code = tool.main(int(argv.size()), argv.data(), [this](Run& r) {
      ran = true;
      body(r);
    });
    err = testing::internal::GetCapturedStderr();
    stdout_text = testing::internal::GetCapturedStdout();
    return code;
  }
  std::string mesh() const { return (folder / "mesh.vtkhdf").string(); }
  std::string result() const { return (folder / "out.vtkhdf").string(); }
  std::string report() const { return (folder / "report.json").string(); }
};

TEST(Cli, ValuesReachTheirVariables) {
  Trial trial;
  EXPECT_EQ(trial.run({trial.mesh(), "--gravity", "-1,2.5,-3e2", trial.result(), "-t", "1.5",
                       "--force=90", "--posture", "supine", "--scale", "fat=150", "--scale",
                       "skin=50", "--element", "q2p1", "--bulk-ratio", "1000"}),
            0)
      << trial.err;
  EXPECT_TRUE(trial.ran);
  EXPECT_EQ(trial.in, trial.mesh());
  EXPECT_EQ(trial.gravity, (std::vector<double>{-1, 2.5, -300}));
  EXPECT_EQ(trial.skin, 1.5);
  EXPECT_EQ(trial.force, 90);
  EXPECT_EQ(trial.posture, "supine");
  EXPECT_EQ(trial.choices.scale, (std::vector<std::string>{"fat=150", "skin=50"}));
  EXPECT_EQ(trial.choices.element, "q2p1");
  EXPECT_EQ(trial.choices.bulk_ratio, "1000");
  EXPECT_EQ(trial.err, "");
}

TEST(Cli, UsageErrorsAreOneLineAndNothingRuns) {
  const std::pair<std::vector<std::string>, std::string> wrong[] = {
      {{"--postur", "prone"}, "did you mean '--posture'?"},
      {{"--posture", "pron"}, "did you mean 'prone'?"},
      {{"--posture", "sitting"}, "'sitting' is none of prone, supine"},
      {{"--gravity", "1,2"}, "has 2 numbers; give 3 as gx,gy,gz"},
      {{"--gravity", "1,2,x"}, "'x' is not a finite number"},
      {{"--gravity"}, "--gravity needs a value"},
      {{"--skin", "41"}, "--skin 41: must be 0 to 40"},
      {{"--skin", "nan"}, "'nan' is not a finite number"},
      {{"--skin", "1", "--skin", "2"}, "given 2 times"},
      {{"--skin", "13"}, "unlucky"},
      {{"--scale", "fat"}, "not of the form TISSUE=PERCENT"},
      {{"--scale", "gland=3"}, "unknown tissue 'gland'"},
      {{"--scale", "fat=-3"}, "above 0"},
      {{"--scale", "fat=1.5"}, "did you mean fat=150?"},
      {{"--scale", "tumour=2"}, "did you mean tumour=200?"},
      {{"--threads", "1.5"}, "not a whole number"},
      {{"extra"}, "one argument too many"},
      {{"--table", "/no-such-folder/t.tsv"}, "does not exist"}};
  for (const auto& [arguments, part] : wrong) {
    Trial trial;
    std::vector<std::string> all = {trial.mesh(), trial.result()};
    all.insert(all.end(), arguments.begin(), arguments.end());
    EXPECT_EQ(trial.run(all), 2) << part;
    EXPECT_FALSE(trial.ran) << part;
    EXPECT_EQ(std::count(trial.err.begin(), trial.err.end(), '\n'), 1) << trial.err;
    EXPECT_NE(trial.err.find(part), std::string::npos) << trial.err << " lacks " << part;
  }
}

TEST(Cli, HelpIsShortAndFullHelpIsByTopic) {
  Trial t;
  t.more = [](Tool& tool) {
    tool.describe("How it works.");
    tool.required("--skin");
    tool.topic("loads", {"--gravity", "--force"});
    tool.basic({"--force", "--materials"});
  };
  ASSERT_EQ(t.run({"--help"}), 0);
  const std::string brief = t.stdout_text;
  ASSERT_EQ(t.run({"--help-all"}), 0);
  const std::string full = t.stdout_text;
  const auto has = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  for (const char* option :
       {"\n  -t, --skin MM\n", "\n  --force N\n", "\n  --materials NAME|FILE\n"})
    EXPECT_TRUE(has(brief, option)) << option << brief;
  for (const char* part : {"How it works.", "--gravity", "--solver", "Exit codes:"})
    EXPECT_TRUE(!has(brief, part) && has(full, part)) << part;
  EXPECT_TRUE(
      has(brief, "\ntrial --help-all shows 14 further options by topic: loads, model, solver\n"))
      << brief;
  std::size_t at = 0;
  for (const char* title : {"\nOptions: loads:\n  --gravity gx,gy,gz\n", "\nOptions:\n",
                            "\nOptions: model:\n", "\nOptions: solver:\n", "\nCommon options:\n"}) {
    at = full.find(title, at);
    EXPECT_NE(at, std::string::npos) << title << full;
  }
}

TEST(Cli, AnOptionHasOneTopic) {
  for (const std::vector<std::string>& wrong :
       {std::vector<std::string>{"--solver"}, {"--no-such"}}) {
    Trial t;
    t.more = [&wrong](Tool& tool) { tool.topic("loads", wrong); };
    EXPECT_THROW(t.run({"--help"}), Error) << wrong.front();
  }
}

TEST(Cli, AMissingFileOfTheChainNamesItsProgram) {
  Trial trial;
  EXPECT_EQ(trial.run({"/no-such-folder/reference.vtkhdf", trial.result()}), 2);
  EXPECT_NE(trial.err.find("reference.vtkhdf does not exist; `backward` makes it\n"),
            std::string::npos)
      << trial.err;
}

// A gravity in m/s2 or in multiples of the earth's is refused before anything is solved.
TEST(Cli, AGravityInAnotherUnitIsAskedAbout) {
  const auto refusal = [](const std::function<void()>& parse) {
    try {
      parse();
    } catch (const Error& error) {
      EXPECT_EQ(error.exit_code(), 2);
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  const auto parsed = [&](const char* text) { return refusal([&] { parse_gravity(text); }); };
  EXPECT_NE(parsed("0,0,-9.81").find("did you mean 0,0,-9810?"), std::string::npos);
  EXPECT_NE(parsed("0,1,0").find("did you mean 0,9810,0?"), std::string::npos);
  for (const char* large : {"0,98100,0", "0,0,-1e300", "1e308,1e308,1e308"})
    EXPECT_NE(parsed(large).find("mm/s2 is above 19620"), std::string::npos) << parsed(large);
  for (const char* fine : {"0,0,-9810", "0,0,0", "0,0,-1620", "50,0,0", "off", "upright"}) {
    EXPECT_EQ(parsed(fine), "accepted") << fine;
  }
  ScratchFolder folder;
  write_text(folder / "mesh.vtkhdf", "mesh");
  std::filesystem::path in;
  GravityChoices gravity{"supine", {}};
  Tool tool("trial", "tries gravity");
  tool.input(in, "MESH.vtkhdf", "mesh");
  declare_gravity(tool, gravity, "direction");
  std::vector<std::string> words = {"trial", (folder / "mesh.vtkhdf").string(), "--gravity",
                                    "0,0,-9.81"};
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  testing::internal::CaptureStderr();
  bool ran = false;
  EXPECT_EQ(tool.main(int(argv.size()), argv.data(), [&](breast::Run&) { ran = true; }), 2);
  const std::string err = testing::internal::GetCapturedStderr();
  EXPECT_FALSE(ran);
  EXPECT_NE(err.find("did you mean 0,0,-9810?"), std::string::npos) << err;
}

TEST(Cli, PathsAreCheckedBeforeAnythingRuns) {
  Trial trial;
  EXPECT_EQ(trial.run({trial.mesh()}), 2);
  EXPECT_NE(trial.err.find("OUT.vtkhdf is missing"), std::string::npos) << trial.err;
  EXPECT_EQ(trial.run({(trial.folder / "absent").string(), trial.result()}), 2);
  EXPECT_EQ(trial.run({trial.mesh(), trial.mesh()}), 2);
  EXPECT_EQ(trial.run({trial.mesh(), trial.folder.path().string()}), 2);
  EXPECT_EQ(trial.run({trial.mesh(), trial.result(), "--table", trial.result()}), 2);
  EXPECT_EQ(trial.run({trial.mesh(), trial.result(), "--report", trial.mesh()}), 2);
  EXPECT_EQ(read_text(trial.mesh()), "mesh");  // a report never replaces an input
  EXPECT_FALSE(trial.ran);
}

TEST(Cli, AnEndingThatIsNotTheFormatsIsRefused) {
  Trial trial;
  for (const char* name : {"notes.txt", "x.dcm", "README.md", "vtkhdf", ".vtkhdf"}) {
    EXPECT_EQ(trial.run({trial.mesh(), (trial.folder / name).string()}), 2) << name;
    EXPECT_NE(trial.err.find(".vtkhdf"), std::string::npos) << trial.err;
  }
  EXPECT_EQ(
      trial.run({trial.mesh(), trial.result(), "--report", (trial.folder / "r.txt").string()}), 2);
  EXPECT_FALSE(trial.ran);
  EXPECT_EQ(trial.run({trial.mesh(), (trial.folder / "OUT.VTKHDF").string()}), 0);
}

TEST(Cli, AnotherProgramsFileIsNotReplaced) {
  Trial trial;
  write_text(trial.result(), "years of work");
  EXPECT_EQ(trial.run({trial.mesh(), trial.result()}), 2);
  EXPECT_NE(trial.err.find("not replaced"), std::string::npos) << trial.err;
  std::filesystem::remove(trial.result());
  write_text(trial.report(), "{\"name\": 1}");
  EXPECT_EQ(trial.run({trial.mesh(), trial.result(), "--report", trial.report()}), 2);
  EXPECT_EQ(trial.run({trial.mesh(), "--report", trial.report()}), 2);  // usage error
  EXPECT_EQ(read_text(trial.report()), "{\"name\": 1}");
  EXPECT_FALSE(trial.ran);
}

TEST(Cli, AFileNamedByAnyArgumentIsNotAlsoAnOutput) {
  Trial trial;
  const std::string table = (trial.folder / "fat.tsv").string();
  write_text(table, "a\n1\n\r\n");
  EXPECT_EQ(trial.run({trial.mesh(), trial.result(), "--materials", table, "--table", table}), 2);
  EXPECT_NE(trial.err.find("--materials"), std::string::npos) << trial.err;
  EXPECT_EQ(trial.run({trial.folder.path().string(), trial.result()}), 2);  // in an input folder
  EXPECT_FALSE(trial.ran);
}

TEST(Cli, DevicesAreNoFilesToReplaceNorToRead) {
  Trial trial;
  const std::string null = "/dev/null";
  EXPECT_EQ(trial.run({trial.mesh(), null, "--report", null, "--table", null}), 0);
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  EXPECT_EQ(trial.run({"/dev/zero", trial.result()}), 2);
}

TEST(Cli, EveryFailureHasItsExitCodeAndReport) {
  const std::tuple<std::function<void()>, int, std::string> failures[] = {
      {[] { throw input_error("bad\nfile"); }, 2, "bad_input"},
      {[] { throw failed_error("disk"); }, 1, "failed"},
      {[] { throw not_converged_error("residual 1"); }, 3, "not_converged"},
      {[] { throw std::bad_alloc(); }, 1, "failed"},
      {[] { throw std::runtime_error("library\nsays so"); }, 1, "failed"}};
  for (const auto& [failure, code, status] : failures) {
    Trial trial;
    trial.body = [&failure](breast::Run& run) {
      run.print("half a table");
      run.warn("dropped on failure");
      failure();
    };
    EXPECT_EQ(trial.run({trial.mesh(), trial.result(), "--report", trial.report()}), code);
    EXPECT_EQ(std::count(trial.err.begin(), trial.err.end(), '\n'), 1) << trial.err;
    EXPECT_EQ(trial.err.find("trial: "), 0u);
    EXPECT_EQ(trial.stdout_text, "");
    const Report report = Report::parse(read_text(trial.report()), "report");
    EXPECT_EQ(report.text("status"), status);
    EXPECT_NE(report.text("reason"), "");
    EXPECT_GT(report.number("peak_mb"), 0);
    EXPECT_GE(report.number("seconds/total"), 0);
  }
}

TEST(Cli, AReportNamesFilesWithoutTheirFolders) {
  Trial trial;
  const std::filesystem::path mesh = trial.mesh();
  trial.body = [&mesh](breast::Run&) { throw input_error(mesh.string(), ": is damaged"); };
  EXPECT_EQ(trial.run({mesh.string(), trial.result(), "--report", trial.report()}), 2);
  EXPECT_EQ(trial.err, "trial: " + mesh.string() + ": is damaged\n");
  EXPECT_EQ(Report::parse(read_text(trial.report()), "report").text("reason"),
            mesh.filename().string() + ": is damaged");
}

TEST(Cli, SuccessReportsAndPrints) {
  Trial trial;
  trial.body = [](breast::Run& run) {
    run.print("a\tb\n");
    run.warn("look here");
    run.report().set("status", "stopped_early");
    const Timer::Scope phase(run.timer(), "assembly");
  };
  EXPECT_EQ(trial.run({trial.mesh(), trial.result(), "--report", trial.report()}), 0);
  EXPECT_EQ(trial.stdout_text, "a\tb\n");
  EXPECT_EQ(trial.err, "trial: warning: look here\n");
  const Report report = Report::parse(read_text(trial.report()), "report");
  EXPECT_EQ(report.text("status"), "stopped_early");
  EXPECT_TRUE(report.contains("seconds/assembly"));
  EXPECT_EQ(trial.run({trial.mesh(), trial.result(), "--quiet"}), 0);
  EXPECT_EQ(trial.err, "");
}

TEST(Cli, HistoryNamesFilesWithoutFoldersAndNotHowItRan) {
  Trial trial;
  History history;
  const History earlier = {{"hexmesh", "1", "hexmesh a b c", {}}};
  trial.body = [&](breast::Run& run) { history = run.history({{trial.in, "abc", &earlier}}); };
  EXPECT_EQ(trial.run({trial.mesh(), "--report", trial.report(), trial.result(), "--threads=1",
                       "--quiet", "--materials", "/some/where/fat.tsv", "--skin=3"}),
            0)
      << trial.err;
  ASSERT_EQ(history.size(), 2u);
  EXPECT_EQ(history[1].command, "trial mesh.vtkhdf out.vtkhdf --materials fat.tsv --skin=3");
  ASSERT_EQ(history[1].inputs.size(), 1u);
  EXPECT_EQ(history[1].inputs[0].name, "mesh.vtkhdf");
  EXPECT_EQ(history[1].inputs[0].sha256, "abc");
}

}  // namespace
}  // namespace breast
