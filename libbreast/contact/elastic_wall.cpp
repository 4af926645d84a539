#include "contact/elastic_wall.hpp"

#include <Eigen/Geometry>

#include "contact/skin_area.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "mechanics/assembly.hpp"

namespace breast {

ElasticWall::ElasticWall(const HexMesh& mesh, const WallSprings& springs) {
  if (!(springs.normal > 0 && springs.tangential >= 0)) {
    throw input_error("chest wall springs of ", springs.normal, " and ", springs.tangential,
                      " kPa/mm: the first must be above 0, the second 0 or more");
  }
  const NodalFaces wall = nodal_faces(mesh, mesh.pectoral_faces, flatten(mesh.imaged));
  for (const int node : nodes_of(mesh, mesh.pectoral_faces)) {
    const double size = wall.area[std::size_t(node)] * pascal_per_kilopascal;
    const Vec3 n = wall.vector[std::size_t(node)].normalized();
    const Mat3 along = n * n.transpose();
    springs_.push_back(
        {node, mesh.reference[std::size_t(node)],
         size * (springs.normal * along + springs.tangential * (Mat3::Identity() - along))});
  }
}

double ElasticWall::add_forces(const Eigen::VectorXd& x, Eigen::VectorXd& residual) const {
  double energy = 0;
  for (const Spring& spring : springs_) {
    const Vec3 moved = x.segment<3>(3L * spring.node) - spring.rest;
    const Vec3 force = spring.stiffness * moved;
    residual.segment<3>(3L * spring.node) += force;
    energy += 0.5 * moved.dot(force);
  }
  return energy;
}

void ElasticWall::add_stiffness(SaddleMatrix& matrix) const {
  for (const Spring& spring : springs_) {
    matrix.stiffness.add_to_node(spring.node, spring.stiffness);
    matrix.diagonal.segment<3>(3L * spring.node) += spring.stiffness.diagonal();
  }
}

Vec3 ElasticWall::force_on_body(const Eigen::VectorXd& x) const {
  Vec3 sum = Vec3::Zero();
  for (const Spring& spring : springs_) {
    sum -= spring.stiffness * (x.segment<3>(3L * spring.node) - spring.rest);
  }
  return sum;
}

SaddleForces ProblemOnWall::forces(const SaddleState& state, const Eigen::VectorXd* kappa) const {
  SaddleForces forces = body_.forces(state, kappa);
  if (!forces.valid) return forces;
  forces.energy += wall_.add_forces(state.u, forces.r);
  if (kappa != nullptr) wall_.add_forces(state.u, forces.augmented);
  return forces;
}

bool ProblemOnWall::tangent(const SaddleState& state, SaddleForces& forces,
                            SaddleMatrix& matrix) const {
  if (!body_.tangent(state, forces, matrix)) return false;
  forces.energy += wall_.add_forces(state.u, forces.r);
  wall_.add_stiffness(matrix);
  return true;
}

}  // namespace breast
