// SPDX-License-Identifier: GPL-3.0-or-later
// The pictures of the pipeline, similar to Figs 4 to 7 of Pathmanathan et al. 2008.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "image/label_volume.hpp"
#include "image/volume.hpp"
#include "mesh/hex_mesh.hpp"
#include "projection/mammogram.hpp"
#include "surface/hermite.hpp"
#include "surface/tri_mesh.hpp"

namespace breast {

/// Input of a figure, in the order given by the user.
struct FigureInput {
  struct NamedMesh {
    std::string name;  ///< file name without folders, for messages
    HexMesh mesh;
  };
  std::vector<NamedMesh> meshes;
  std::vector<Mammogram> images;
  std::optional<BreastGeometry> geometry;
  std::vector<TriMesh> surfaces;    ///< data points of segment
  std::optional<PolyLines> curves;  ///< curves of cc2mlo
  std::optional<Volume<float>> scan;
  std::optional<LabelVolume> labels;  ///< segmentation of that scan
};

/// "slices", "points", "geometry", "mesh", "tissues", "outlines", "postures", "compression", "pressure",
/// "force-thickness", "mammogram", "matching", "summary".
const std::vector<std::string>& figure_names();
/// One line for the help about the content and the input of the figure.
std::string figure_summary(const std::string& name);
/// The content that .vtkhdf and .vtp files must have for this figure.
bool figure_takes_geometry(const std::string& name);
bool figure_takes_points(const std::string& name);

/// Draws a figure and writes it as PNG, on a display of its own. Throws Error (input) if an input
/// that the figure needs was not given.
void draw_figure(const std::string& name, const FigureInput& input,
                 const std::filesystem::path& file);

}  // namespace breast
