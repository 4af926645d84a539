// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives through backward and forward against central differences of the chain solved again.
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/units.hpp"
#include "fixtures/chain_inputs.hpp"
#include "fixtures/in_place.hpp"
#include "fixtures/shapes.hpp"
#include "fixtures/sliding_cap.hpp"
#include "mesh/element_order.hpp"
#include "sensitivity/chain.hpp"

using namespace breast;

namespace {

constexpr double step = 1e-3;

using fixtures::ChainInputs;

struct Outcome {
  HexMesh mesh;
  std::vector<double> imaged_pressure;
};

Outcome solve_chain(const ChainInputs& in) {
  Outcome out{in.mesh, {}};
  EXPECT_TRUE(fixtures::backward_into(out.mesh, in.imaged_gravity, in.options).converged());
  out.imaged_pressure = out.mesh.pressure;
  EXPECT_TRUE(fixtures::forward_into(out.mesh, in.gravity, in.options).converged());
  return out;
}

ChainInputs changed(ChainInputs in, const Parameter& parameter, double by) {
  EXPECT_TRUE(fixtures::change(in, parameter, by)) << parameter.name << " is not of this chain";
  return in;
}

// Root of summed squares over nodes of a − b, and of a.
double distance(const Eigen::VectorXd& a, const std::vector<Vec3>& b) {
  return (a - flatten(b)).norm() / a.norm();
}

void expect_matches(const ChainInputs& in, const Response& response) {
  SCOPED_TRACE(response.parameter.name);
  const HexMesh more = solve_chain(changed(in, response.parameter, step)).mesh;
  const HexMesh less = solve_chain(changed(in, response.parameter, -step)).mesh;
  const Eigen::VectorXd x = (flatten(more.points) - flatten(less.points)) / (2 * step);
  EXPECT_GT(x.cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT(distance(x, response.position), 1e-5);
  const Eigen::VectorXd reference =
      (flatten(more.reference) - flatten(less.reference)) / (2 * step);
  if (response.parameter.kind == ParameterKind::gravity) return;  // leaves the reference alone
  EXPECT_LT(distance(reference, response.reference), 1e-5);
}

ChainInputs cap_inputs(const fixtures::CapSettings& settings = {.elements = 4}) {
  return {fixtures::cap(settings),
          {.materials = load_materials("seed2008")},
          posture_gravity(Posture::prone),
          posture_gravity(Posture::supine)};
}

void expect_all_match(const ChainInputs& in, const std::string& list) {
  const Outcome base = solve_chain(in);
  const SensitivityChain chain(base.mesh, base.imaged_pressure, in.imaged_gravity, in.options);
  const auto all = all_parameters(base.mesh, in.options, in.imaged_gravity);
  for (const Response& response : chain.tangent(pick_parameters(all, list))) {
    expect_matches(in, response);
  }
}

TEST(Sensitivity, OfEveryKindOfParameterMatchesFiniteDifferences) {
  expect_all_match(cap_inputs(), "main,fat.a10,fat.a11,fat.density,skin.a,skin.b,skin.c");
}

TEST(Sensitivity, WithA27NodeElement) {
  ChainInputs in = cap_inputs({.elements = 4});
  in.mesh = raise_order(in.mesh);
  in.options.element = Element::q2p1;
  expect_all_match(in, "fat,skin,imaged_gravity_x");
}

TEST(Sensitivity, WithPlainInvariantsABulkModulusAndARollingCut) {
  ChainInputs in = cap_inputs({.elements = 4, .with_cut = true});
  in.options.invariants = Invariants::plain;
  in.options.bulk_ratio = 50;
  in.options.cut = cut_support("roller");
  in.imaged_gravity = Vec3(500, -9000, 1500);
  in.gravity = Vec3(0, 4000, -8000);
  expect_all_match(in, "fat,fibroglandular,fat.a10,fat.a11,skin.b,density,gravity_x");
}

void expect_adjoint_matches(const ChainInputs& in, bool elements_add_up) {
  const Outcome base = solve_chain(in);
  const SensitivityChain chain(base.mesh, base.imaged_pressure, in.imaged_gravity, in.options);
  const auto picked =
      pick_parameters(all_parameters(base.mesh, in.options, in.imaged_gravity), "all");
  const auto tangent = chain.tangent(picked);
  for (const Landmark& landmark : base.mesh.landmarks) {
    const LandmarkGradient adjoint = chain.adjoint(landmark, picked);
    const Vec3 away = (landmark_position(base.mesh, base.mesh.points, landmark) -
                       landmark_position(base.mesh, base.mesh.imaged, landmark))
                          .normalized();
    double elements = 0, tissues = 0;
    for (const double value : adjoint.by_element) elements += value;
    for (std::size_t i = 0; i < picked.size(); ++i) {
      const Vec3 expected = landmark_position(base.mesh, tangent[i].position, landmark);
      EXPECT_LT((adjoint.by_parameter[i] - expected).norm(), 1e-7 * expected.norm() + 1e-9)
          << picked[i].name;
      if (picked[i].kind == ParameterKind::scale) tissues += away.dot(expected);
    }
    if (elements_add_up) {
      EXPECT_NEAR(elements, tissues, 1e-7 * std::abs(tissues));
    }
  }
}

// A breast that slides, in skin that wrinkles: all that such a chain depends on.
TEST(Sensitivity, OnAWallToSlideOn) {
  ChainInputs in = cap_inputs();
  in.mesh = fixtures::cap_on_sphere(4);
  fixtures::let_slide(in.options, fixtures::sphere(), 0.02);
  in.options.cut = cut_support("spring:0.01,0.03");
  in.options.materials.skin = {0.05, 0.02, 0.03};
  // Away from the sternum, so that the attachment to it pulls.
  in.gravity.x() += 4000 * lateral_sign(in.mesh.side);
  const Outcome base = solve_chain(in);
  const SensitivityChain chain(base.mesh, base.imaged_pressure, in.imaged_gravity, in.options);
  const auto sternum =
      pick_parameters(all_parameters(base.mesh, in.options, in.imaged_gravity), "sternum");
  double most = 0;
  for (const Vec3& by : chain.tangent(sternum)[0].position) most = std::max(most, by.norm());
  EXPECT_GT(most, 1e-3);
  expect_all_match(in, "fat,skin,skin.a,skin.b,density,skin_thickness,wall,cut,sternum,gravity_x");
  expect_adjoint_matches(in, true);
}

// The weight of the tissue beyond the cut depends on the supports of cut and wall and on the density.
TEST(Sensitivity, OfTheWeightOfTheTissueBeyondTheCut) {
  ChainInputs in = cap_inputs();
  in.mesh = fixtures::cap_on_sphere(4);
  fixtures::let_slide(in.options, fixtures::sphere(), 0.02);
  in.options.cut = cut_support("tissue:0.01");
  in.gravity.x() += 4000;
  expect_all_match(in, "fat,density,fat.density,wall,cut,gravity_x,imaged_gravity_x");
}

// A set states the uncertainty of the supports with which it was found, and options replace these.
TEST(Sensitivity, KnowsTheSupportsThatAreThereNotThoseOfTheSet) {
  ChainInputs in = cap_inputs({.elements = 4, .with_cut = true});
  in.options.materials = load_materials("invivo");
  in.options.wall = wall_support("spring:0.5,0.2");
  in.options.cut = cut_support("roller");
  const auto all = all_parameters(in.mesh, in.options, in.imaged_gravity);
  const auto count = [&](const std::string& name) {
    return std::count_if(all.begin(), all.end(),
                         [&](const Parameter& parameter) { return parameter.name == name; });
  };
  EXPECT_EQ(count("low_order"), 1);
  EXPECT_EQ(count("wall"), 1);
  EXPECT_EQ(count("cut"), 0);
  const Scene scene(in.mesh, in.options);
  const LoadedState state{scene.at_rest(flatten(in.mesh.imaged)), in.gravity};
  EXPECT_TRUE(parameter_forces(scene, state, ParameterKind::gravity, all).force.allFinite());
}

// Nothing but ratios of stress and weight decides an equilibrium.
TEST(Sensitivity, StiffnessOfAllTissuesUndoesDensity) {
  const ChainInputs in = cap_inputs();
  const Outcome base = solve_chain(in);
  const SensitivityChain chain(base.mesh, base.imaged_pressure, in.imaged_gravity, in.options);
  const auto all = all_parameters(base.mesh, in.options, in.imaged_gravity);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(3L * base.mesh.nodes());
  double largest = 0;
  for (const Response& r : chain.tangent(pick_parameters(all, "fat,fibroglandular,skin,density"))) {
    sum += flatten(r.position);
    largest = std::max(largest, flatten(r.position).norm());
  }
  EXPECT_LT(sum.norm(), 1e-7 * largest);
}

TEST(Sensitivity, AdjointGivesWhatTheTangentGives) {
  ChainInputs in = cap_inputs();
  expect_adjoint_matches(in, true);
  in.options.bulk_ratio = 100;  // compressibility belongs to the tissue, not to the element field
  expect_adjoint_matches(in, false);
}

TEST(Sensitivity, RefusesAStateOfOtherMaterials) {
  ChainInputs in = cap_inputs();
  const Outcome base = solve_chain(in);
  scale_materials(in.options.materials, {"fat=101"});
  EXPECT_THROW(SensitivityChain(base.mesh, base.imaged_pressure, in.imaged_gravity, in.options),
               Error);
}

}  // namespace
