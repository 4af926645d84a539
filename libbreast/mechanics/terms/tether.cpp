// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/terms/tether.hpp"

#include "core/error.hpp"
#include "core/units.hpp"
#include "mesh/nodal.hpp"
#include "mesh/nodal_faces.hpp"

namespace breast {

Tether::Tether(const HexMesh& mesh, const std::vector<Face>& faces, double stiffness,
               const Vec3& towards, const std::function<double(const Vec3& normal)>& factor)
    : towards_(towards) {
  if (!(stiffness > 0)) {
    throw input_error("an attachment of ", stiffness, " kPa/mm: it must be above 0");
  }
  const NodalFaces spread = nodal_faces(mesh, faces, flatten(mesh.imaged), factor);
  cells_.nodes_per_cell = 1;
  for (const int node : nodes_of(mesh, faces)) {
    const double area = spread.area[std::size_t(node)];
    if (!(area > 0)) continue;
    cells_.nodes.push_back(node);
    stiffness_.push_back(stiffness * area * pascal_per_kilopascal);
  }
}

Tether::Pull Tether::pull(const State& state, int i) const {
  const long at = 3L * cells_.nodes[std::size_t(i)];
  const double away = (state.reference.segment<3>(at) - state.x.segment<3>(at)).dot(towards_);
  const double k = stiffness_[std::size_t(i)];
  if (away <= 0) return {};
  if (away < toe_mm) {
    return {k * away * away * away / (6 * toe_mm), k * away * away / (2 * toe_mm), k * away / toe_mm};
  }
  // The energy and force of the toe, and the spring beyond it.
  const double beyond = away - toe_mm;
  return {k * (toe_mm * toe_mm / 6 + toe_mm * beyond / 2 + beyond * beyond / 2),
          k * (toe_mm / 2 + beyond), k};
}

bool Tether::add(const State& state, const Request& request, Forces& forces) const {
  CellMatrices* reference =
      request.reference != nullptr ? &request.reference->next(cells_) : nullptr;
  PackedCells* packed = request.packed != nullptr ? &request.packed->next(cells_) : nullptr;
  for (int i = 0; i < cells_.count(); ++i) {
    const int node = cells_.nodes[std::size_t(i)];
    const Pull now = pull(state, i);
    const Vec3 force = -now.force * towards_;
    const Mat3 tangent = now.stiffness * towards_ * towards_.transpose();
    forces.r.segment<3>(3L * node) += force;
    if (request.kappa != nullptr) forces.augmented.segment<3>(3L * node) += force;
    forces.energy += now.energy;
    if (request.matrix != nullptr) {
      request.matrix->stiffness.add_to_node(node, tangent);
      request.matrix->diagonal.segment<3>(3L * node) += tangent.diagonal();
    }
    if (packed != nullptr) packed->set(i, tangent.data());
    if (reference != nullptr) Eigen::Map<Mat3>(reference->at(i)) = -tangent;
  }
  return true;
}

Eigen::VectorXd Tether::forces(const State& state) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(state.x.size());
  for (int i = 0; i < cells_.count(); ++i) {
    out.segment<3>(3L * cells_.nodes[std::size_t(i)]) = -pull(state, i).force * towards_;
  }
  return out;
}

Vec3 Tether::force_on_body(const State& state) const {
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < cells_.count(); ++i) sum += pull(state, i).force * towards_;
  return sum;
}

}  // namespace breast
