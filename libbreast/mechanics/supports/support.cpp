// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/supports/support.hpp"

#include <algorithm>
#include <sstream>

#include "core/error.hpp"
#include "core/table.hpp"

namespace breast {

namespace {

bool stands_at(const SupportKind& kind, SupportPlace place) {
  return std::find(kind.places.begin(), kind.places.end(), place) != kind.places.end();
}

SupportText in_parts(SupportPlace place, const std::string& whole) {
  SupportText text{place, whole, whole.substr(0, whole.find(':')), {}, {}};
  if (text.kind.size() == whole.size()) return text;
  std::string list = whole.substr(text.kind.size() + 1);
  if (list.empty() || list.back() == ',') text.refuse("a number is missing");
  std::istringstream words(list);
  for (std::string word; std::getline(words, word, ',');) {
    const std::size_t equals = word.find('=');
    const std::string digits = equals == std::string::npos ? word : word.substr(equals + 1);
    const std::optional<double> value = number_in(digits);
    if (!value) text.refuse("'" + digits + "' is not a number");
    if (equals == std::string::npos) {
      if (!text.named.empty()) text.refuse("numbers without a name come first");
      text.numbers.push_back(*value);
    } else if (!text.named.emplace(word.substr(0, equals), *value).second) {
      text.refuse("'" + word.substr(0, equals) + "' appears twice");
    }
  }
  return text;
}

// "held, slide[:KT], ..., stiffnesses in kPa/mm, for example slide:0.01".
std::string forms_at(SupportPlace place) {
  std::string forms, additions, example;
  for (const SupportKind* kind : support_kinds()) {
    if (!stands_at(*kind, place)) continue;
    std::string& list = kind->addition ? additions : forms;
    list += (list.empty() ? "" : ", ") + std::string(kind->form);
    if (example.empty() && kind->example.find(':') != std::string_view::npos)
      example = kind->example;
  }
  return forms + (additions.empty() ? "" : ", with springs also " + additions) +
         ", stiffnesses in kPa/mm, for example " + example;
}

}  // namespace

const char* place_name(SupportPlace place) {
  return place == SupportPlace::wall ? "wall" : "cut";
}

const std::vector<Face>& faces_at(const HexTopology& mesh, SupportPlace place) {
  return place == SupportPlace::wall ? mesh.pectoral_faces : mesh.cut_faces;
}

std::string BodySupport::text() const {
  std::string list;
  for (const SupportNumber& number : numbers_) {
    list += (list.empty() ? ":" : ",") + (number.key.empty() ? "" : number.key + "=") +
            format_number(number.value);
  }
  return kind_ + list;
}

std::vector<std::string> BodySupport::parameters() const {
  std::vector<std::string> names;
  for (const SupportNumber& number : numbers_) {
    if (number.value == 0 || number.parameter.empty()) continue;
    const bool there = std::find(names.begin(), names.end(), number.parameter) != names.end();
    if (!there) names.push_back(number.parameter);
  }
  return names;
}

SupportPtr BodySupport::with_numbers(
    const std::function<double(const SupportNumber&)>& value) const {
  std::string list;
  for (const SupportNumber& number : numbers_) {
    list += (list.empty() ? ":" : ",") + (number.key.empty() ? "" : number.key + "=") +
            format_number(value(number));
  }
  return read_support(place_, kind_ + list);
}

SupportPtr BodySupport::scaled(std::string_view parameter, double factor) const {
  return with_numbers([&](const SupportNumber& number) {
    return number.parameter == parameter ? factor * number.value : number.value;
  });
}

SupportPtr BodySupport::stiffened(double factor) const {
  return with_numbers([&](const SupportNumber& number) {
    return number.unit == "kPa/mm" ? factor * number.value : number.value;
  });
}

void SupportText::refuse(const std::string& reason) const {
  throw input_error("--", place_name(place), " ", whole, ": ", reason, "; give one of ",
                    forms_at(place));
}

void SupportText::expect(std::size_t least, std::size_t most) const {
  if (numbers.size() >= least && numbers.size() <= most) return;
  refuse(message(numbers.size(), " numbers, but '", kind, "' takes ",
                 least == most ? message(most) : message(least, " to ", most)));
}

double SupportText::at_least_0(double value, const char* name) const {
  if (!(value >= 0)) refuse(message(name, " ", value, " must be 0 or more"));
  return value;
}

double SupportText::above_0(double value, const char* name) const {
  if (!(value > 0)) refuse(message(name, " ", value, " must be above 0"));
  return value;
}

SupportPtr read_support(SupportPlace place, const std::string& text) {
  return read_support(in_parts(place, text));
}

SupportPtr read_support(const SupportText& parts) {
  const SupportKind* found = nullptr;
  for (const SupportKind* kind : support_kinds()) {
    if (!stands_at(*kind, parts.place)) continue;
    if (kind->addition && parts.named.contains(std::string(kind->name))) return kind->read(parts);
    if (!kind->addition && kind->name == parts.kind) found = kind;
  }
  if (found == nullptr) parts.refuse("'" + parts.kind + "' is unknown");
  for (const auto& [key, value] : parts.named) {
    if (std::find(found->keys.begin(), found->keys.end(), key) == found->keys.end())
      parts.refuse("'" + key + "=' is unknown");
  }
  return found->read(parts);
}

const SupportPtr& default_support(SupportPlace place) {
  static const SupportPtr held = wall_support("held"), free = cut_support("free");
  return place == SupportPlace::wall ? held : free;
}

}  // namespace breast
