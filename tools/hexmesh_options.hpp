// SPDX-License-Identifier: GPL-3.0-or-later
// The command-line options of hexmesh.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/tool.hpp"
#include "label_input.hpp"
#include "meshing/body_mesh.hpp"

namespace breast {

struct MeshChoices {
  std::filesystem::path geometry, labels, mesh, surface, tetrahedra, landmarks;
  LabelChoices foreign;
  std::string shape = "dome", skin = "1.45", skin_as = "membrane", tumour = "auto", muscle = "0";
  int elements = 16, order = 1;
  double surroundings_mm = 0;
  bool accept_mismatch = false;
  std::vector<double> dome;  ///< n, l, m, k; empty for about `elements`^3 elements

  BodyMeshOptions mesh_options(double skin_mm) const;
  /// Throws Error (input) if options cannot be parsed or contradict each other.
  void check() const;
};

/// Declares all options of the tool, its description and examples.
void declare_hexmesh(Tool& tool, MeshChoices& choices);

}  // namespace breast
