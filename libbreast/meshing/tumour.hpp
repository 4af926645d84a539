// SPDX-License-Identifier: GPL-3.0-or-later
// Choice of the tumour's position, and the landmarks of a mesh.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "image/label_volume.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

struct Tumour {
  Vec3 centre{0, 0, 0};     ///< mm, LPS, MR frame
  double radius = 0;        ///< mm; 0: a point, no element becomes tumour
  std::string origin;       ///< how it was chosen, for the report
  bool artificial = false;  ///< not found in the scan: its landmark is called artificial_tumour
};

/// The tumour of the labels (landmark "tumour", otherwise the centroid of tumour voxels), otherwise
/// an artificial one. The artificial tumour lies on the edge of the fibroglandular region and
/// inside the mesh, as close as possible to the upper outer part of the region (centroid + 0.7 rms
/// radius laterally and superiorly). It is at least 8 mm from skin and chest wall of the labels and
/// 5 mm from the boundary of the mesh; if there is no such point, it is only 5 or 2 mm from that
/// boundary. The mesh only excludes points outside it, so that meshes of one geometry share the
/// imaged point. No value if no edge of fibroglandular tissue lies inside the mesh.
std::optional<Tumour> automatic_tumour(const LabelVolume& labels, const HexMesh& mesh);

/// Parses "x,y,z" or "x,y,z:radius" (mm). Throws Error (input).
Tumour parse_tumour(const std::string& text);

/// Reads the first row of a table with columns x_mm y_mm z_mm and optionally radius_mm. Throws
/// Error (input).
Tumour read_tumour(const std::filesystem::path& file);

/// Centroid of the tumour voxels of other labels in the same frame, with the radius of the ball of
/// their volume. Throws Error (input) if there are no such voxels; `name` is used in the message.
Tumour tumour_of(const LabelVolume& labels, const std::string& name);

/// Adds the landmark nipple: the nipple of the geometry, located on the skin faces; sets
/// nipple_node. Needs mesh.geometry.
void add_nipple(HexMesh& mesh);

/// Adds a landmark at the material point nearest to `at` (mm, LPS, imaged shape). Throws Error
/// (input) if `at` lies more than `max_moved` mm outside the mesh.
void add_landmark(const std::string& name, const Vec3& at, HexMesh& mesh, double max_moved = 10);

/// Adds the landmark "tumour" (or "artificial_tumour", mesh/landmark_names.hpp) and sets
/// tumour_node. With a radius, elements with at least half of their volume inside the ball become
/// tumour, and so does the element that contains the centre. Throws Error (input) if the centre
/// lies more than `max_moved` mm outside the mesh.
void add_tumour(const Tumour& tumour, HexMesh& mesh, double max_moved = 10);

}  // namespace breast
