// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/equilibrium.hpp"

#include "mesh/quality.hpp"

namespace breast {

void store(const Equilibrium& equilibrium, HexMesh& mesh) {
  if (!equilibrium.points.empty()) {
    mesh.reference = equilibrium.reference;
    mesh.points = equilibrium.points;
    mesh.pressure = equilibrium.pressure;
    mesh.det_F = equilibrium.det_F;
    mesh.scaled_jacobian = scaled_jacobians(mesh, mesh.points);
  }
  mesh.gravity = equilibrium.gravity;
  mesh.contact = equilibrium.contact;
  mesh.contact_pressure = equilibrium.contact_pressure;
  mesh.solve = equilibrium.record;
}

}  // namespace breast
