// SPDX-License-Identifier: GPL-3.0-or-later
// The pieces of the command `breast`: names for make, its stand-ins, what was asked for.
#include <gtest/gtest.h>

#include <fstream>

#include "command/commands.hpp"
#include "command/make_name.hpp"
#include "command/request.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "fixtures/scratch_folder.hpp"

namespace breast {
namespace {

namespace fs = std::filesystem;

// The test runs in a folder of its own, as a caller does.
struct InFolder {
  ScratchFolder folder;
  fs::path before = fs::current_path();
  InFolder() { fs::current_path(folder.path()); }
  ~InFolder() { fs::current_path(before); }
};

void touch(const fs::path& file) {
  if (file.has_parent_path()) fs::create_directories(file.parent_path());
  std::ofstream(file) << "scan";
}

TEST(MakeName, PlainNames) {
  for (const char* name : {"scan.nrrd", "/data/a-b_c.1/scan@2,3+4", "été.nrrd", "乳房/画像.nii.gz"})
    EXPECT_TRUE(plain_for_make(name)) << name;
  for (const char* name :
       {"a b", "a'b", "a\"b", "a(b)", "a=b",  "a:b", "a%b",  "a$b",       "a`b",     "a;b",
        "a|b", "a&b", "a<b",  "a>b",  "a*b",  "a?b", "a[b]", "a{b}",      "a#b",     "a\\b",
        "a!b", "a^b", "a~b",  "a\nb", "a\tb", "-a",  "",     "\xe9t\xe9", "\xc0\xaf"})
    EXPECT_FALSE(plain_for_make(name)) << name;
}

TEST(MakeName, EveryNameHasAPlainOne) {
  EXPECT_EQ(plain_name("my scan (1).nrrd"), "my_scan__1_.nrrd");
  EXPECT_EQ(plain_name("été 2.nrrd"), "été_2.nrrd");
  EXPECT_EQ(plain_name("\xe9.nrrd"), "_.nrrd");
  EXPECT_EQ(plain_name("-x"), "_x");
}

TEST(MakeName, PlainFilesAreNamedAsGiven) {
  const InFolder here;
  touch("scan.nrrd");
  touch("sub/scan.nrrd");
  EXPECT_EQ(name_for_make("scan.nrrd", "runs/.names"), "scan.nrrd");
  EXPECT_EQ(name_for_make("sub/scan.nrrd", "runs/.names"), "sub/scan.nrrd");
  EXPECT_EQ(name_for_make("sub/", "runs/.names"), "sub");
  EXPECT_FALSE(fs::exists("runs"));
  EXPECT_THROW(name_for_make("missing.nrrd", "runs/.names"), Error);
}

TEST(MakeName, StandInsLeadToTheFile) {
  const InFolder here;
  touch("my scan [a]'s.nrrd");
  const std::string name = name_for_make("my scan [a]'s.nrrd", "runs/.names");
  EXPECT_TRUE(plain_for_make(name)) << name;
  EXPECT_EQ(fs::path(name).filename(), "my_scan__a__s.nrrd");
  EXPECT_TRUE(fs::equivalent(name, "my scan [a]'s.nrrd"));
  EXPECT_EQ(name_for_make("./my scan [a]'s.nrrd", "runs/.names"), name)
      << "the same for the same file";
  touch("other/my scan [a]'s.nrrd");
  EXPECT_NE(name_for_make("other/my scan [a]'s.nrrd", "runs/.names"), name)
      << "another for another";
}

// A detached header keeps its data beside it; without a plain name of its own that cannot be.
TEST(MakeName, DetachedHeaders) {
  const InFolder here;
  touch("my scans/scan.nhdr");
  touch("my scans/scan.raw");
  const std::string name = name_for_make("my scans/scan.nhdr", "runs/.names");
  EXPECT_TRUE(plain_for_make(name)) << name;
  EXPECT_TRUE(fs::exists(fs::path(name).parent_path() / "scan.raw"));
  touch("my scan.mhd");
  EXPECT_THROW(name_for_make("my scan.mhd", "runs/.names"), Error);
}

TEST(MakeName, FoldersOfSlices) {
  const InFolder here;
  touch("series 1/IM (1).dcm");
  touch("series 1/IM_2.dcm");
  const std::string name = name_for_make("series 1", "runs/.names");
  EXPECT_TRUE(plain_for_make(name)) << name;
  EXPECT_EQ(fs::path(name).filename(), "series_1");
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator(name)) {
    EXPECT_TRUE(plain_for_make(entry.path().filename().string())) << entry.path();
    EXPECT_TRUE(fs::is_regular_file(entry.path()));
    ++count;
  }
  EXPECT_EQ(count, 2u);
  fs::remove("series 1/IM_2.dcm");
  name_for_make("series 1", "runs/.names");
  EXPECT_EQ(std::distance(fs::directory_iterator(name), fs::directory_iterator()), 1)
      << "a slice that went is gone";
  touch("plain/IM_1.dcm");
  EXPECT_EQ(name_for_make("plain", "runs/.names"), "plain");
}

TEST(Request, OptionsAndSettings) {
  const InFolder here;
  touch("A=b.nrrd");
  const PipelineRequest r =
      parse_request("run", {"A=b.nrrd", "--side", "right", "TUMOUR=-60,-40,12", "--runs", "/data",
                            "REDUCTION=40", "--jobs", "2"});
  EXPECT_EQ(r.scan, "A=b.nrrd");
  EXPECT_EQ(r.side, "right");
  EXPECT_EQ(r.runs, "/data");
  EXPECT_EQ(r.jobs, 2);
  EXPECT_EQ(r.target, "summary");
  EXPECT_EQ(r.settings,
            (std::map<std::string, std::string>{{"REDUCTION", "40"}, {"TUMOUR", "-60,-40,12"}}));
  EXPECT_EQ(parse_request("demo", {"PRESET=paper"}).settings.at("PRESET"), "paper");
  EXPECT_EQ(parse_request("cohort", {"patients"}).target, "cohort");
}

TEST(Request, OfACluster) {
  const PipelineRequest r =
      parse_request("cohort", {"patients", "--slurm", "--partition", "long", "--time", "2:00:00",
                               "--cores", "2", "--memory", "900", "--account", "a", "--resume"});
  EXPECT_TRUE(r.slurm);
  EXPECT_EQ(r.settings, (std::map<std::string, std::string>{{"CLUSTER", "slurm"},
                                                            {"CLUSTER_ACCOUNT", "a"},
                                                            {"CLUSTER_CORES", "2"},
                                                            {"CLUSTER_MEMORY", "900"},
                                                            {"CLUSTER_PARTITION", "long"},
                                                            {"CLUSTER_TIME", "2:00:00"},
                                                            {"RESUME", "1"}}));
  EXPECT_TRUE(parse_request("cohort", {"patients", "--local"}).settings.empty());
}

TEST(Request, WhatIsWrongIsSaid) {
  const std::pair<std::vector<std::string>, std::string> wrong[] = {
      {{"run", "scan"}, "--side left|right is missing"},
      {{"run", "--side", "left"}, "SCAN is missing"},
      {{"run", "scan", "--side", "lefft"}, "did you mean 'left'"},
      {{"run", "scan", "--sid", "left"}, "did you mean '--side'"},
      {{"run", "scan", "more", "--side", "left"}, "'more' is one argument too many"},
      {{"run", "scan", "--side", "left", "SIDE=right"}, "contradict"},
      {{"run", "scan", "--side", "left", "PRESET=a", "PRESET=b"}, "PRESET is given twice"},
      {{"run", "scan", "--side", "left", "RUNS=x"}, "--runs DIR"},
      {{"run", "scan", "--side", "left", "MR=x"}, "MR is not a setting here"},
      {{"run", "scan", "--side", "left", "--target", "a b"}, "not the name of a target"},
      {{"run", "scan", "--side", "left", "--jobs", "0"}, "--jobs 0"},
      {{"demo", "scan.nrrd"}, "one argument too many"},
      {{"demo", "MR=scan.nrrd"}, "breast run SCAN"},
      {{"cohort", "patients", "--slurm", "--local"}, "contradict"},
      {{"cohort", "patients", "--time", "5"}, "give --slurm"},
      {{"cohort", "patients", "--slurm", "--jobs", "2"}, "give --cores"},
      {{"cohort", "patients", "--slurm", "--time", "5", "CLUSTER_TIME=6"}, "both given"},
      {{"run", "scan", "--side", "left", "--slurm"}, "--slurm"},
      {{"cohort"}, "DIR is missing"}};
  for (const auto& [words, part] : wrong) {
    try {
      parse_request(words.front(), {words.begin() + 1, words.end()});
      ADD_FAILURE() << part;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input);
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  }
}

TEST(Commands, NearestNames) {
  Installation here;
  here.tools = {{"forward", ""}, {"backward", ""}, {"segment", ""}};
  EXPECT_EQ(unknown_command(here, "segmnt"),
            "'segmnt' is neither a command nor a tool; did you mean 'segment'?");
  EXPECT_NE(unknown_command(here, "dem").find("'demo'"), std::string::npos);
  EXPECT_NE(unknown_command(here, "xyzzy").find("`breast help` lists them"), std::string::npos);
}

}  // namespace
}  // namespace breast
