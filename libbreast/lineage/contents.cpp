// SPDX-License-Identifier: GPL-3.0-or-later
#include "lineage/contents.hpp"

#include <algorithm>
#include <vector>

namespace breast {

namespace {

/// Stages of a tool's inputs, in the order in which its history states them; the last holds for all
/// further ones. Those of a tool that is not listed count as labels: they come from the same scan,
/// and nothing else is known.
struct InputStages {
  const char* tool;
  std::vector<std::optional<Stage>> stages;
};

const std::vector<InputStages>& input_stages() {
  using enum Stage;
  static const std::vector<InputStages> list = {
      {"segment", {scan, std::nullopt}},  // a corrected chest wall is drawn by hand
      {"phantom", {scan}},                // the scan whose truth it writes
      {"fit-hermite", {labels}},
      {"hexmesh", {geometry, labels}},
      {"backward", {mesh}},
      {"backward-mpi", {mesh}},
      {"identify", {mesh, std::nullopt}},
      {"forward", {reference}},
      {"forward-mpi", {reference}},
      {"compress", {reference}},
      {"export-deck", {reference}},
      {"sensitivity", {reference, result}},
      {"difference", {result, labels}},  // of the other two only the scan is the same
      {"project-mammogram", {result, labels}},
      {"cc2mlo", {result}},
      {"match-lookup", {result}},
  };
  return list;
}

std::optional<Stage> stage_of(const std::string& tool, std::size_t input) {
  for (const InputStages& known : input_stages())
    if (tool == known.tool) return known.stages[std::min(input, known.stages.size() - 1)];
  return Stage::labels;
}

bool have_common(const std::map<std::string, std::string>& a,
                 const std::map<std::string, std::string>& b) {
  return std::any_of(a.begin(), a.end(),
                     [&](const auto& content) { return b.contains(content.first); });
}

}  // namespace

const char* stage_words(Stage stage) {
  switch (stage) {
    case Stage::scan:
      return "scans";
    case Stage::labels:
      return "labels";
    case Stage::geometry:
      return "geometries";
    case Stage::mesh:
      return "meshes";
    case Stage::reference:
      return "stress-free shapes";
    case Stage::result:
      return "results";
  }
  return "";
}

Contents::Contents(const Origin& origin) {
  if (origin.history != nullptr) {
    for (const HistoryEntry& entry : *origin.history) {
      for (std::size_t i = 0; i < entry.inputs.size(); ++i)
        if (const auto stage = stage_of(entry.tool, i))
          add(*stage, entry.inputs[i].sha256, entry.inputs[i].name);
    }
  }
  if (!origin.scan_sha256.empty())
    add(Stage::scan, origin.scan_sha256, "the scan of " + origin.file.filename().string());
  if (!origin.content_sha256.empty())
    add(origin.stage, origin.content_sha256, origin.file.filename().string());
}

void Contents::add(Stage stage, const std::string& sha256, const std::string& name) {
  at_[std::size_t(stage)].emplace(sha256, name);
}

bool Contents::share_from(Stage stage, const Contents& other) const {
  Names mine, theirs;
  for (std::size_t s = std::size_t(stage); s < at_.size(); ++s) {
    mine.insert(at_[s].begin(), at_[s].end());
    theirs.insert(other.at_[s].begin(), other.at_[s].end());
  }
  return have_common(mine, theirs);
}

std::optional<Stage> Contents::parted_until(Stage stage, const Contents& other) const {
  for (const Stage one : {Stage::scan, Stage::mesh, Stage::reference}) {
    if (one > stage) break;
    if (!at(one).empty() && !other.at(one).empty() && !have_common(at(one), other.at(one)))
      return one;
  }
  return std::nullopt;
}

std::string Contents::names_at(Stage stage, const Contents& other) const {
  const std::string &mine = at(stage).begin()->second, &theirs = other.at(stage).begin()->second;
  return mine == theirs ? "" : " (" + mine + " and " + theirs + ")";
}

}  // namespace breast
