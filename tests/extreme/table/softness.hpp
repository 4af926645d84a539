// SPDX-License-Identifier: GPL-3.0-or-later
// The breast from as stiff as ex-vivo tissue to two hundred times softer, on every wall and in every
// skin: defined once, for the tests on a small cap and for the program that prints the table of a mesh.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mechanics/mechanics.hpp"

namespace breast::extreme {

enum class SkinCase {
  paper,          ///< Table II of the paper, its law in compression too
  tension_field,  ///< the same stretched by 3 % at rest, 5 % of it left in compression
  stiff,          ///< ten times the paper's
};

struct Softness {
  double percent = 100;  ///< of Table II: fat and fibroglandular tissue
  bool slides = false;   ///< along the wall, springs at wall and cut; otherwise held, the cut free
  SkinCase skin = SkinCase::paper;

  std::string name() const;
  /// `surface`: what to slide on; null: that of the mesh's geometry.
  MechanicsOptions options(std::shared_ptr<const LevelSurface> surface = nullptr) const;
};

/// 100 to 0.5 % of Table II, held and sliding, in all three skins.
std::vector<Softness> softness_cells();

/// A cell solved: backward from the imaged prone shape, and from the body found forward to supine
/// and forward to prone again, which closes on the imaged shape. Without a body backward alone.
struct SoftnessRow {
  Equilibrium backward, supine, prone;
  bool has_body = false;
  double closure_mm = 0;
};
SoftnessRow solve(HexMesh mesh, const MechanicsOptions& options);

}  // namespace breast::extreme
