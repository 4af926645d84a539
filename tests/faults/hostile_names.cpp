// SPDX-License-Identifier: GPL-3.0-or-later
// Names that a shell, a page or a report could take for more than names: every tool reads and writes files so
// called, runs nothing of them, and no file it writes holds one unescaped, nor the folder it lies in.
#include <gtest/gtest.h>

#include <cstdlib>

#include "core/atomic_file.hpp"
#include "core/report.hpp"
#include "faults/cases.hpp"
#include "fixtures/scratch_folder.hpp"

namespace breast::faults {
namespace {

namespace fs = std::filesystem;

const std::string hostile =
    "a b'c\"$(touch executed)`touch executed`;\xc3\xa9(=)<script>&\xe2\x80\xa8";

class HostileNames : public ::testing::TestWithParam<Case> {
 protected:
  static void SetUpTestSuite() {
    inputs_ = new ScratchFolder;
    write_inputs(inputs_->path());
  }
  static void TearDownTestSuite() { delete inputs_; }
  void SetUp() override {
    for (const auto& entry : fs::directory_iterator(inputs_->path())) {
      fs::create_symlink(entry.path(), renamed(entry.path().filename().string()));
    }
    fs::create_directory_symlink(inputs_->path(), renamed("run"));
  }
  // NAME.vtkhdf as FOLDER/hostileNAME.vtkhdf
  fs::path renamed(const std::string& name) const { return folder_ / (hostile + name); }
  // Words of the case's line; those that name a file of it, with its hostile name and its folder.
  std::vector<std::string> arguments() const {
    std::vector<std::string> words = words_of(GetParam().line);
    for (std::size_t w = 1; w < words.size(); ++w) {
      if (words[w] == ".") {  // the folder of a run
        words[w] = renamed("run").string();
        continue;
      }
      const bool output =
          words[w].starts_with("out.") || words[w].starts_with("out-") || words[w] == "out";
      if (output || fs::exists(inputs_->path() / words[w])) words[w] = renamed(words[w]).string();
    }
    return words;
  }

  static inline ScratchFolder* inputs_ = nullptr;
  ScratchFolder folder_, elsewhere_;
};

TEST_P(HostileNames, AreNamesAndNothingElse) {
  if (GetParam().left_out()) GTEST_SKIP() << "only with BREAST_FAULT_ALLOCATIONS";
  std::vector<std::string> words = arguments();
  const std::string tool = words.front();
  if (!fs::exists(tool_path(tool))) GTEST_SKIP() << tool << " is not built";
  words.erase(words.begin());
  words.insert(words.end(), {"--threads", "1", "--report", renamed("out.json").string()});
  const ToolResult result = run_tool(tool, words, elsewhere_.path());
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(fs::is_empty(elsewhere_.path())) << "something in a name was run";
  EXPECT_EQ(result.out.find(folder_.path().string()), std::string::npos) << result.out;
  for (const auto& entry : fs::directory_iterator(folder_.path())) {
    const fs::path file = entry.path();
    if (fs::is_symlink(file)) continue;
    ASSERT_TRUE(file.filename().string().starts_with(hostile)) << file;
    if (fs::is_directory(file)) continue;
    const std::string text = read_text(file);
    EXPECT_EQ(text.find(folder_.path().string()), std::string::npos) << file << " names its folder";
    if (file.extension() == ".json") {
      EXPECT_NO_THROW(Report::parse(text, "report"));
    }
    if (file.extension() == ".html" || file.extension() == ".vtp" || file.extension() == ".vti" ||
        file.extension() == ".feb") {
      EXPECT_EQ(text.find("<script>&"), std::string::npos) << file;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Tools, HostileNames, ::testing::ValuesIn(cases()),
                         [](const auto& tool) { return std::string(tool.param.name); });

}  // namespace
}  // namespace breast::faults
