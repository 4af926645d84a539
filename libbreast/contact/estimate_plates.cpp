// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/estimate_plates.hpp"

#include "contact/solvers/raise_friction.hpp"

namespace breast {

namespace {

std::vector<TouchingNode> touching_nodes(const ContactSolver& contact, const PlatePair& pair,
                                         const State& state) {
  std::vector<TouchingNode> touching;
  for (std::size_t c = 0; c < contact.candidates().size(); ++c) {
    const int node = contact.candidates()[c], plate = contact.touching()[c];
    if (plate < 0) continue;
    const Gap gap = pair.plate(plate).gap(state.x.segment<3>(3L * node));
    touching.push_back({node, plate, gap.gradient});
  }
  return touching;
}

}  // namespace

ContactEstimate estimate_of_nodes(const ContactSolver& contact, const PlatePair& pair,
                                  const std::shared_ptr<FrictionTerm>& friction,
                                  const HexMesh& mesh, const State& state) {
  ContactEstimate plates;
  plates.touching = touching_nodes(contact, pair, state);
  if (friction) {
    plates.plates = friction;
    plates.raise_plates = [friction, &mesh, &state](const RicherMesh& richer) {
      return raise_friction(*friction, mesh, state.x, richer);
    };
  }
  return plates;
}

}  // namespace breast
