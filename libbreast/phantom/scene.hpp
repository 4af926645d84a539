// SPDX-License-Identifier: GPL-3.0-or-later
// The complete phantom: a rigid thorax and two deformable breasts, stress-free and prone.
#pragma once

#include <memory>
#include <optional>

#include "core/progress.hpp"
#include "surface/rigid_motion.hpp"
#include "phantom/cut_outline.hpp"
#include "phantom/gland.hpp"
#include "phantom/template.hpp"

namespace breast {

/// One breast. `mesh.reference` is stress-free. Once solved, `mesh.imaged` is prone, and
/// `mesh.points` is prone or, after lie_supine(), supine.
struct PhantomBreast {
  PhantomBreast(const PhantomParameters& parameters, const Torso& torso, Side side);
  PhantomBreast(const PhantomBreast&) = delete;
  PhantomBreast& operator=(const PhantomBreast&) = delete;

  /// The counterpart of MeridianMap::inside_cut for the shape in mesh.points.
  bool inside_cut(const Vec3& x, double margin) const {
    return supine_cut ? supine_cut->inside(x, margin) : map.inside_cut(x, margin);
  }
  /// Gives the breast its supine shape, for imaging and truth; mesh.imaged remains prone.
  void lie_supine(const std::vector<Vec3>& points);

  BreastShape shape;
  MeridianMap map;
  GlandField gland;
  HexMesh mesh;
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
