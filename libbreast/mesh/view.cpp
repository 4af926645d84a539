// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/view.hpp"

#include "core/error.hpp"

namespace breast {

namespace {

struct Entry {
  View view;
  const char *name, *column;
  double angle_deg;
};
constexpr Entry table[] = {
    {View::cc, "CC", "cc", 0}, {View::mlo, "MLO", "mlo", 45}, {View::ml, "ML", "ml", 90}};

// A value other than these three is an error in the program.
const Entry& entry(View view) {
  for (const Entry& known : table) {
    if (known.view == view) return known;
  }
  throw failed_error("view ", int(view), " is none of the ", std::size(table), " known");
}

}  // namespace

std::string view_name(View view) {
  return entry(view).name;
}

std::string view_column(View view) {
  return entry(view).column;
}

double view_angle_deg(View view) {
  return entry(view).angle_deg;
}

std::optional<View> view_from_name(std::string_view name) {
  for (const Entry& known : table) {
    if (known.name == name) return known.view;
  }
  return std::nullopt;
}

View view_named(std::string_view name) {
  if (const auto view = view_from_name(name)) return *view;
  throw input_error("unknown view '", name, "'; use CC, MLO or ML");
}

}  // namespace breast
