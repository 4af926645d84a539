// SPDX-License-Identifier: GPL-3.0-or-later
// The files of a run that 3D Slicer is to show.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/tool.hpp"
#include "image/label_volume.hpp"
#include "mesh/hex_mesh.hpp"
#include "surface/tri_mesh.hpp"

namespace breast {

/// One shape of the breast.
struct RunState {
  std::string name;   ///< of its files: prone, stress-free, supine, cc, mlo
  std::string title;  ///< for people
  std::filesystem::path file;
  HexMesh mesh;
};

struct SlicerRun {
  LabelVolume labels;
  std::vector<RunState> states;  ///< prone first, then those there are
  std::optional<PolyLines> curve;
  std::optional<Volume<float>> scan;
  std::vector<Run::Input> inputs;

  const RunState& prone() const { return states.front(); }
};

/// Reads labels, mesh and whatever of reference, supine, cc, mlo and curve.vtp is there; `scan` may be empty. Throws
/// Error (input) for a folder without labels or mesh, states of different meshes, and a scan that is not the one the
/// labels were made from.
SlicerRun read_run(const std::filesystem::path& folder, const std::filesystem::path& scan,
                   int series, Run& run);

}  // namespace breast
