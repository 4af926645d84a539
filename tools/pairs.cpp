// SPDX-License-Identifier: GPL-3.0-or-later
// pairs: the page of the files that must belong together, and the check of files by its rules, for programs in other languages.
#include <algorithm>
#include <deque>
#include <variant>

#include "cli/declaration.hpp"
#include "core/error.hpp"
#include "io/geometry_file.hpp"
#include "io/label_file.hpp"
#include "io/mammogram_file.hpp"
#include "io/mesh_file.hpp"
#include "io/surface_file.hpp"
#include "io/volume_file.hpp"
#include "tool_pairs.hpp"

using namespace breast;

namespace {

// "" for the rules of all tools. Throws Error (input) for a tool that reads no pair.
std::string rules_of(const std::string& name) {
  std::vector<std::string> names{"all"};
  for (const PairRule& rule : pair_rules()) names.push_back(rule.tool);
  if (std::find(names.begin(), names.end(), name) != names.end()) return name == "all" ? "" : name;
  const std::string near = nearest(name, names);
  throw input_error("'", name, "' is no tool that reads a pair of files; ",
                    near.empty() ? "give all" : "did you mean '" + near + "'?");
}

struct Choices {
  std::string tool, accept_other;
  std::vector<std::string> files;
  int series = 0;
};

/// A file with the name that the table gives it.
struct NamedFile {
  std::string name;
  std::filesystem::path file;
};

NamedFile named(const std::string& word) {
  const std::size_t equals = word.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == word.size())
    throw input_error("'", word, "' is not NAME=FILE");
  const std::filesystem::path file = word.substr(equals + 1);
  if (!std::filesystem::exists(file)) throw input_error(file.string(), " does not exist");
  return {word.substr(0, equals), file};
}

/// What the files contain, each read once; origins point into it.
class Reader {
 public:
  Reader(const std::vector<NamedFile>& files, int series) : files_(files), series_(series) {}

  Origin origin(const NamedFile& named) {
    const auto known = std::find_if(read_.begin(), read_.end(),
                                    [&](const Origin& o) { return o.file == named.file; });
    if (known != read_.end()) return *known;
    read_.push_back(read(named));
    return read_.back();
  }

 private:
  Origin read(const NamedFile& named) {
    const auto& [name, file] = named;
    const std::string ending = file.extension().string();
    if (ending == ".vti") return kept(file, read_mammogram(file));
    if (ending == ".vtp")
      return holds_curves(file) ? kept(file, read_polylines(file)) : kept(file, read_surface(file));
    if (ending != ".vtkhdf") {
      VolumeSource source;
      const Volume<float> scan = read_volume(file, series_, &source);
      return origin_of_scan(file, source.content_sha256, scan.grid);
    }
    if (name.ends_with("labels") || name == "LABELS") return kept(file, read_labels(file));
    if (name == "geometry") return kept(file, read_geometry(file));
    if (name == "mesh") return kept(file, read_mesh(file));
    try {
      return kept(file, read_geometry(file));
    } catch (const Error&) {
      return kept(file, read_mesh(file));
    }
  }
  /// In the table's names, curves alone end with .vtp.
  bool holds_curves(const std::filesystem::path& file) const {
    return std::any_of(files_.begin(), files_.end(), [&](const NamedFile& named) {
      return named.file == file && named.name.ends_with(".vtp");
    });
  }
  template <class Content>
  Origin kept(const std::filesystem::path& file, Content content) {
    return origin_of(file, std::get<Content>(contents_.emplace_back(std::move(content))));
  }

  const std::vector<NamedFile>& files_;
  int series_;
  std::deque<std::variant<HexMesh, BreastGeometry, LabelVolume, Mammogram, TriMesh, PolyLines>>
      contents_;
  std::deque<Origin> read_;
};

void check_files(const Choices& choices, Run& run) {
  std::vector<NamedFile> files;
  for (const std::string& word : choices.files) files.push_back(named(word));
  Reader reader(files, choices.series);
  if (choices.tool == "all") {
    for (const NamedFile& file : files) reader.origin(file);
    return;
  }
  Pairs pairs = pairs_of(choices.tool, run, choices.accept_other);
  for (const PairRule& rule : pair_rules()) {
    if (rule.tool != choices.tool) continue;
    for (const NamedFile& first : files)
      for (const NamedFile& second : files)
        if (first.name == rule.first && second.name == rule.second)
          pairs.check(rule.first, reader.origin(first), rule.second, reader.origin(second));
  }
}

}  // namespace

int main(int argc, char** argv) {
  Choices choices;
  Tool tool("pairs", "which files must belong together, and whether they do");
  tool.describe(
      "Prints a page in Markdown: for each pair of files that meet in a tool, what must agree "
      "between them and what --accept-other lets differ. With --check it prints nothing and checks "
      "files by the rules of that tool instead: every pair of them that has a row on the page. A "
      "pair that does not belong together is refused with one line and exit code 2. Tools in C++ "
      "check their files themselves; this is for programs in other languages, as render is. With "
      "all instead of a tool, each file alone is read with the checks of all tools; its name is "
      "then that of its kind: labels, geometry, mesh, image, surface or curves.vtp.");
  tool.word(choices.tool, "all|TOOL", "the pairs of all tools, or of one");
  tool.texts(
      choices.files, "--check", "NAME=FILE",
      "a file to check with the name that the page gives it, as CC=cc.vtkhdf; a name that begins "
      "with a dash as --check=--labels=labels.vtkhdf");
  tool.integer(choices.series, "--series", "N", "series of a DICOM folder (0: the only one)", 0,
               100000);
  tool.text(choices.accept_other, "--accept-other", "WHAT",
            "accept a pair that differs in this, where the page allows it");
  tool.example("pairs compress", "the pairs that compress checks");
  tool.example("pairs all --check mesh=supine.vtkhdf", "is this a mesh that the tools read?");
  tool.example("pairs cc2mlo --check CC=cc.vtkhdf --check MLO=mlo.vtkhdf",
               "are both compressions of one breast and one model?");
  return tool.main(argc, argv, [&](Run& run) {
    const std::string rules = rules_of(choices.tool);
    if (choices.files.empty()) return run.print(pairs_page(rules));
    check_files(choices, run);
  });
}
