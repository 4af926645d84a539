// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives through backward and compress, the touching nodes held, against central differences
// of both solved again between the same plates.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "contact/compression.hpp"
#include "contact/faces.hpp"
#include "contact/solvers/active_set.hpp"
#include "contact/terms/friction.hpp"
#include "contact/terms/surface_pressure.hpp"
#include "core/units.hpp"
#include "fixtures/analytic_mesh.hpp"
#include "fixtures/chain_inputs.hpp"
#include "fixtures/compress_into.hpp"
#include "fixtures/in_place.hpp"
#include "mesh/part.hpp"
#include "mesh/surroundings.hpp"
#include "meshing/layers/surrounding_layers.hpp"
#include "sensitivity/chain.hpp"
#include "solve/equilibrate.hpp"

using namespace breast;

namespace {

constexpr double step = 2e-4;

struct Inputs : fixtures::ChainInputs {
  PlatePair plates;
  double paddle_share = 0.5;  ///< of a change of thickness
};

// Imaged prone, pressed upright; without plates yet.
Inputs upright_breast() {
  return {{analytic_breast_mesh(5),
           {.materials = load_materials("seed2008")},
           posture_gravity(Posture::prone),
           posture_gravity(Posture::upright)},
          {},
          0.5};
}

struct Outcome {
  Eigen::VectorXd x;
  double paddle_N = 0;
};

// Both plates turned by `degrees` of beam angle about their mid-line.
PlatePair turned(PlatePair plates, const HexMesh& mesh, double degrees) {
  const ContactRecord& contact = *mesh.contact;
  const ViewPose pose = view_pose(mesh.side, contact.angle_deg + degrees, contact.turn_deg,
                                  contact.lean_deg, contact.bend_deg);
  const Vec3 centre = 0.5 * (plates.paddle.origin() + plates.detector.origin());
  for (Plate* plate : {&plates.paddle, &plates.detector}) {
    const Vec3 arm = plate->origin() - centre;
    const Vec3 origin = centre + arm.dot(plate->n) * pose.n + arm.dot(plate->anterior) * pose.e_u +
                        arm.dot(plate->lateral) * pose.e_v;
    plate->n = pose.n;
    plate->anterior = pose.e_u;
    plate->lateral = pose.e_v;
    plate->edge_start = plate->mid_depth = origin.dot(pose.e_u);
    plate->level = origin.dot(pose.n);
    plate->lateral_centre = origin.dot(pose.e_v);
  }
  return plates;
}

Inputs changed(Inputs in, const Parameter& parameter, double by) {
  if (fixtures::change(in, parameter, by)) return in;
  switch (parameter.kind) {
    case ParameterKind::thickness:
      in.plates.paddle.level -= in.paddle_share * by;
      in.plates.detector.level += (1 - in.paddle_share) * by;
      break;
    case ParameterKind::standoff:
      in.plates.paddle.edge_start += by;
      in.plates.detector.edge_start += by;
      break;
    case ParameterKind::detector:
      in.plates.paddle.level -= by;
      in.plates.detector.level -= by;
      break;
    case ParameterKind::angle:
      in.plates = turned(in.plates, in.mesh, by);
      break;
    default:
      ADD_FAILURE() << parameter.name;
  }
  return in;
}

// The stress-free shape of these inputs between their plates, from a state nearby.
Outcome press(const Inputs& in, const HexMesh& near) {
  HexMesh mesh = in.mesh;
  EXPECT_TRUE(fixtures::backward_into(mesh, in.imaged_gravity, in.options).converged());
  Scene scene(mesh, in.options);
  const Eigen::VectorXd load = scene.gravity_force(in.gravity);
  const Problem body = scene.problem(load).problem;
  SaddleSolver solver(body.space().pattern);
  std::vector<int> candidates;
  std::vector<signed char> touching;
  for (const int node : nodes_of(near, near.skin_faces)) {
    if (scene.walls().at(node) != nullptr) continue;
    candidates.push_back(node);
    const bool pressed = near.contact_pressure[std::size_t(node)] > 0;
    touching.push_back(
        pressed ? static_cast<signed char>(in.plates.nearer(near.points[std::size_t(node)]))
                : static_cast<signed char>(-1));
  }
  ActiveSetOptions tight;
  tight.gap_tolerance = tight.volume_tolerance = 1e-12;
  ActiveSet contact(body, solver, candidates, tight);
  ContactMemory memory;
  memory.touching = touching;
  memory.multipliers.assign(touching.size(), 0);
  contact.restore(memory);
  State state{flatten(mesh.reference), flatten(near.points),
              Eigen::Map<const Eigen::VectorXd>(near.pressure.data(), near.elements())};
  const ContactStep result = contact.solve(in.plates, state, 1e-11);
  EXPECT_TRUE(result.converged) << describe(result.stop);
  EXPECT_EQ(contact.touching(), touching) << "the set of touching nodes changed";
  Outcome out{state.x, 0};
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    if (touching[c] != 0) continue;
    const Gap gap = in.plates.paddle.gap(state.x.segment<3>(3 * candidates[c]));
    out.paddle_N += result.contacts[c].normal * gap.gradient.dot(in.plates.paddle.normal()) /
                    micronewton_per_newton;
  }
  return out;
}

/// A view, how far the detector rises (mm), and by how many degrees the plates lean and the patient
/// bends forwards.
struct Machine {
  View view;
  double detector_rise;
  double lean_deg = 0, bend_deg = 0;
};

class CompressedSensitivity : public testing::TestWithParam<Machine> {};

TEST_P(CompressedSensitivity, MatchesFiniteDifferencesAndItsAdjoint) {
  Inputs in = upright_breast();
  HexMesh mesh = in.mesh;
  ASSERT_TRUE(fixtures::backward_into(mesh, in.imaged_gravity, in.options).converged());
  const std::vector<double> imaged_pressure = mesh.pressure;
  CompressionOptions compression;
  compression.view = GetParam().view;
  compression.angle_deg = view_angle_deg(GetParam().view);
  compression.plates.detector_rise = GetParam().detector_rise;
  compression.plates.lean_deg = GetParam().lean_deg;
  compression.plates.bend_deg = GetParam().bend_deg;
  compression.stops = {{StopAt::reduction, 35}};
  ASSERT_TRUE(fixtures::compress_into(mesh, compression, in.options).converged());
  in.plates = recorded_plates(mesh);
  in.paddle_share = std::isinf(GetParam().detector_rise) ? 0.5 : 1;
  in.mesh.contact = mesh.contact;
  EXPECT_EQ(mesh.contact->bend_deg, GetParam().bend_deg);
  EXPECT_EQ((mesh.gravity - in.gravity).norm() > 0, GetParam().bend_deg > 0);
  in.gravity = mesh.gravity;  // turns with the patient
  const SensitivityChain chain(mesh, imaged_pressure, in.imaged_gravity, in.options);
  EXPECT_GE(chain.contacts(), 10u);
  const auto picked = pick_parameters(
      all_parameters(mesh, in.options, in.imaged_gravity),
      "fat,skin,density,gravity_x,imaged_gravity_z,thickness,standoff,detector,angle");
  const std::vector<Response> responses = chain.tangent(picked);
  const Landmark& landmark = mesh.landmarks.back();
  const LandmarkGradient adjoint = chain.adjoint(landmark, picked);
  for (std::size_t i = 0; i < picked.size(); ++i) {
    SCOPED_TRACE(picked[i].name);
    const Outcome more = press(changed(in, picked[i], step), mesh);
    const Outcome less = press(changed(in, picked[i], -step), mesh);
    const Eigen::VectorXd x = (more.x - less.x) / (2 * step);
    EXPECT_LT((x - flatten(responses[i].position)).norm(), 1e-5 * x.norm());
    const Vec3 at = landmark_position(mesh, responses[i].position, landmark);
    EXPECT_LT((adjoint.by_parameter[i] - at).norm(), 1e-6 * at.norm() + 1e-9);
    if (picked[i].kind == ParameterKind::angle) continue;
    const double force = (more.paddle_N - less.paddle_N) / (2 * step);
    EXPECT_NEAR(responses[i].paddle_force_N, force, 1e-5 * std::abs(force) + 1e-6);
  }
}

// The same with the points of the faces and the slip of friction as they are: what holds a node moves
// with its plate.
Outcome press_faces(const Inputs& in, const HexMesh& near, const Parameter& parameter, double by) {
  HexMesh mesh = in.mesh;
  EXPECT_TRUE(fixtures::backward_into(mesh, in.imaged_gravity, in.options).converged());
  mesh = restricted(std::move(mesh), breast_elements);
  Scene scene(mesh, in.options);
  Problem body = scene.problem(scene.gravity_force(in.gravity)).problem;
  const PlatePair before = recorded_plates(near);
  auto pressure = std::make_shared<SurfacePressure>(near, touchable_faces(near), body.space());
  pressure->set_plates(before);
  EXPECT_TRUE(pressure->set_face_rules(near.contact->face_rules));
  pressure->set_plates(in.plates);
  pressure->set_stiffness(near.contact->surface_stiffness);
  pressure->set_turning_depth(std::numeric_limits<double>::infinity());
  body.add(pressure);
  auto friction = std::make_shared<FrictionTerm>();
  std::vector<FrictionEntry> entries;
  for (const FrictionRecord& held : near.contact->friction) {
    const Vec3 moved = by * plate_velocity(before, held.plate, near.points[std::size_t(held.node)],
                                           parameter, near.side);
    entries.push_back({held.node, held.plate, held.anchor + moved, held.bound, held.stick});
  }
  friction->set_plates(in.plates);
  friction->set_entries(entries);
  body.add(friction);
  SaddleSolver solver(body.space().pattern);
  SaddleMatrix matrix = body.make_matrix();
  State state{flatten(mesh.reference), flatten(near.points),
              Eigen::Map<const Eigen::VectorXd>(near.pressure.data(), near.elements())};
  NewtonOptions tight;
  tight.tolerance = 1e-9;  // of the weight, which is small beside the plates' forces
  EXPECT_TRUE(equilibrate(body, solver, matrix, state, tight).converged);
  Outcome out{state.x, 0};
  const Eigen::VectorXd force = pressure->plate_forces(state.x, 0);
  for (Eigen::Index i = 0; i < force.size(); i += 3) {
    out.paddle_N += force.segment<3>(i).dot(in.plates.paddle.normal()) / micronewton_per_newton;
  }
  return out;
}

/// The coefficient of friction, and the width of the tissue around the breast in the scan, which the
/// plates leave out, mm.
struct Pressed {
  double friction = 0, surroundings = 0;
};
class PressedFacesSensitivity : public testing::TestWithParam<Pressed> {};

TEST_P(PressedFacesSensitivity, MatchesFiniteDifferencesAndItsAdjoint) {
  Inputs in = upright_breast();
  if (GetParam().surroundings > 0) add_surroundings(GetParam().surroundings, in.mesh);
  HexMesh imaged = in.mesh;
  ASSERT_TRUE(fixtures::backward_into(imaged, in.imaged_gravity, in.options).converged());
  HexMesh mesh = restricted(imaged, breast_elements);
  CompressionOptions compression;
  compression.method = ContactMethod::surface;
  compression.positioning = Positioning::lifted;
  compression.plates.image_edge = 10;
  compression.plates.edge_radius = 3;
  compression.plates.turn_deg = 5;
  compression.friction = GetParam().friction;
  compression.stops = {{StopAt::reduction, 25}};
  compression.must_grip = false;  // the derivatives are those of any equilibrium
  ASSERT_TRUE(fixtures::compress_into(mesh, compression, in.options).converged());
  in.plates = recorded_plates(mesh);
  in.mesh.contact = mesh.contact;
  EXPECT_EQ(mesh.contact->friction.empty(), GetParam().friction == 0);
  EXPECT_EQ(mesh.elements() < imaged.elements(), GetParam().surroundings > 0);
  const SensitivityChain chain(imaged, mesh, imaged.pressure, in.imaged_gravity, in.options);
  EXPECT_TRUE(chain.pressed());
  const std::string around = GetParam().surroundings > 0 ? ",other" : "";
  const auto picked = pick_parameters(all_parameters(imaged, mesh, in.options, in.imaged_gravity),
                                      "fat,gravity_x,thickness,standoff,detector" + around);
  const std::vector<Response> responses = chain.tangent(picked);
  const Landmark& landmark = mesh.landmarks.back();
  const LandmarkGradient adjoint = chain.adjoint(landmark, picked);
  constexpr double small = 2e-5;  // the depth in the plates is a hundredth of a millimetre
  for (std::size_t i = 0; i < picked.size(); ++i) {
    SCOPED_TRACE(picked[i].name);
    const Outcome more = press_faces(changed(in, picked[i], small), mesh, picked[i], small);
    const Outcome less = press_faces(changed(in, picked[i], -small), mesh, picked[i], -small);
    const Eigen::VectorXd x = (more.x - less.x) / (2 * small);
    EXPECT_LT((x - flatten(responses[i].position)).norm(), 1e-3 * x.norm());
    const Vec3 at = landmark_position(mesh, responses[i].position, landmark);
    EXPECT_LT((adjoint.by_parameter[i] - at).norm(), 1e-5 * at.norm() + 1e-9);
    if (GetParam().friction > 0) continue;  // the paddle's force has a part of friction
    const double force = (more.paddle_N - less.paddle_N) / (2 * small);
    EXPECT_NEAR(responses[i].paddle_force_N, force, 1e-3 * std::abs(force) + 1e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(Skin, PressedFacesSensitivity,
                         testing::Values(Pressed{0, 0}, Pressed{0.3, 0}, Pressed{0, 12}),
                         [](const auto& test) {
                           return test.param.friction > 0       ? "rough"
                                  : test.param.surroundings > 0 ? "surrounded"
                                                                : "smooth";
                         });

constexpr double raised = std::numeric_limits<double>::infinity();
INSTANTIATE_TEST_SUITE_P(Machines, CompressedSensitivity,
                         testing::Values(Machine{View::cc, raised}, Machine{View::mlo, raised},
                                         Machine{View::cc, 0.0}, Machine{View::mlo, raised, 12},
                                         Machine{View::cc, raised, 0, 10}),
                         [](const auto& test) {
                           return view_name(test.param.view) +
                                  (std::isinf(test.param.detector_rise) ? "" : "_detector_fixed") +
                                  (test.param.lean_deg > 0 ? "_leaning" : "") +
                                  (test.param.bend_deg > 0 ? "_bent_forwards" : "");
                         });

}  // namespace
