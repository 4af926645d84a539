// SPDX-License-Identifier: GPL-3.0-or-later
// The smallest change of a breast's stiffness, skin or support that gives a stable answer where
// there is none: found and confirmed by solving again.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "mechanics/options.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

/// What can be changed, one at a time.
enum class Changed {
  tissue,  ///< all tissues but skin
  skin,
  wall,    ///< the chest wall's resistance to sliding
  cut,     ///< the springs at the cut
};
/// "tissue", "skin", "wall", "cut".
const char* changed_name(Changed what);

struct Remedy {
  Changed what = Changed::tissue;
  /// Times the present stiffness; of a support that is not there, 0.
  double factor = 1;
  double support = 0;  ///< of wall and cut: the stiffness then, kPa/mm

  /// "fat and glandular tissue 1.4 times as stiff".
  std::string words() const;
};

/// `options` with one stiffness changed by the ratio e^size. A support that is not there gets
/// (e^size − 1) times the usual resistance to sliding.
MechanicsOptions with_change(const MechanicsOptions& options, Changed what, double size);

/// Whether these options give a stable answer.
using Stands = std::function<bool(const MechanicsOptions&)>;

/// Of all changes the smallest in ratio, up to a hundredfold, with which the answer is stable, each
/// change within about a tenth of itself; none where no single one was found. `all_factor`: how many
/// times stiffer everything together has to be; 0 where that is not known.
std::optional<Remedy> smallest_remedy(const HexMesh& mesh, const MechanicsOptions& options,
                                      const Stands& stands, double all_factor);

}  // namespace breast
