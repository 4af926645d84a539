// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/wall_option.hpp"

#include <optional>
#include <vector>

#include "core/error.hpp"
#include "core/table.hpp"

namespace breast {

namespace {

/// The numbers after "KIND:"; no value if the text is of another kind or contains anything else.
std::optional<std::vector<double>> numbers_after(const std::string& kind, const std::string& text) {
  if (text.rfind(kind + ":", 0) != 0) return {};
  std::vector<double> list;
  std::size_t at = kind.size() + 1;
  while (true) {
    const std::size_t comma = text.find(',', at);
    const std::optional<double> value = number_in(text.substr(at, comma - at));
    if (!value) return {};
    list.push_back(*value);
    if (comma == std::string::npos) return list;
    at = comma + 1;
  }
}

}  // namespace

WallOption parse_wall(const std::string& text) {
  if (text == "held" || text == "fixed") return {};
  if (text == "slide") return {WallKind::slide, SupportStiffness{0, usual_sliding_stiffness}};
  if (const auto slide = numbers_after("slide", text); slide && slide->size() == 1) {
    if ((*slide)[0] >= 0) return {WallKind::slide, SupportStiffness{0, (*slide)[0]}};
  }
  if (const auto spring = numbers_after("spring", text); spring && spring->size() <= 2) {
    const double normal = (*spring)[0];
    const double along = spring->size() == 2 ? (*spring)[1] : normal / 3;
    if (normal > 0 && along >= 0) return {WallKind::spring, SupportStiffness{normal, along}};
  }
  throw input_error("--wall ", text,
                    ": give 'held', 'slide', 'slide:TANGENTIAL' or 'spring:NORMAL,TANGENTIAL' "
                    "in kPa/mm, where no number is negative and NORMAL is above 0; for example "
                    "slide:0.01");
}

CutOption parse_cut(const std::string& text) {
  if (text == "free") return {};
  if (text == "fixed") return Cut::fixed;
  if (text == "roller") return Cut::roller;
  for (const Cut kind : {Cut::spring, Cut::tissue}) {
    const auto spring = numbers_after(kind == Cut::spring ? "spring" : "tissue", text);
    if (!spring || spring->size() > 2 || !(spring->front() >= 0 && spring->back() > 0)) continue;
    const bool uniform = spring->size() == 1;
    return {kind, spring->front(), uniform ? std::nullopt : std::optional<double>(spring->back())};
  }
  throw input_error("--cut ", text,
                    ": give 'free', 'fixed', 'roller', 'spring:STIFFNESS' or "
                    "'spring:STIFFNESS,STERNAL' in kPa/mm above 0, or the same with 'tissue'; for "
                    "example spring:0.01");
}

std::string describe(const WallOption& wall) {
  switch (wall.kind) {
    case WallKind::held:
      return "held";
    case WallKind::slide:
      return "slide:" + format_number(wall.stiffness.tangential);
    case WallKind::spring:
      return "spring:" + format_number(wall.stiffness.normal) + "," +
             format_number(wall.stiffness.tangential);
  }
  return "";
}

std::string describe(const CutOption& cut) {
  switch (cut.kind) {
    case Cut::free:
      return "free";
    case Cut::fixed:
      return "fixed";
    case Cut::roller:
      return "roller";
    case Cut::spring:
    case Cut::tissue:
      return (cut.kind == Cut::spring ? "spring:" : "tissue:") + format_number(cut.stiffness) +
             (cut.sternal ? "," + format_number(*cut.sternal) : "");
  }
  return "";
}

}  // namespace breast
