// SPDX-License-Identifier: GPL-3.0-or-later
// The smallest change of a breast's stiffness, skin or support that gives a stable solution where
// there is none, confirmed by solving again.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "mechanics/options.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

struct Remedy {
  /// What is changed: "tissue" (all tissues but skin), "skin", or the springs of the support of "wall" or
  /// "cut".
  std::string what = "tissue";
  /// Factor on the present stiffness; 0 for a support that does not exist yet.
  double factor = 1;
  double support = 0;  ///< resulting stiffness of the support, kPa/mm

  /// "fat and glandular tissue 1.4 times as stiff".
  std::string words() const;
};

/// `options` with one stiffness multiplied by e^size. Springs that do not exist yet get (e^size − 1) times
/// the usual resistance to sliding; nothing if there can be none.
std::optional<MechanicsOptions> with_change(const MechanicsOptions& options,
                                            const std::string& what, double size);

/// Returns whether these options give a stable solution.
using Stands = std::function<bool(const MechanicsOptions&)>;

/// The smallest change, as a ratio of at most a hundred, that gives a stable solution, to about 10
/// %; nothing if no single change was found. `all_factor`: the factor by which everything together
/// must be stiffened; 0 if it is not known.
std::optional<Remedy> smallest_remedy(const HexMesh& mesh, const MechanicsOptions& options,
                                      const Stands& stands, double all_factor);

}  // namespace breast
