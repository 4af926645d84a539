// SPDX-License-Identifier: GPL-3.0-or-later
#include "identify_landmarks.hpp"

#include "core/error.hpp"
#include "core/table.hpp"
#include "core/text/lower_case.hpp"
#include "io/markups_file.hpp"

namespace breast {

namespace {

using Marks = std::vector<MarkupPoint>;

// The posture that a label names, if any, and the label without it.
struct Label {
  std::string posture, rest;
};

Label label_of(const std::string& text) {
  const std::string low = lower_case(text);
  for (const char* posture : {"prone", "supine"}) {
    const std::size_t at = low.find(posture);
    if (at == std::string::npos) continue;
    std::string rest = text;
    rest.erase(at, std::string(posture).size());
    const auto joint = [](char c) { return c == ' ' || c == '-' || c == '_' || c == '.'; };
    while (!rest.empty() && joint(rest.front())) rest.erase(rest.begin());
    while (!rest.empty() && joint(rest.back())) rest.pop_back();
    return {posture, rest};
  }
  return {"", text};
}

const MarkupPoint* find(const Marks& marks, const std::string& rest) {
  for (const MarkupPoint& mark : marks)
    if (label_of(mark.label).rest == rest) return &mark;
  return nullptr;
}

// The marks of a file with both postures, distinguished by the words in their labels or by their
// order.
std::pair<Marks, Marks> parted(const Marks& all) {
  std::pair<Marks, Marks> out;
  for (const MarkupPoint& mark : all) {
    const Label label = label_of(mark.label);
    const bool second = label.posture == "supine" ||
                        (label.posture.empty() && find(out.first, label.rest) != nullptr);
    (second ? out.second : out.first).push_back(mark);
  }
  return out;
}

void check_twice(const Marks& marks, const std::string& where) {
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const std::string rest = label_of(marks[i].label).rest;
    for (std::size_t k = 0; k < i; ++k)
      if (label_of(marks[k].label).rest == rest)
        throw input_error(where, ": landmark '", rest, "' is marked twice in one posture");
  }
}

void check_partners(const Marks& marks, const Marks& others, const std::string& where,
                    const std::string& there) {
  for (const MarkupPoint& mark : marks) {
    const std::string rest = label_of(mark.label).rest;
    if (find(others, rest) != nullptr) continue;
    throw input_error(where, ": landmark '", rest, "' has no mark of the other posture in ", there,
                      "; marks pair by their labels, without the words prone and supine");
  }
}

}  // namespace

std::vector<LandmarkPair> read_landmark_pairs(const std::filesystem::path& first,
                                              const std::filesystem::path& second, Side side,
                                              double observer) {
  if (!is_markups_name(first)) {
    if (!second.empty())
      throw input_error(
          second.string(),
          ": a second file of landmarks goes with points of 3D Slicer (.mrk.json, .fcsv) only");
    return landmark_pairs(read_table(first), side, observer);
  }
  const std::filesystem::path& other = second.empty() ? first : second;
  if (!is_markups_name(other))
    throw input_error(other.string(), ": is no point list of 3D Slicer (.mrk.json, .fcsv)");
  const auto [prone, supine] =
      second.empty() ? parted(read_markups(first))
                     : std::pair<Marks, Marks>(read_markups(first), read_markups(second));
  check_twice(prone, first.string());
  check_twice(supine, other.string());
  check_partners(prone, supine, first.string(), other.string());
  check_partners(supine, prone, other.string(), first.string());
  std::vector<LandmarkPair> pairs;
  for (const MarkupPoint& mark : prone) {
    const std::string rest = label_of(mark.label).rest;
    pairs.push_back({rest, mark.at, find(supine, rest)->at, observer});
  }
  return pairs;
}

}  // namespace breast
