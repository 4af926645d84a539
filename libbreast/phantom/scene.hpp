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

/// One breast. `mesh.reference` is stress-free; `mesh.points` = `mesh.imaged` is prone once solved, `mesh.points`
/// supine after lie_supine().
struct PhantomBreast {
  PhantomBreast(const PhantomParameters& parameters, const Torso& torso, Side side);
  PhantomBreast(const PhantomBreast&) = delete;
  PhantomBreast& operator=(const PhantomBreast&) = delete;

  /// As MeridianMap::inside_cut, of the shape in mesh.points.
  bool inside_cut(const Vec3& x, double margin) const {
    return supine_cut ? supine_cut->inside(x, margin) : map.inside_cut(x, margin);
  }
  /// Puts the breast into its supine shape, for imaging and truth; mesh.imaged stays prone.
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

/// A body laid down again lies elsewhere: shifted by `shift_mm` in a direction, and turned by `turn_deg` about an axis
/// through its sternum, that the phantom's seed draws.
RigidMotion misalignment(const PhantomScene& scene, double shift_mm, double turn_deg);

/// Tissue and fibroglandular fraction per element from 4³ samples of the gland.
void assign_gland(const GlandField& gland, HexMesh& mesh);
/// Landmarks as material points of the stress-free mesh: "nipple" (the axis' point on the skin),
/// "tumour" (a point on the gland's margin at mid depth, upper outer quadrant), "interior-01" ...
/// "interior-50" spread over the breast. Their imaged positions are those of mesh.imaged.
void place_landmarks(const PhantomBreast& breast, HexMesh& mesh);

}  // namespace breast
