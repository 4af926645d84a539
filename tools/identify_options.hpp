// SPDX-License-Identifier: GPL-3.0-or-later
// The command-line options of identify.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/mechanics_options.hpp"

namespace breast {

struct IdentifyChoices {
  std::filesystem::path mesh, set, landmarks, second_landmarks, surface, forces, labels,
      second_labels, judge, table, second, seen;
  std::vector<std::string> compare;
  std::vector<double> nipple, align_deviation{4, 2};
  double observer = 2.5, surface_error = 2, outside = 10;
  double standoff = 5, edge_radius = 5;
  std::string parameters, prior = "set", view = "CC";
  bool align = false;
  int pairs = 25;
  GravityChoices gravity{"supine", {}};
  MechanicsChoices mechanics = {};

  void check() const;
  std::vector<std::string> names() const;
};

void declare_identify(Tool& tool, IdentifyChoices& choices);

}  // namespace breast
