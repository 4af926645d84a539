// SPDX-License-Identifier: GPL-3.0-or-later
#include "lineage/pairs.hpp"

#include <algorithm>
#include <array>

#include "core/error.hpp"
#include "lineage/contents.hpp"
#include "lineage/places.hpp"
#include "mesh/part.hpp"

namespace breast {

namespace {

enum class Verdict { same, other, unknown };

/// What differs, and how it was found.
struct Finding {
  Verdict verdict = Verdict::unknown;
  std::string difference = {};
};

Finding other(std::string difference) {
  return {Verdict::other, std::move(difference)};
}

/// Two meshes of which one is a part of the other: between plates there may be no tissue around the
/// breast.
struct WholeAndPart {
  const HexMesh *whole, *part;
  PartIndices at;
};
std::optional<WholeAndPart> whole_and_part(const HexMesh& a, const HexMesh& b) {
  if (auto at = indices_in(a, b)) return WholeAndPart{&a, &b, std::move(*at)};
  if (auto at = indices_in(b, a)) return WholeAndPart{&b, &a, std::move(*at)};
  return std::nullopt;
}

/// The first node of the part at which the shapes are apart, as words; "" if they are the same. Shapes
/// that pass through files differ by less than the tolerance.
std::string apart(const WholeAndPart& pair, std::vector<Vec3> HexMesh::*shape, const char* name) {
  constexpr double rounding_mm = 1e-6;
  const std::vector<Vec3>&whole = pair.whole->*shape, &part = pair.part->*shape;
  for (std::size_t i = 0; i < part.size(); ++i) {
    const double distance = (part[i] - whole[std::size_t(pair.at.nodes[i])]).norm();
    if (!(distance <= rounding_mm))
      return message("node ", i, " of their ", name, " shapes is ", distance, " mm apart");
  }
  return "";
}

Finding compare_meshes(const HexMesh& a, const HexMesh& b) {
  const auto pair = whole_and_part(a, b);
  if (!pair)
    return other(message("have different elements (", a.elements(), " and ", b.elements(), ")"));
  const std::string distance = apart(*pair, &HexMesh::imaged, "imaged");
  return distance.empty() ? Finding{Verdict::same} : other("are different meshes: " + distance);
}

/// The parts of the model that two files state differently: "materials, wall". The name of the set is
/// none.
std::string differing_parts(const ModelText& a, const ModelText& b) {
  std::string parts;
  for (const ModelPart& part : model_parts) {
    if (part.text == &ModelText::name || a.*part.text == b.*part.text) continue;
    parts += (parts.empty() ? "" : ", ") + std::string(part.name);
  }
  return parts;
}

/// Nothing is known of a mesh without a stress-free shape.
Finding compare_solutions(const HexMesh& a, const HexMesh& b) {
  const auto pair = whole_and_part(a, b);
  if (!pair || a.reference.empty() || b.reference.empty()) return {};
  for (std::size_t e = 0; e < pair->at.elements.size(); ++e)
    if (pair->part->tissue[e] != pair->whole->tissue[std::size_t(pair->at.elements[e])])
      return other(message("have different tissues, first in element ", e));
  const std::string parts = a.model && b.model ? differing_parts(*a.model, *b.model) : "";
  if (!parts.empty()) return other("were solved with different models (" + parts + ")");
  const std::string distance = apart(*pair, &HexMesh::reference, "stress-free");
  return distance.empty() ? Finding{Verdict::same}
                          : other("were solved with different models: " + distance);
}

Finding compare_lineage(const Contents& a, const Contents& b, Stage stage) {
  if (const auto parted = a.parted_until(stage, b))
    return other(message("come from different ", stage_words(*parted), a.names_at(*parted, b)));
  if (a.share_from(stage, b)) return {Verdict::same};
  return {};
}

Finding compare_places(const Origin& a, const Origin& b) {
  const std::string difference = places_differ(a, b);
  return difference.empty() ? Finding{} : other(difference);
}

Finding compare(Shared what, const Origin& a, const Origin& b) {
  const Contents of_a(a), of_b(b);
  switch (what) {
    case Shared::scan: {
      const Finding found = compare_lineage(of_a, of_b, Stage::scan);
      return found.verdict == Verdict::unknown ? compare_places(a, b) : found;
    }
    case Shared::side:
      if (!a.side || !b.side || *a.side == *b.side) return {Verdict::same};
      return other(
          message("are of different breasts, ", side_name(*a.side), " and ", side_name(*b.side)));
    case Shared::geometry: {
      Finding found = compare_places(a, b);
      if (found.verdict == Verdict::unknown && a.labels != nullptr && b.labels != nullptr) {
        const std::string difference = breasts_differ(*a.labels, *b.labels);
        if (!difference.empty()) found = other(difference);
      }
      return found.verdict == Verdict::unknown ? Finding{Verdict::same} : found;
    }
    case Shared::mesh: {
      if (a.mesh != nullptr && b.mesh != nullptr) return compare_meshes(*a.mesh, *b.mesh);
      const Finding found = compare_lineage(of_a, of_b, Stage::mesh);
      return found.verdict == Verdict::unknown ? compare_places(a, b) : found;
    }
    case Shared::model:
      return a.mesh != nullptr && b.mesh != nullptr ? compare_solutions(*a.mesh, *b.mesh)
                                                    : compare_lineage(of_a, of_b, Stage::reference);
    case Shared::patient:
      if (a.patient.empty() || b.patient.empty()) return {};
      return a.patient == b.patient ? Finding{Verdict::same}
                                    : other("are of different patients by their Patient ID");
  }
  return {};
}

// The remark on a pair of which the files do not say whether they agree.
std::string remark_on(Shared what, const Origin& a, const Origin& b) {
  if (what == Shared::patient) {
    const Origin& silent = a.patient.empty() ? a : b;
    return message(
        silent.file.filename().string(),
        ": states no Patient ID, so that it is not known whether it is of the patient of ",
        (&silent == &a ? b : a).file.filename().string());
  }
  const Stage stage = what == Shared::scan   ? Stage::scan
                      : what == Shared::mesh ? Stage::mesh
                                             : Stage::reference;
  const bool first = !Contents(a).know(stage);
  return message((first ? a : b).file.filename().string(), ": does not say from which ",
                 shared_name(what), " it comes; it was compared with ",
                 (first ? b : a).file.filename().string(), " only by side and place");
}

}  // namespace

std::string scan_behind(const Origin& origin) {
  return Contents(origin).one_of(Stage::scan);
}

std::string check_pair(const PairRule& rule, const Origin& first, const Origin& second,
                       const std::string& accepted) {
  std::string remark;
  bool scan_is_settled = false;  // known to be one, or accepted as another
  for (const Shared what : rule.must_agree) {
    const bool may_differ = std::count(rule.may_differ.begin(), rule.may_differ.end(), what) > 0;
    const bool is_accepted = may_differ && accepted == shared_name(what);
    if (what == Shared::geometry && scan_is_settled) continue;
    const Finding found = is_accepted ? Finding{Verdict::same} : compare(what, first, second);
    if (found.verdict == Verdict::other) {
      throw input_error(
          first.file.string(), " and ", second.file.string(), ": ", found.difference,
          ": give files that belong together",
          may_differ ? ", or accept these with --accept-other " + shared_name(what) : "");
    }
    if (what == Shared::scan) scan_is_settled = found.verdict == Verdict::same;
    if (found.verdict == Verdict::unknown && remark.empty())
      remark = remark_on(what, first, second);
  }
  return remark;
}

void Pairs::check(const std::string& first_name, const Origin& first,
                  const std::string& second_name, const Origin& second) {
  const std::string remark =
      check_pair(pair_rule(tool_, first_name, second_name), first, second, accepted_);
  if (remark.empty()) return;
  const std::string file = remark.substr(0, remark.find(": "));
  if (remarked_.insert(file).second) remark_(remark);
}

}  // namespace breast
