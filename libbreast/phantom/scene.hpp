// SPDX-License-Identifier: GPL-3.0-or-later
// The complete phantom: a rigid thorax and two deformable breasts, stress-free and prone.
#pragma once

#include <memory>
#include <optional>

#include "core/progress.hpp"
#include "phantom/cut_outline.hpp"
#include "phantom/gland.hpp"
#include "phantom/template.hpp"
#include "surface/rigid_motion.hpp"

namespace breast {

/// One breast. `mesh.reference` is stress-free. Once solved, `mesh.imaged` is prone, and
/// `mesh.points` is prone or, after lie_supine(), supine. A body that slides goes on at its side past
/// the cut in the prone image (BodyParameters::beyond); its prone image is made from `seen`, which
/// ends there and has the same elements, with the same nodes up to the fold.
struct PhantomBreast {
  PhantomBreast(const PhantomParameters& parameters, const Torso& torso, Side side);
  PhantomBreast(const PhantomBreast&) = delete;
  PhantomBreast& operator=(const PhantomBreast&) = delete;

  /// The counterpart of MeridianMap::inside_cut for the shape in mesh.points.
  bool inside_cut(const Vec3& x, double margin) const {
    return supine_cut ? supine_cut->inside(x, margin) : map.inside_cut(x, margin);
  }
  /// The mesh in which the image shows breast: all of a supine body, a prone one up to `map`'s rim.
  const HexMesh& imaged_mesh() const { return seen && !supine_cut ? *seen : mesh; }
  const MeridianMap& body_map() const { return wider ? *wider : map; }
  /// Gives the breast its supine shape, for imaging and truth; mesh.imaged remains prone.
  void lie_supine(const std::vector<Vec3>& points);

  BreastShape shape;
  MeridianMap map;                   ///< up to the cut in the image
  std::optional<MeridianMap> wider;  ///< up to the cut of the body, where that is another
  GlandField gland;
  HexMesh mesh;
  std::optional<HexMesh> seen;
  std::optional<CutOutline> supine_cut;
};

struct PhantomScene {
  explicit PhantomScene(const PhantomParameters& parameters);
  const PhantomBreast& breast(Side side) const { return side == Side::left ? *left : *right; }
  PhantomBreast& breast(Side side) { return side == Side::left ? *left : *right; }

  PhantomParameters parameters;
  Torso torso;
  std::unique_ptr<PhantomBreast> left, right;
};

/// The motion of a body that lies down again: shifted by `shift_mm` in a random direction and
/// rotated by `turn_deg` about a random axis through its sternum, both drawn from the phantom's
/// seed.
RigidMotion misalignment(const PhantomScene& scene, double shift_mm, double turn_deg);

/// Tissue and fibroglandular fraction per element from 4³ samples of the gland.
void assign_gland(const GlandField& gland, HexMesh& mesh);
/// Landmarks as material points of the stress-free mesh: "nipple" (the axis' point on the skin),
/// "tumour" (a point on the gland's margin at mid depth, upper outer quadrant), "interior-01" ...
/// "interior-50" spread over the breast. Their imaged positions are those of mesh.imaged.
void place_landmarks(const PhantomBreast& breast, HexMesh& mesh);

}  // namespace breast
