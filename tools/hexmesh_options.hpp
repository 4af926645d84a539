// SPDX-License-Identifier: GPL-3.0-or-later
// What hexmesh is asked on the command line.
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
  std::string shape = "dome", skin = "1.45", skin_as = "membrane", tumour = "auto",
              muscle = "0";
  int elements = 16, order = 1;
  bool accept_mismatch = false;
  std::vector<double> dome;  ///< n, l, m, k; empty: about `elements`^3

  BodyMeshOptions mesh_options(double skin_mm) const;
  /// Throws Error (input) for options that are not to be read or do not go together.
  void check() const;
};

/// All options of the tool, its description and examples.
void declare_hexmesh(Tool& tool, MeshChoices& choices);

}  // namespace breast
