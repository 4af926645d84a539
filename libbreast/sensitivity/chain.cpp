// SPDX-License-Identifier: GPL-3.0-or-later
#include "sensitivity/chain.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <limits>

#include "contact/faces.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "mesh/shape.hpp"

namespace breast {

namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Mean pressures as the constants of each element's pressure basis.
Eigen::VectorXd pressures(const Scene& scene, const std::vector<double>& mean,
                          const std::string& what) {
  const int rows = scene.solid().space()->pressures->rows;
  if (int(mean.size()) != scene.mesh().elements()) {
    throw input_error(what,
                      ": the file has no pressures (dataset /VTKHDF/CellData/pressure); make it "
                      "with backward, forward or compress");
  }
  Eigen::VectorXd p = Eigen::VectorXd::Zero(long(rows) * long(mean.size()));
  for (std::size_t e = 0; e < mean.size(); ++e) p[long(rows) * long(e)] = mean[e];
  return p;
}

LoadedState imaged_state(const Scene& scene, const std::vector<double>& pressure,
                         const Vec3& gravity) {
  const HexMesh& mesh = scene.mesh();
  return {{flatten(mesh.reference), flatten(mesh.imaged),
           pressures(scene, pressure, "the imaged shape")},
          gravity};
}

LoadedState deformed_state(const Scene& scene) {
  const HexMesh& mesh = scene.mesh();
  return {{flatten(mesh.reference), flatten(mesh.points),
           pressures(scene, mesh.pressure, "the deformed shape")},
          mesh.gravity};
}

std::vector<PlateContact> contacts_of(const HexMesh& mesh, const PlatePair& plates) {
  if (!mesh.contact || mesh.contact->surface_stiffness > 0) return {};
  std::vector<PlateContact> contacts = recorded_contacts(mesh, plates);
  for (const PlateContact& contact : contacts) {
    if (!(std::abs(contact.gap.value) <= 1e-5)) {
      throw input_error("node ", contact.node, " presses on the ", plates.plate(contact.plate).name,
                        " at a distance of ", contact.gap.value,
                        " mm: only exact contact (--contact active-set) has these derivatives");
    }
  }
  return contacts;
}

// The plates' pressure on faces at the state of the file; null where nodes touch.
std::shared_ptr<SurfacePressure> recorded_pressure(const Scene& scene, const PlatePair& plates) {
  const HexMesh& mesh = scene.mesh();
  if (!mesh.contact || !(mesh.contact->surface_stiffness > 0)) return nullptr;
  auto pressure =
      std::make_shared<SurfacePressure>(mesh, touchable_faces(mesh), *scene.solid().space());
  pressure->set_plates(plates);
  pressure->set_stiffness(mesh.contact->surface_stiffness);
  pressure->set_turning_depth(std::numeric_limits<double>::infinity());
  if (mesh.contact->face_rules.empty()) {
    pressure->choose_points(flatten(mesh.points));
  } else if (!pressure->set_face_rules(mesh.contact->face_rules)) {
    throw input_error("contact record: the ", mesh.contact->face_rules.size(),
                      " entries of face_rules are not those of the ", touchable_faces(mesh).size(),
                      " faces that plates can touch");
  }
  return pressure;
}

// The friction recorded in the file; null: none.
std::shared_ptr<FrictionTerm> recorded_friction(const HexMesh& mesh, const PlatePair& plates) {
  if (!mesh.contact || mesh.contact->friction.empty()) return nullptr;
  std::vector<FrictionEntry> entries;
  for (const FrictionRecord& held : mesh.contact->friction) {
    if (held.node >= mesh.nodes()) {
      throw input_error("contact record: friction at node ", held.node, ", but the mesh has ",
                        mesh.nodes());
    }
    entries.push_back(
        {held.node, held.plate, held.anchor, held.bound, held.stick,
         kept_normal(plates.plate(held.plate), held.anchor, mesh.points[std::size_t(held.node)])});
  }
  auto friction = std::make_shared<FrictionTerm>();
  friction->set_plates(plates);
  friction->set_entries(std::move(entries));
  return friction;
}

PartIndices part_of(const HexMesh& imaged, const HexMesh& state) {
  std::optional<PartIndices> part = indices_in(imaged, state);
  if (!part) throw input_error("the deformed mesh is no part of the mesh of the scan");
  return *std::move(part);
}

std::vector<std::shared_ptr<const Term>> present(
    std::initializer_list<std::shared_ptr<const Term>> terms) {
  std::vector<std::shared_ptr<const Term>> list;
  std::copy_if(terms.begin(), terms.end(), std::back_inserter(list),
               [](const auto& term) { return term != nullptr; });
  return list;
}

}  // namespace

SensitivityChain::SensitivityChain(const HexMesh& state, const std::vector<double>& imaged_pressure,
                                   const Vec3& imaged_gravity, const MechanicsOptions& options)
    : SensitivityChain(state, state, imaged_pressure, imaged_gravity, options) {}

SensitivityChain::SensitivityChain(const HexMesh& imaged, const HexMesh& state,
                                   const std::vector<double>& imaged_pressure,
                                   const Vec3& imaged_gravity, const MechanicsOptions& options)
    : mesh_(state),
      scene_(std::make_shared<Scene>(state, options)),
      imaged_scene_(imaged.elements() == state.elements()
                        ? scene_
                        : std::make_shared<const Scene>(imaged, options)),
      part_(part_of(imaged, state)),
      plates_(state.contact ? recorded_plates(state) : PlatePair{}),
      pressure_(recorded_pressure(*scene_, plates_)),
      imaged_(*imaged_scene_, imaged_state(*imaged_scene_, imaged_pressure, imaged_gravity), {}, {},
              "the imaged shape"),
      friction_(recorded_friction(state, plates_)),
      deformed_(*scene_, deformed_state(*scene_), contacts_of(state, plates_),
                present({pressure_, friction_}), "the deformed shape") {}

// −∂R/∂m of both states, and the motion that the plates impose.
struct SensitivityChain::Rights {
  ParameterForces imaged, deformed;
  Eigen::MatrixXd imposed;  ///< of x, mm (3 per node)
};

SensitivityChain::Rights SensitivityChain::rights(const std::vector<Parameter>& parameters) const {
  Rights out{
      parameter_forces(*imaged_scene_, imaged_.state(), ParameterKind::imaged_gravity, parameters),
      parameter_forces(*scene_, deformed_.state(), ParameterKind::gravity, parameters),
      Eigen::MatrixXd::Zero(3L * scene_->nodes(), long(parameters.size()))};
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (!parameters[i].of_plates()) continue;
    for (const PlateContact& contact : deformed_.contacts()) {
      const long at = 3L * contact.node;
      const GapSlope slope = gap_slope(plates_, contact, deformed_.state().state.x.segment<3>(at),
                                       parameters[i], mesh_.side);
      out.deformed.force.col(long(i)).segment<3>(at) -= contact.force * slope.gradient;
      out.imposed.col(long(i)).segment<3>(at) = -slope.value * contact.normal();
    }
    if (pressure_) {
      out.deformed.force.col(long(i)) -= pressure_->change_of_forces(
          deformed_.state().state.x, -1, nullptr, slope_of(parameters[i]));
    }
    if (friction_) {
      out.deformed.force.col(long(i)) -=
          friction_->change_of_forces(deformed_.state().state.x, -1, velocity_of(parameters[i]));
    }
  }
  out.imaged.force *= -1;
  out.imaged.volume *= -1;
  out.deformed.force *= -1;
  out.deformed.volume *= -1;
  return out;
}

std::function<GapSlope(int, const Gap&, const Vec3&)> SensitivityChain::slope_of(
    const Parameter& parameter) const {
  return [this, &parameter](int plate, const Gap& gap, const Vec3& at) {
    return gap_slope(plates_, {0, plate, gap, 0}, at, parameter, mesh_.side);
  };
}

std::function<Vec3(int, const Vec3&)> SensitivityChain::velocity_of(
    const Parameter& parameter) const {
  return [this, &parameter](int plate, const Vec3& at) {
    return plate_velocity(plates_, plate, at, parameter, mesh_.side);
  };
}

// Change of the force along the paddle's normal, N. The force on a node is λ∇g: `along` is δλ ∇g;
// the rest is the rotation of ∇g as node and plate move.
double SensitivityChain::paddle_force(const Parameter& parameter, const Imbalance& along,
                                      const Direction& moved) const {
  Vec3 sum = Vec3::Zero();
  if (pressure_) {
    const Eigen::VectorXd change =
        pressure_->change_of_forces(deformed_.state().state.x, 0, &moved.u, slope_of(parameter));
    for (Eigen::Index i = 0; i < change.size(); i += 3) sum += change.segment<3>(i);
  }
  for (const PlateContact& contact : deformed_.contacts()) {
    if (contact.plate != 0) continue;
    const long at = 3L * contact.node;
    const GapSlope slope = gap_slope(plates_, contact, deformed_.state().state.x.segment<3>(at),
                                     parameter, mesh_.side);
    const Vec3 turned = contact.gap.hessian * moved.u.segment<3>(at) + slope.gradient;
    sum += along.force.segment<3>(at) + contact.force * turned;
  }
  return sum.dot(plates_.paddle.normal()) / micronewton_per_newton;
}

std::vector<Response> SensitivityChain::tangent(const std::vector<Parameter>& parameters,
                                                Progress& progress) const {
  const double start = now();
  progress.update("derivatives", 0, message(parameters.size(), " parameters"));
  const Rights right = rights(parameters);
  const double shared = (now() - start) / double(parameters.size());
  std::vector<Response> responses;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const double before = now();
    const long k = long(i);
    Response response;
    response.parameter = parameters[i];
    Eigen::VectorXd reference = Eigen::VectorXd::Zero(3L * scene_->nodes());
    const bool moves =
        !right.imaged.force.col(k).isZero(0) || !right.imaged.volume.col(k).isZero(0);
    if (moves) {
      reference = part_.restricted(
          imaged_.solve_reference({right.imaged.force.col(k), right.imaged.volume.col(k)}).u);
    }
    const Imbalance carried = deformed_.of_reference(reference);
    const Imbalance all{right.deformed.force.col(k) - carried.force,
                        right.deformed.volume.col(k) - carried.volume};
    const Eigen::VectorXd imposed = right.imposed.col(k);
    const Direction solved = deformed_.solve(all, &imposed);
    response.position = unflatten(solved.u);
    response.reference = unflatten(reference);
    if (pressed()) {
      Imbalance along = deformed_.apply(solved);
      along.force -= all.force;
      response.paddle_force_N = paddle_force(parameters[i], along, solved);
    }
    response.seconds = now() - before + shared;
    responses.push_back(std::move(response));
    progress.update("derivatives", double(i + 1) / double(parameters.size()), parameters[i].name);
  }
  return responses;
}

// With Aᵀλ = ℓ at the deformed and A_bᵀν = K_Xᵀλ at the imaged state,
// ℓ·x' = ℓ·x'_imposed + λ·(−∂R − A x'_imposed) + ν·∂R_b.
LandmarkGradient SensitivityChain::adjoint(const Landmark& landmark,
                                           const std::vector<Parameter>& parameters) const {
  const double start = now();
  const Rights right = rights(parameters);
  LandmarkGradient gradient;
  gradient.name = landmark.name;
  gradient.by_parameter.assign(parameters.size(), Vec3::Zero());
  gradient.by_element.assign(std::size_t(mesh_.elements()), 0);
  const Vec3 away = (landmark_position(mesh_, mesh_.points, landmark) -
                     landmark_position(mesh_, mesh_.imaged, landmark))
                        .stableNormalized();
  const HexShape shape = hex_shape(mesh_.order, landmark.local);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(deformed_.state().state.p.size()),
                        no_volume = Eigen::VectorXd::Zero(imaged_.state().state.p.size());
  for (int c = 0; c < 3; ++c) {
    Eigen::VectorXd output = Eigen::VectorXd::Zero(3L * scene_->nodes());
    for (int a = 0; a < mesh_.nodes_per_element(); ++a) {
      output[3L * mesh_.element(landmark.element)[a] + c] += shape.values[a];
    }
    const Direction late = deformed_.solve_transposed({output, none});
    const Direction early = imaged_.solve_reference_transposed(
        {part_.extended(deformed_.of_reference_transposed(late), imaged_scene_->nodes()),
         no_volume});
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      const long k = long(i);
      double& value = gradient.by_parameter[i][c];
      value = late.u.dot(right.deformed.force.col(k)) + late.p.dot(right.deformed.volume.col(k)) -
              early.u.dot(right.imaged.force.col(k)) - early.p.dot(right.imaged.volume.col(k));
      if (!parameters[i].of_plates()) continue;
      const Imbalance moved = deformed_.apply({right.imposed.col(k), none});
      value +=
          output.dot(right.imposed.col(k)) - late.u.dot(moved.force) - late.p.dot(moved.volume);
    }
    const std::vector<double> now_stiff =
        element_stiffness_products(*scene_, deformed_.state(), late.u);
    const std::vector<double> then_stiff =
        element_stiffness_products(*imaged_scene_, imaged_.state(), early.u);
    for (std::size_t e = 0; e < now_stiff.size(); ++e) {
      const auto then = std::size_t(part_.elements[e]);
      gradient.by_element[e] += away[c] * (then_stiff[then] - now_stiff[e]);
    }
  }
  gradient.seconds = now() - start;
  return gradient;
}

double displacement_elasticity(const HexMesh& mesh, const Landmark& landmark, const Vec3& slope) {
  const Vec3 u = landmark_position(mesh, mesh.points, landmark) -
                 landmark_position(mesh, mesh.imaged, landmark);
  return u.dot(slope) / u.squaredNorm();
}

}  // namespace breast
