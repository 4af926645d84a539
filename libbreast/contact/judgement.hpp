// SPDX-License-Identifier: GPL-3.0-or-later
// Comparison of a compression with clinical practice: each quantity against its clinical range, and
// whether the two plates press on the breast alone.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "contact/compressed_shape.hpp"
#include "contact/path/path.hpp"
#include "core/types.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

/// One statement about a result. `id` is stable ("paddle_force_above"), the sentence is not.
struct Judgement {
  std::string id, sentence;
  bool doubtful = false;  ///< to be read before the result is used
  /// A compression that stopped before its target is accepted only if this is no doubt.
  bool decides = false;
};

/// Where a plate presses on the breast.
struct PressedPlace {
  Vec3 peak_at{0, 0, 0};        ///< of the highest pressure, mm
  double peak_to_wall_mm = -1;  ///< to the nearest chest-wall or cut node; negative: no contact
  double edge_part = 0;         ///< share of the normal force that acts on the rounded edge
  /// Normal force behind the edge of the image, in the first 20 mm in front of it, and beyond, N.
  double behind_edge_N = 0, first_20mm_N = 0, beyond_20mm_N = 0;
};

/// Quantities that are judged besides the contact record.
struct PressedState {
  Vec3 beam{0, 0, -1};  ///< n, from paddle to detector
  /// Forces on the body, N; the wall's reaction includes that of a held cut.
  Vec3 weight_N{0, 0, 0}, wall_reaction_N{0, 0, 0};
  double max_volume_error = 0;
  std::vector<PressedPlace> places;  ///< per plate of the record
  SelfContact self;
  double projected_cm2 = 0;            ///< of the breast in front of the plates' edge
  double volume_in_front_percent = 0;  ///< of the breast
  double min_scaled_jacobian = 1;
};

/// Force and mean pressure of both plates, thickness, penetration, volume and, between plates that are
/// placed by the edge of the image, the share of the breast in the image and the shape of the elements
/// against the ranges of clinical practice; the share of the rounded edge or the grip (judge_grip);
/// finally the balance of the plates.
std::vector<Judgement> judge_compression(const ContactRecord& contact, const PressedState& state);
/// A statement if the quantity that ended the path differs from its target in the final, accurately
/// solved state (`reached`); it is a doubt if the difference is a quarter or more, and absent
/// within 2 %. The contact area changes by whole nodes.
std::optional<Judgement> judge_target(const CompressionTarget& met, double reached);
/// Comments on the closing of the plates: an indefinite tangent (a doubt unless the final state is
/// `stable`), a snap-through past the target, friction bounds that do not follow the pressure.
std::vector<Judgement> judge_path(const PathResult& path, bool stable);

}  // namespace breast
