// SPDX-License-Identifier: GPL-3.0-or-later
// The hexahedral breast mesh that every mechanics tool reads and writes.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/provenance.hpp"
#include "core/types.hpp"
#include "mesh/model_text.hpp"
#include "surface/hermite.hpp"
#include "views/view.hpp"

namespace breast {

/// A face of the boundary: its element, and its local face in the VTK order of the hexahedron: 0
/// −ξ, 1 +ξ, 2 −η, 3 +η, 4 −ζ, 5 +ζ.
struct Face {
  int element = 0;
  int local = 0;
};

/// Local corner nodes of each face, ordered so that the right-hand normal points out of the element
/// (VTK node order of the 8-node hexahedron).
inline constexpr std::array<std::array<int, 4>, 6> hex_face_corners = {{
    {0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}}};

/// A material point: the same imaged point for every mesh of one geometry.
struct Landmark {
  std::string name;         ///< "tumour", "nipple", ...
  Vec3 imaged{0, 0, 0};     ///< mm, LPS, the requested point
  int element = -1;         ///< containing element of the imaged mesh
  Vec3 local{0, 0, 0};      ///< (ξ,η,ζ) in [-1,1]^3
  double moved = 0;         ///< mm moved to reach the mesh (0 when inside)
};

enum class SkinModel : std::uint8_t { none = 0, membrane = 1, layer = 2 };

/// Result of compress for one plate (file group /breast/contact).
struct PlateRecord {
  std::string name;             ///< "paddle" or "detector"
  Vec3 normal{0, 0, 1};         ///< unit, from the plate into the gap
  Vec3 anterior{0, -1, 0};      ///< unit, in the plate, away from the chest wall
  Vec3 origin{0, 0, 0};         ///< point of the flat where the rounded edge starts, mid-width
  double edge_radius = 0;       ///< mm
  double force_N = 0, area_cm2 = 0, mean_kPa = 0, peak_kPa = 0;
  /// Greatest penetration of the plate by the body, mm, over sampled points of every free boundary
  /// face.
  double worst_gap_mm = 0;
};
/// A node that is held by the friction of a plate in the compressed state.
struct FrictionRecord {
  int node = 0, plate = 0;
  Vec3 anchor{0, 0, 0};  ///< mm
  double bound = 0;      ///< largest friction force, µN
  double stick = 0;      ///< stiffness of the anchor spring, µN/mm
};
struct ContactRecord {
  View view = View::cc;
  double angle_deg = 0;  ///< beam angle θ, degrees from craniocaudal
  /// Angle by which the plates' edge is turned towards the breast's side about the patient's long
  /// axis.
  double turn_deg = 0;
  /// Angle by which it is turned about the beam, with its upper end backwards.
  double lean_deg = 0;
  /// Whether the image ends at the plates' edge, as in the clinic, or at the chest wall.
  bool ends_image = false;
  /// Stiffness of the plates against faces, Pa/mm; 0: exact contact at nodes.
  double surface_stiffness = 0;
  /// The number of the set of quadrature points of every face that may touch; empty in files that
  /// lack it.
  std::vector<int> face_rules;
  double thickness_mm = 0, reduction_percent = 0, initial_thickness_mm = 0, standoff_mm = 0;
  std::vector<PlateRecord> plates;
  std::vector<FrictionRecord> friction;  ///< in surface contact with friction
  /// Share of the paddle in any further closing: one half, or one if the detector has reached its
  /// highest position.
  double paddle_share = 0.5;
  /// The path of the compression: thickness, and the force of paddle and detector (the latter may
  /// be empty).
  std::vector<double> path_thickness_mm, path_force_N, path_detector_N;
};

/// One row of the iterations table.
struct IterationRecord {
  int step = 0, iteration = 0;
  double residual = 0, min_det_F = 0, max_det_F = 0, step_length = 0, seconds = 0;
};
enum class SolveStatus {
  converged,
  stopped_early,  ///< compress: a valid equilibrium before the target
  unstable,       ///< backward: an equilibrium, but an unstable one
  not_converged,
};
/// Name of a status in files and reports, and its inverse, which has no value for any other text.
const char* status_name(SolveStatus status);
std::optional<SolveStatus> status_from_name(const std::string& name);
struct SolveRecord {
  SolveStatus status = SolveStatus::not_converged;
  std::string reason;  ///< empty when converged
  std::vector<IterationRecord> iterations;
};

/// Hexahedra of order 1 (8 nodes, VTK_HEXAHEDRON) or 2 (27 nodes, VTK_TRIQUADRATIC_HEXAHEDRON), node
/// order as VTK. Arrays per node or element are either empty (absent) or of full length.
struct HexMesh {
  int order = 1;
  std::vector<Vec3> points;     ///< the shape that this file describes
  std::vector<Vec3> imaged;     ///< the MR frame, copied unchanged by every tool
  std::vector<Vec3> reference;  ///< stress-free shape, from backward on
  std::vector<int> connectivity;
  /// Numbers of the elements and nodes in the whole mesh, ascending, if this is a part of one; empty
  /// otherwise.
  std::vector<int> element_numbers, node_numbers;

  std::vector<Tissue> tissue;                  ///< per element
  std::vector<float> fibroglandular_fraction;  ///< per element, may be empty
  std::vector<double> pressure;                ///< Pa, per element
  std::vector<double> det_F;                   ///< per element mean
  std::vector<double> scaled_jacobian;         ///< per element minimum over corners, of `points`
  std::vector<double> contact_pressure;        ///< kPa per node, compress only

  std::vector<Face> skin_faces, pectoral_faces, cut_faces;  ///< disjoint, cover the boundary
  int tumour_node = -1, nipple_node = -1;                   ///< nearest nodes (paper mode)
  std::vector<Landmark> landmarks;

  SkinModel skin_model = SkinModel::none;
  std::vector<double> skin_thickness;  ///< mm per skin face; membrane only

  Side side = Side::left;
  std::string template_name;           ///< "dome", "cuboid", ...
  std::array<int, 4> template_size{0, 0, 0, 0};
  std::optional<BreastGeometry> geometry;  ///< group /breast/hermite
  std::optional<ModelText> model;  ///< with which `points` was solved; none: not stated
  std::optional<SolveRecord> solve;
  std::optional<ContactRecord> contact;
  Vec3 gravity{0, 0, 0};               ///< mm/s^2 acting on `points` (0 for reference)
  double wall_seconds = 0;
  History history;
  std::string content_sha256;          ///< filled by the reader

  int nodes_per_element() const { return order == 1 ? 8 : 27; }
  int elements() const { return int(connectivity.size()) / nodes_per_element(); }
  int nodes() const { return int(points.size()); }
  const int* element(int e) const { return connectivity.data() + std::size_t(e) * nodes_per_element(); }
  const Landmark* landmark(std::string_view name) const;
};

/// Outward-ordered nodes of a boundary face: 4 corners (order 1) or 9 nodes (order 2: corners, edges,
/// centre, as VTK_BIQUADRATIC_QUAD).
std::vector<int> face_nodes(const HexMesh& mesh, const Face& face);
/// Sorted unique nodes of a face set.
std::vector<int> nodes_of(const HexMesh& mesh, const std::vector<Face>& faces);
/// All boundary faces (faces used by exactly one element).
std::vector<Face> boundary_faces(const HexMesh& mesh);
/// Position of local coordinates in the given nodal field (isoparametric).
Vec3 element_position(const HexMesh& mesh, const std::vector<Vec3>& nodal, int element,
                      const Vec3& local);
/// Position of a landmark in the given nodal field (mesh.points, mesh.imaged, mesh.reference).
Vec3 landmark_position(const HexMesh& mesh, const std::vector<Vec3>& nodal, const Landmark& landmark);

}  // namespace breast
