// SPDX-License-Identifier: GPL-3.0-or-later
// Texts inside the inputs that a page, a report or a terminal could take for more than texts: names of landmarks, histories,
// a mammogram's energy, a scan's description, names in tables. Whatever a tool writes holds none of them unescaped, nor a
// folder that an input names.
#include <gtest/gtest.h>

#include <cstdlib>

#include "core/atomic_file.hpp"
#include "core/report.hpp"
#include "core/table.hpp"
#include "faults/cases.hpp"
#include "fixtures/scratch_folder.hpp"
#include "io/mammogram_file.hpp"

namespace breast::faults {
namespace {

namespace fs = std::filesystem;

// Each ends where it stands as it is: an element, an attribute, a script's string or line, a comment, a CDATA section; the last
// is no UTF-8.
const std::string corpus[] = {"</script><script>alert(1)</script>",
                              "\"><img src=x onerror=alert(1)>",
                              "' onload='alert(1)",
                              "--><b>&lt;",
                              "]]><b>",
                              "\\\"};alert(1);//",
                              "\xe2\x80\xa8"
                              "alert(1)",
                              "$(touch executed)`touch executed`",
                              "caf\xe9 \xff\xfe"};
const std::string secret = "/home/somebody/secret/";

std::string all_texts() {
  std::string joined;
  for (const std::string& text : corpus) joined += text;
  return joined;
}

History hostile_history() {
  History history;
  for (const std::string& text : corpus)
    history.push_back({text, text, "tool " + text, {{text, text}}});
  return history;
}

void make_hostile(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path file = entry.path();
    const std::string name = file.filename().string();
    if (name == "labels.vtkhdf" || name == "scan_labels.vtkhdf") {
      LabelVolume labels = read_labels(file);
      for (const std::string& text : corpus) {
        if (text.find('/') == std::string::npos) labels.landmarks[text] = Vec3(0, 20, 0);
      }
      labels.history = hostile_history();
      write_labels(file, labels);
    } else if (file.extension() == ".vtkhdf" && name != "geometry.vtkhdf") {
      HexMesh mesh = read_mesh(file);
      const History ours = mesh.history;
      mesh.history = hostile_history();
      mesh.history.insert(mesh.history.end(), ours.begin(), ours.end());
      for (const std::string& text : corpus) {
        if (mesh.landmarks.empty() || text.find('/') != std::string::npos) continue;
        Landmark named = mesh.landmarks.front();
        named.name = text;
        mesh.landmarks.push_back(named);
      }
      write_mesh(file, mesh);
    } else if (file.extension() == ".vti") {
      Mammogram image = read_mammogram(file);
      image.energy = all_texts();
      image.history = hostile_history();
      write_mammogram(file, image);
    }
  }
  const Volume<float> scan = testing::SyntheticScan::coarse().image();
  Volume<std::int16_t> rounded(scan.grid);
  std::copy(scan.voxels.begin(), scan.voxels.end(), rounded.voxels.begin());
  fs::remove_all(folder / "series");
  write_dicom_series(folder / "series", rounded, secret + "\"><script>alert(1)</script>\xe9");
}

bool shows_raw(const std::string& content, const std::string& text) {
  return content.find(text) != std::string::npos;
}

class HostileTexts : public ::testing::TestWithParam<Case> {
 protected:
  static void SetUpTestSuite() {
    inputs_ = new ScratchFolder;
    write_inputs(inputs_->path());
    make_hostile(inputs_->path());
  }
  static void TearDownTestSuite() { delete inputs_; }

  // Pages, pictures' frames and decks: what a browser or an XML reader would act on.
  static void check_markup(const fs::path& file, const std::string& content) {
    for (const std::string& text : corpus) {
      if (text.find_first_of("<>\"'\xe2\xff") == std::string::npos) continue;
      EXPECT_FALSE(shows_raw(content, text)) << file << " holds " << text;
    }
    EXPECT_FALSE(shows_raw(content, "<img src=x")) << file;
  }
  static void check_report(const fs::path& file, const std::string& content) {
    EXPECT_NO_THROW(Report::parse(content, "report"))
        << file;  // strict: any byte that JSON escapes is escaped
    for (const unsigned char c : content)
      EXPECT_TRUE(c >= ' ' || c == '\n') << file << ": byte " << int(c);
  }

  static inline ScratchFolder* inputs_ = nullptr;
};

TEST_P(HostileTexts, StayTexts) {
  if (GetParam().left_out()) GTEST_SKIP() << "only with BREAST_FAULT_ALLOCATIONS";
  const std::string line = GetParam().line;
  if (!fs::exists(tool_path(line.substr(0, line.find(' '))))) GTEST_SKIP() << "not built";
  const ScratchFolder folder;
  for (const auto& entry : fs::directory_iterator(inputs_->path())) {
    fs::create_symlink(entry.path(), folder / entry.path().filename());
  }
  const ToolResult result = run_line(line + " --threads 1 --report out.json", folder.path());
  if (result.exit_code != 0) {
    EXPECT_EQ(result.error_lines(), 1) << result.err;
    std::printf("%s: refused: %s", GetParam().name, result.err.c_str());
  }
  for (const std::string* said : {&result.out, &result.err}) {
    EXPECT_FALSE(shows_raw(*said, secret)) << *said;
    for (const unsigned char c : *said)
      EXPECT_TRUE(c >= ' ' || c == '\n' || c == '\t' || c == '\r') << int(c) << " in " << *said;
  }
  EXPECT_FALSE(fs::exists(folder / "executed"));
  for (const auto& entry : fs::directory_iterator(folder.path())) {
    if (entry.is_symlink() || entry.is_directory()) continue;
    const std::string content = read_text(entry.path());
    const std::string ending = entry.path().extension().string();
    EXPECT_FALSE(shows_raw(content, secret)) << entry.path();
    EXPECT_FALSE(shows_raw(content, folder.path().string())) << entry.path();
    if (ending == ".json") check_report(entry.path(), content);
    if (ending == ".html" || ending == ".vtp" || ending == ".vti" || ending == ".vtu" ||
        ending == ".feb") {
      check_markup(entry.path(), content);
    }
    if (ending == ".tsv") {
      EXPECT_NO_THROW(parse_table(content, entry.path().string()));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Tools, HostileTexts, ::testing::ValuesIn(cases()),
                         [](const auto& tool) { return std::string(tool.param.name); });

}  // namespace
}  // namespace breast::faults
