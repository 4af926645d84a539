// SPDX-License-Identifier: GPL-3.0-or-later
// Under a locale with a decimal comma, or with letters that change case in another way (Turkish i), every tool writes the
// same bytes as under C: its tables, whatever else it writes, and what it prints.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string_view>

#include "faults/cases.hpp"
#include "faults/outputs.hpp"
#include "fixtures/scratch_folder.hpp"

namespace breast::faults {
namespace {

namespace fs = std::filesystem;

const char* const foreign[] = {"de_DE", "tr_TR"};

// A report but for its seconds and megabytes, which differ between runs; a decimal comma stays.
std::string without_digits(std::string text) {
  std::erase_if(text, [](char c) {
    return std::string_view("0123456789.+-e").find(c) != std::string_view::npos;
  });
  return text;
}

class Locales : public ::testing::TestWithParam<Case> {
 protected:
  // The machine may have neither locale: both are made in a folder of the test, where localedef and its sources are there.
  static void SetUpTestSuite() {
    inputs_ = new ScratchFolder;
    locales_ = new ScratchFolder;
    write_inputs(inputs_->path());
    for (const std::string name : foreign) {
      const std::string made = (locales_->path() / (name + ".UTF-8")).string();
      have_ =
          have_ &&
          std::system(
              ("localedef -i " + name + " -f UTF-8 '" + made + "' > /dev/null 2>&1").c_str()) == 0;
    }
  }
  static void TearDownTestSuite() {
    delete inputs_;
    delete locales_;
  }
  // stdout, stderr and files of the case under that locale; files of meshes and reports only by their content.
  ToolResult run(const std::string& locale, const fs::path& folder) const {
    for (const auto& entry : fs::directory_iterator(inputs_->path())) {
      fs::create_symlink(entry.path(), folder / entry.path().filename());
    }
    setenv("LC_ALL", locale.c_str(), 1);
    setenv("LOCPATH", locales_->path().c_str(), 1);
    ToolResult result =
        run_line(std::string(GetParam().line) + " --report out.json --threads 1 --quiet", folder);
    unsetenv("LC_ALL");
    unsetenv("LOCPATH");
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (entry.is_symlink()) fs::remove(entry.path());
    }
    return result;
  }

  static inline ScratchFolder *inputs_ = nullptr, *locales_ = nullptr;
  static inline bool have_ = true;
};

TEST_P(Locales, ChangeNothing) {
  if (!have_) GTEST_SKIP() << "localedef cannot make them (Debian: locales)";
  if (GetParam().left_out()) GTEST_SKIP() << "only with BREAST_FAULT_ALLOCATIONS";
  const std::string line = GetParam().line;
  if (!fs::exists(tool_path(line.substr(0, line.find(' '))))) GTEST_SKIP() << "not built";
  const ScratchFolder plain;
  const ToolResult expected = run("C", plain.path());
  ASSERT_EQ(expected.exit_code, 0) << expected.err;
  for (const std::string locale : foreign) {
    const ScratchFolder folder;
    const ToolResult result = run(locale + ".UTF-8", folder.path());
    EXPECT_EQ(result.exit_code, 0) << locale << ": " << result.err;
    EXPECT_EQ(result.out, expected.out) << locale;
    const Files theirs = files_in(folder.path());
    for (const auto& [name, content] : files_in(plain.path())) {
      ASSERT_TRUE(theirs.contains(name)) << locale << " wrote no " << name;
      EXPECT_TRUE(equal_but_for_time(folder / name, plain / name))
          << locale << ": " << name << " is another";
      if (name.ends_with(".json")) {
        EXPECT_EQ(without_digits(theirs.at(name)), without_digits(content))
            << locale << ": " << name;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Tools, Locales, ::testing::ValuesIn(cases()),
                         [](const auto& tool) { return std::string(tool.param.name); });

}  // namespace
}  // namespace breast::faults
