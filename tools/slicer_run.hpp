// SPDX-License-Identifier: GPL-3.0-or-later
// The files of a run that are exported to 3D Slicer.
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
  std::string name;   ///< name in file names: prone, stress-free, supine, cc, mlo
  std::string title;  ///< title shown to the user
  std::filesystem::path file;
  HexMesh mesh;
};

struct SlicerRun {
  LabelVolume labels;
  std::vector<RunState> states;  ///< prone first, then the other available states
  std::optional<PolyLines> curve;
  std::optional<Volume<float>> scan;
  std::filesystem::path labels_file, curve_file, scan_file;
  std::string scan_sha256;

  const RunState& prone() const { return states.front(); }
  /// What was read; it points into this object, and is therefore made anew for every caller.
  std::vector<Run::Input> inputs() const;
};

/// Reads labels and mesh, and reference, supine, cc, mlo and curve.vtp if they exist; `scan` may be
/// empty. Throws Error (input) for a folder without labels or mesh, states of different meshes, and
/// a scan other than the one from which the labels were made.
SlicerRun read_run(const std::filesystem::path& folder, const std::filesystem::path& scan,
                   int series, Run& run);

}  // namespace breast
