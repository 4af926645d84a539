// SPDX-License-Identifier: GPL-3.0-or-later
#include "lineage/pair_rules.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "core/error.hpp"

namespace breast {

namespace {

constexpr std::array all_shared = {Shared::scan, Shared::side,  Shared::geometry,
                                   Shared::mesh, Shared::model, Shared::patient};

std::string words(const std::vector<Shared>& list, const std::string& joint) {
  std::string text;
  for (const Shared what : list) text += (text.empty() ? "" : joint) + shared_name(what);
  return text;
}

const char* meaning(Shared what) {
  switch (what) {
    case Shared::scan:
      return "both come from one scan";
    case Shared::side:
      return "both are of the left or both of the right breast";
    case Shared::geometry:
      return "both show one body at one place in the frame of the scan";
    case Shared::mesh:
      return "both have the elements and the imaged nodes of one mesh";
    case Shared::model:
      return "both were solved with one model: laws, supports, element and stress-free shape are the same";
    case Shared::patient:
      return "both state one Patient ID";
  }
  return "";
}

}  // namespace

std::string shared_name(Shared what) {
  switch (what) {
    case Shared::scan:
      return "scan";
    case Shared::side:
      return "side";
    case Shared::geometry:
      return "geometry";
    case Shared::mesh:
      return "mesh";
    case Shared::model:
      return "model";
    case Shared::patient:
      return "patient";
  }
  return "";
}

const std::vector<PairRule>& pair_rules() {
  using enum Shared;
  static const std::vector<PairRule> rules = {
      {"segment", "MR", "--fat", {patient}, {patient}},
      {"segment", "MR", "--also", {patient}, {patient}},
      {"segment", "MR", "--chest-wall", {scan, side, geometry}, {scan}},
      {"fit-hermite", "LABELS", "--native", {scan, side, geometry}, {scan}},
      {"hexmesh", "GEOMETRY", "LABELS", {scan, side}, {scan}},
      {"hexmesh", "LABELS", "--native", {scan, side, geometry}, {scan}},
      {"hexmesh", "LABELS", "--tumour", {scan}, {scan}},
      {"sensitivity", "REFERENCE", "STATE", {side, mesh, model}},
      {"compress", "REFERENCE", "--like", {side}},
      {"project-mammogram", "COMPRESSED", "--labels", {scan, side}},
      {"project-mammogram", "LABELS", "--native", {scan, side, geometry}, {scan}},
      {"cc2mlo", "CC", "MLO", {side, mesh, model}, {model}},
      {"cc2mlo", "CC", "--supine", {side, mesh, model}, {model}},
      {"cc2mlo", "CC", "--truth", {scan, side}},
      {"cc2mlo", "CC", "--cc-image", {side}},
      {"cc2mlo", "MLO", "--mlo-image", {side}},
      {"cc2mlo", "--cc-image", "--mlo-image", {side, patient}, {patient}},
      {"match-lookup", "CC", "MLO", {side, mesh, model}, {model}},
      {"identify", "MESH", "--labels", {scan, side}},
      {"identify", "MESH", "--second-labels", {side}},
      {"identify", "--second-labels", "--surface", {scan}},
      {"difference", "STATE", "PLUS", {scan, side}},
      {"difference", "STATE", "MINUS", {scan, side}},
      {"probe", "--base", "FILE", {scan, side}},
      {"probe", "FILE", "--truth", {scan, side}},
      {"probe", "first FILE", "FILE with --truth", {side, mesh}},
      {"truth-table", "LANDMARKS", "MESH", {side, geometry}},
      {"truth-table", "first MESH", "MESH", {side, geometry}},
      {"evaluate", "GIVEN", "TRUTH", {scan, side}, {scan}},
      {"evaluate", "TRUTH", "--region", {geometry}},
      {"evaluate", "TRUTH", "--fraction", {geometry}},
      {"export-deck", "REFERENCE", "--base", {side, mesh}},
      {"export-slicer", "labels.vtkhdf", "mesh.vtkhdf", {scan, side}},
      {"export-slicer", "labels.vtkhdf", "--scan", {scan}},
      {"export-slicer", "mesh.vtkhdf", "other shape", {side, mesh}},
      {"export-slicer", "mesh.vtkhdf", "curve.vtp", {mesh}},
      {"render", "first FILE", "FILE", {scan, side}},
      {"render", "FILE.vti", "FILE.vtp", {mesh, model}, {model}},
      {"render", "--labels", "FILE", {scan, side}},
      {"render", "--labels", "--scan", {scan}},
      {"tabulate", "cc.vtkhdf", "mlo.vtkhdf", {side, mesh}},
      {"tabulate", "cc.vtkhdf", "cc.vti", {side, mesh, model}},
      {"tabulate", "mlo.vtkhdf", "mlo.vti", {side, mesh, model}},
      {"tabulate", "cc.vtkhdf", "SCAN", {scan}},
  };
  return rules;
}

const PairRule& pair_rule(const std::string& tool, const std::string& first,
                          const std::string& second) {
  for (const PairRule& rule : pair_rules())
    if (rule.tool == tool && rule.first == first && rule.second == second) return rule;
  throw std::logic_error("no rule for the pair " + first + ", " + second + " of " + tool);
}

std::vector<std::string> acceptable(const std::string& tool) {
  std::vector<std::string> names;
  for (const Shared what : all_shared) {
    const bool may = std::any_of(pair_rules().begin(), pair_rules().end(), [&](const PairRule& r) {
      return r.tool == tool && std::count(r.may_differ.begin(), r.may_differ.end(), what) > 0;
    });
    if (may) names.push_back(shared_name(what));
  }
  return names;
}

std::string accept_other_help(const std::string& tool) {
  std::string text;
  for (const Shared what : all_shared) {
    std::string pairs;
    for (const PairRule& rule : pair_rules())
      if (rule.tool == tool && std::ranges::count(rule.may_differ, what) > 0)
        pairs += (pairs.empty() ? "" : ", or ") + rule.first + " and " + rule.second;
    if (pairs.empty()) continue;
    text += message(text.empty() ? "" : "; ", shared_name(what), ": ", pairs, ", of different ",
                    shared_name(what), "s");
  }
  return "accept files that otherwise are refused because they do not belong together "
         "(docs/pairs.md). " +
         text;
}

std::string pairs_page(const std::string& tool) {
  std::string page =
      "# Files that belong together\n\n"
      "Files that meet in one tool must belong together. A file of libbreast says where it comes from: its "
      "[history](file-formats.md) contains the SHA-256 of the content of every file that led to it. A pair that "
      "differs in what its row names is refused with one line and exit code 2. A file of another program has no "
      "history: one line says so, and the side, the place in the frame of the scan (bounding boxes, nipples) and, of "
      "meshes, elements and imaged nodes are compared instead.\n\n"
      "Geometry is compared only where the scan of a file is not known. "
      "In the last column stands what the option `--accept-other` of that tool lets differ.\n\n";
  for (const Shared what : all_shared)
    page += "- **" + shared_name(what) + "**: " + meaning(what) + "\n";
  page +=
      "\nThis page is printed by `pairs all`.\n\n"
      "| tool | first file | second file | must agree | `--accept-other` |\n|---|---|---|---|---|\n";
  for (const PairRule& rule : pair_rules()) {
    if (!tool.empty() && rule.tool != tool) continue;
    page += "| [" + rule.tool + "](tools/" + rule.tool + ".md) | " + rule.first + " | " +
            rule.second + " | " + words(rule.must_agree, ", ") + " | " +
            words(rule.may_differ, ", ") + " |\n";
  }
  return page;
}

}  // namespace breast
