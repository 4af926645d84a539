// SPDX-License-Identifier: GPL-3.0-or-later
// Resistance of the corners of elements to changes of volume, as a term. An 8-node element has one pressure, which
// keeps its mean volume only, and a 27-node element a linear one: laws of isochoric invariants hardly resist that one corner is
// flattened while another swells, and between a plate's edge and the chest wall an element of soft tissue is
// pinched until it folds. In an incompressible body the term vanishes, so that its influence decreases as
// elements become smaller. To split the bulk modulus between mean and local volume is an old remedy for
// elements of this kind (Doll, Schweizerhof, Hauptmann, Freischlaeger 2000, Eng. Comput. 17:874).
#pragma once

#include <memory>

#include "mechanics/options.hpp"
#include "mesh/hex_mesh.hpp"
#include "solve/discretisation.hpp"
#include "solve/term.hpp"

namespace breast {

/// The energy Σ ¼ K V (ln J)⁴ over the corners of all elements: J is the relative volume at the corner, V the
/// Jacobian of the stress-free element there (mm³, an eighth of the volume that its three edges span) and K
/// that of the tissue (MaterialSet::corner_bulk, Pa). `space` is that of the solid. Null if no tissue of the mesh resists.
std::shared_ptr<const Term> make_corner_volume(const HexMesh& mesh, const MechanicsOptions& options,
                                               const Discretisation& space);

}  // namespace breast
