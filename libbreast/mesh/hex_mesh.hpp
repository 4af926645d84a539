// SPDX-License-Identifier: GPL-3.0-or-later
// The hexahedral breast mesh that every mechanics tool reads and writes: what the body is
// (mesh/topology.hpp), a shape of it, and where both came from.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/provenance.hpp"
#include "mesh/contact_record.hpp"
#include "mesh/model_text.hpp"
#include "mesh/solve_record.hpp"
#include "mesh/topology.hpp"
#include "surface/hermite.hpp"

namespace breast {

/// A shape of the body, the shapes that it is compared with, and what its solution found. Arrays per
/// node or element are either empty (absent) or of full length.
struct MeshShape {
  std::vector<Vec3> points;     ///< the shape that this file describes
  std::vector<Vec3> imaged;     ///< the MR frame, copied unchanged by every tool
  std::vector<Vec3> reference;  ///< stress-free shape, from backward on
  Vec3 gravity{0, 0, 0};        ///< mm/s^2 acting on `points` (0 for reference)

  std::vector<double> pressure;          ///< Pa, per element
  std::vector<double> det_F;             ///< per element mean
  std::vector<double> scaled_jacobian;   ///< per element minimum over corners, of `points`
  std::vector<double> contact_pressure;  ///< kPa per node, compress only

  std::optional<ModelText> model;  ///< with which `points` was solved; none: not stated
  std::optional<SolveRecord> solve;
  std::optional<ContactRecord> contact;

  int nodes() const { return int(points.size()); }
};

/// Where a mesh and its shape came from.
struct MeshOrigin {
  std::string template_name;  ///< "dome", "cuboid", ...
  std::array<int, 4> template_size{0, 0, 0, 0};
  std::optional<BreastGeometry> geometry;  ///< group /breast/hermite
  History history;
  double wall_seconds = 0;     ///< of the tool that made the file
  std::string content_sha256;  ///< filled by the reader
};

/// The three together, as a file holds them. What needs one of them takes that one.
struct HexMesh : HexTopology, MeshShape, MeshOrigin {};

}  // namespace breast
