// SPDX-License-Identifier: GPL-3.0-or-later
// Resistance of the corners of elements to changes of volume, as a term. An 8-node element has one pressure, which
// keeps its mean volume only, and a 27-node element a linear one: laws of isochoric invariants hardly resist that one part of
// an element is flattened while another swells, and where the pressure is many times the shear modulus (15 times in a heavy
// breast of soft fat), such a change even lowers the energy. Between a plate's edge and the chest wall an element of soft
// tissue is pinched until it folds. 27-node elements resist at all their nodes, since between corners that resist the
// middle of an edge or face still turns inside out. In an incompressible body the term vanishes, so that its influence
// decreases as elements become smaller. To split the bulk modulus between mean and local volume is an old remedy for
// elements of this kind (Doll, Schweizerhof, Hauptmann, Freischlaeger 2000, Eng. Comput. 17:874).
#pragma once

#include <memory>

#include "mechanics/options.hpp"
#include "mesh/hex_mesh.hpp"
#include "solve/discretisation.hpp"
#include "solve/term.hpp"

namespace breast {

/// The energy Σ ¼ K V (ln J)⁴ over the nodes of each element: J is the relative volume there, V the node's share of the
/// stress-free element's volume (mm³: 8/N times the Jacobian there, of N nodes) and K that of the tissue
/// (MaterialSet::corner_bulk, Pa) times `factor`. `space` is that of the solid. Null if no tissue of the mesh resists.
std::shared_ptr<const Term> make_corner_volume(const HexMesh& mesh, const MechanicsOptions& options,
                                               const Discretisation& space, double factor = 1);

}  // namespace breast
