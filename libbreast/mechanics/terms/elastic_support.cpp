#include "mechanics/terms/elastic_support.hpp"

#include "core/error.hpp"
#include "core/units.hpp"
#include "mesh/nodal.hpp"
#include "mesh/nodal_faces.hpp"

namespace breast {

ElasticSupport::ElasticSupport(const HexMesh& mesh, const std::vector<Face>& faces,
                               const SupportStiffness& stiffness) {
  if (!(stiffness.normal > 0 && stiffness.tangential >= 0)) {
    throw input_error("chest wall springs of ", stiffness.normal, " and ", stiffness.tangential,
                      " kPa/mm: the first must be above 0, the second 0 or more");
  }
  const NodalFaces spread = nodal_faces(mesh, faces, flatten(mesh.imaged));
  cells_.nodes_per_cell = 1;
  cells_.nodes = nodes_of(mesh, faces);
  for (const int node : cells_.nodes) {
    const double area = spread.area[std::size_t(node)] * pascal_per_kilopascal;
    const Vec3 n = spread.vector[std::size_t(node)].normalized();
    const Mat3 across = n * n.transpose();
    stiffness_.push_back(area * (stiffness.normal * across +
                                 stiffness.tangential * (Mat3::Identity() - across)));
  }
}

Vec3 ElasticSupport::stretch(const State& state, int spring) const {
  const long at = 3L * cells_.nodes[std::size_t(spring)];
  return state.x.segment<3>(at) - state.reference.segment<3>(at);
}

bool ElasticSupport::add(const State& state, const Request& request, Forces& forces) const {
  CellMatrices* reference =
      request.reference != nullptr ? &request.reference->next(cells_) : nullptr;
  PackedCells* packed = request.packed != nullptr ? &request.packed->next(cells_) : nullptr;
  for (int i = 0; i < cells_.count(); ++i) {
    const int node = cells_.nodes[std::size_t(i)];
    const Mat3& stiffness = stiffness_[std::size_t(i)];
    const Vec3 moved = stretch(state, i), force = stiffness * moved;
    forces.r.segment<3>(3L * node) += force;
    if (request.kappa != nullptr) forces.augmented.segment<3>(3L * node) += force;
    forces.energy += 0.5 * moved.dot(force);
    if (request.matrix != nullptr) {
      request.matrix->stiffness.add_to_node(node, stiffness);
      request.matrix->diagonal.segment<3>(3L * node) += stiffness.diagonal();
    }
    if (packed != nullptr) packed->set(i, stiffness.data());
    if (reference != nullptr) Eigen::Map<Mat3>(reference->at(i)) = -stiffness;
  }
  return true;
}

Eigen::VectorXd ElasticSupport::forces(const State& state) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(state.x.size());
  for (int i = 0; i < cells_.count(); ++i) {
    out.segment<3>(3L * cells_.nodes[std::size_t(i)]) =
        stiffness_[std::size_t(i)] * stretch(state, i);
  }
  return out;
}

Vec3 ElasticSupport::force_on_body(const State& state) const {
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < cells_.count(); ++i) sum -= stiffness_[std::size_t(i)] * stretch(state, i);
  return sum;
}

}  // namespace breast
