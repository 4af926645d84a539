// SPDX-License-Identifier: GPL-3.0-or-later
#include "sensitivity/parameter_forces.hpp"

#include <Eigen/LU>
#include <cmath>
#include <functional>

#include "core/parallel.hpp"
#include "fem/gather.hpp"
#include "fem/hex_kernel.hpp"
#include "fem/membrane_kernel.hpp"
#include "fem/plane_stress.hpp"
#include "fem/stress.hpp"

namespace breast {

namespace {

// The stresses of W = I1 and W = I2: the stress of any law is a combination of them with weights W1
// and W2.
const Law unit_i1{"neo_hookean", {1}}, unit_i2{"mooney_rivlin", {0, 1}};

// A column that depends on a law: the law, and its derivative at given invariants.
struct Column {
  long at = 0;
  const Parameter* parameter = nullptr;
  const Law* law = nullptr;

  LawSlope slope(double i1, double i2) const {
    if (parameter->kind != ParameterKind::constant) return law->scale_slope(i1, i2);
    const LawSlope by = law->slope(parameter->constant, i1, i2);
    return {parameter->value * by.w1, parameter->value * by.w2};
  }
};

bool of_law(const Parameter& parameter, Tissue tissue, bool membrane) {
  switch (parameter.kind) {
    case ParameterKind::scale:
    case ParameterKind::constant:
      return parameter.tissue == tissue;
    case ParameterKind::skin_thickness:
      return membrane;  // energy is thickness times W: the same as all its constants
    default:
      return false;
  }
}

std::vector<Column> columns_of(const std::vector<Parameter>& parameters,
                               const MaterialSet& materials, Tissue tissue, bool membrane) {
  std::vector<Column> columns;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (of_law(parameters[i], tissue, membrane)) {
      columns.push_back({long(i), &parameters[i], &materials.law(tissue)});
    }
  }
  return columns;
}

// Forces of one element, 3N × columns.
template <int N>
Eigen::MatrixXd element_forces(const Scene& scene, const LoadedState& state, int e,
                               const std::vector<Column>& columns) {
  const HexRule<N>& rule = HexRule<N>::get();
  const int* nodes = scene.solid().space()->cells.cell(e);
  const bool isochoric = scene.options().invariants == Invariants::isochoric;
  const Eigen::Matrix<double, 3, N> from = gather<N>(nodes, state.state.reference);
  const Eigen::Matrix<double, 3, N> to = gather<N>(nodes, state.state.x);
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(3 * N, long(columns.size()));
  Stress first, second;
  for (int q = 0; q < HexRule<N>::points; ++q) {
    const Mat3 dx_ref = from * rule.gradients[q].transpose();
    const Mat3 inverse = dx_ref.inverse();
    const Mat3 f = to * rule.gradients[q].transpose() * inverse, c = f.transpose() * f;
    const double det_f = f.determinant(), volume = rule.weight[q] * dx_ref.determinant();
    law_stress(unit_i1, isochoric, c, det_f, false, first);
    law_stress(unit_i2, isochoric, c, det_f, false, second);
    const double i1 = first.energy + 3, i2 = second.energy + 3;
    const Eigen::Matrix<double, 3, N> gradient =
        (rule.gradients[q].transpose() * inverse).transpose();
    const Eigen::Matrix<double, 3, N> one = volume * f * from_voigt(first.s) * gradient;
    const Eigen::Matrix<double, 3, N> two = volume * f * from_voigt(second.s) * gradient;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const LawSlope slope = columns[k].slope(i1, i2);
      Eigen::Map<Eigen::Matrix<double, 3, N>>(out.col(long(k)).data()) +=
          slope.w1 * one + slope.w2 * two;
    }
  }
  return out;
}

// Forces of one skin face, 3F × columns. The kernel is linear in the weights of its Gauss points:
// they carry the slopes. Of a tension field the part kept in compression and the relaxed one
// evaluate the law at different stretches.
template <int F>
Eigen::MatrixXd face_forces(const Scene& scene, const LoadedState& state, std::size_t face,
                            const std::vector<int>& nodes, const std::vector<Column>& columns) {
  const QuadRule<F>& rule = QuadRule<F>::get();
  const HexMesh& mesh = scene.mesh();
  MembraneInput<F> in;
  in.reference = gather<F>(nodes.data(), state.state.reference);
  in.deformed = gather<F>(nodes.data(), state.state.x);
  const Eigen::Matrix<double, 3, F> imaged = gather<F>(nodes.data(), mesh.imaged);
  const SkinBehaviour& skin = scene.options().materials.skin;
  const double stretched = (1 + skin.prestretch) * (1 + skin.prestretch);
  std::array<double, QuadRule<F>::points> volume;
  std::array<Invariants12, QuadRule<F>::points> whole, relaxed;
  const auto metric = [&](const Eigen::Matrix<double, 3, F>& x, int q) {
    const Eigen::Matrix<double, 3, 2> t = x * rule.gradients[q].transpose();
    return Eigen::Matrix2d(t.transpose() * t);
  };
  for (int q = 0; q < QuadRule<F>::points; ++q) {
    const Eigen::Matrix2d before = metric(in.reference, q), after = metric(in.deformed, q);
    const double i = stretched * (before.inverse() * after).trace();
    const double d = stretched * stretched * after.determinant() / before.determinant();
    whole[q] = {i + 1 / d, d + i / d};
    if (skin.kept < 1) relaxed[q] = effective_invariants(skin.smoothing, i, d);
    volume[q] =
        mesh.skin_thickness[face] * rule.weight[q] * std::sqrt(metric(imaged, q).determinant());
  }
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(3 * F, long(columns.size()));
  MembraneOutput<F> result;
  const auto add = [&](double fraction, const SkinBehaviour& behaviour, const auto& invariants) {
    in.skin = behaviour;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      for (const Law* unit : {&unit_i1, &unit_i2}) {
        in.law = unit;
        for (int q = 0; q < QuadRule<F>::points; ++q) {
          const LawSlope slope = columns[k].slope(invariants[q].i1, invariants[q].i2);
          in.volume[q] = fraction * volume[q] * (unit == &unit_i1 ? slope.w1 : slope.w2);
        }
        membrane_kernel<F>(in, {}, result);
        out.col(long(k)) += Eigen::Map<const Eigen::VectorXd>(result.residual.data(), 3 * F);
      }
    }
  };
  add(skin.kept, {1, skin.smoothing, skin.prestretch}, whole);
  if (skin.kept < 1) add(1 - skin.kept, {0, skin.smoothing, skin.prestretch}, relaxed);
  return out;
}

// Calls `use(element, nodes, forces, columns)` for every element, and then every skin face, whose law a
// parameter is of: a column of `forces` (3 a node) for each of the `columns`. Always in the same order.
using Use =
    std::function<void(int, const int*, const Eigen::MatrixXd&, const std::vector<Column>&)>;

template <int N, int F>
void visit(const Scene& scene, const LoadedState& state, const std::vector<Parameter>& parameters,
           const Use& use) {
  const HexMesh& mesh = scene.mesh();
  const MaterialSet& materials = scene.options().materials;
  std::vector<std::vector<Column>> columns;
  for (int t = 0; t < n_tissues; ++t) {
    columns.push_back(columns_of(parameters, materials, Tissue(t), false));
  }
  constexpr int chunk = 1024;
  std::vector<Eigen::MatrixXd> local(chunk);
  for (int first = 0; first < mesh.elements(); first += chunk) {
    const int count = std::min(chunk, mesh.elements() - first);
#pragma omp parallel for num_threads(threads()) schedule(dynamic, 16)
    for (int i = 0; i < count; ++i) {
      const std::vector<Column>& own = columns[std::size_t(mesh.tissue[std::size_t(first + i)])];
      if (!own.empty()) local[std::size_t(i)] = element_forces<N>(scene, state, first + i, own);
    }
    for (int i = 0; i < count; ++i) {
      const std::vector<Column>& own = columns[std::size_t(mesh.tissue[std::size_t(first + i)])];
      if (!own.empty()) use(first + i, mesh.element(first + i), local[std::size_t(i)], own);
    }
  }
  if (mesh.skin_model != SkinModel::membrane) return;
  const std::vector<Column> own = columns_of(parameters, materials, Tissue::skin, true);
  if (own.empty()) return;
  for (std::size_t f = 0; f < mesh.skin_faces.size(); ++f) {
    const std::vector<int> nodes = face_nodes(mesh, mesh.skin_faces[f]);
    use(mesh.skin_faces[f].element, nodes.data(), face_forces<F>(scene, state, f, nodes, own), own);
  }
}

void visit(const Scene& scene, const LoadedState& state, const std::vector<Parameter>& parameters,
           const Use& use) {
  if (scene.mesh().order == 1) {
    visit<8, 4>(scene, state, parameters, use);
  } else {
    visit<27, 9>(scene, state, parameters, use);
  }
}

// Mass (g) of each node that belongs to one tissue.
template <int N>
Eigen::VectorXd tissue_mass(const Scene& scene, Tissue tissue) {
  const HexMesh& mesh = scene.mesh();
  const HexRule<N>& rule = HexRule<N>::get();
  const double density = scene.options().materials.density[std::size_t(tissue)];
  Eigen::VectorXd mass = Eigen::VectorXd::Zero(mesh.nodes());
  for (int e = 0; e < mesh.elements(); ++e) {
    if (mesh.tissue[std::size_t(e)] != tissue) continue;
    const Eigen::Matrix<double, 3, N> x = gather<N>(mesh.element(e), mesh.imaged);
    for (int q = 0; q < HexRule<N>::points; ++q) {
      const Mat3 jacobian = x * rule.gradients[q].transpose();
      const double here = density * rule.weight[q] * jacobian.determinant();
      for (int a = 0; a < N; ++a) mass[mesh.element(e)[a]] += here * rule.values[q][a];
    }
  }
  return mass;
}

Eigen::VectorXd weight(const Eigen::VectorXd& mass, const Vec3& gravity) {
  Eigen::VectorXd force(3 * mass.size());
  for (long i = 0; i < mass.size(); ++i) force.segment<3>(3 * i) = mass[i] * gravity;
  return force;
}

// Finite bulk modulus: θ holds c M (p − p_rest) with c = 1/(ratio μ).
void add_compliance(const Scene& scene, const LoadedState& state,
                    const std::vector<Parameter>& parameters, Eigen::MatrixXd& volume) {
  if (!(scene.options().bulk_ratio > 0)) return;
  const HexMesh& mesh = scene.mesh();
  const PressureSpace& space = *scene.solid().space()->pressures;
  const bool isochoric = scene.options().invariants == Invariants::isochoric;
  for (int e = 0; e < mesh.elements(); ++e) {
    const Tissue tissue = mesh.tissue[std::size_t(e)];
    const long at = long(space.rows) * e;
    const Eigen::VectorXd p =
        (state.state.p - scene.solid().rest_pressure()).segment(at, space.rows);
    for (const Column& column : columns_of(parameters, scene.options().materials, tissue, false)) {
      const LawSlope slope = column.slope(3, 3);
      const double modulus = 2 * (slope.w1 + slope.w2) / column.law->shear_modulus();
      Eigen::VectorXd change = -modulus * p;
      if (!isochoric) change[0] -= 2 * slope.w1 + 4 * slope.w2;
      volume.col(column.at).segment(at, space.rows) +=
          space.compliance[e] * (space.mass_at(e) * change);
    }
  }
}

// The derivatives of the elements' forces with respect to the laws, each in its column of `force`.
void add_law_forces(const Scene& scene, const LoadedState& state,
                    const std::vector<Parameter>& parameters, Eigen::MatrixXd& force) {
  visit(scene, state, parameters,
        [&](int, const int* nodes, const Eigen::MatrixXd& forces, const std::vector<Column>& own) {
          for (std::size_t k = 0; k < own.size(); ++k) {
            auto column = force.col(own[k].at);
            for (long a = 0; a < forces.rows() / 3; ++a) {
              column.segment<3>(3L * nodes[a]) += forces.col(long(k)).segment<3>(3 * a);
            }
          }
        });
}

// The weight of one tissue, µN; of fat with what supports carry, which has fat's density.
Eigen::VectorXd tissue_weight(const Scene& scene, Tissue tissue, const Vec3& gravity) {
  Eigen::VectorXd force = weight(
      scene.mesh().order == 1 ? tissue_mass<8>(scene, tissue) : tissue_mass<27>(scene, tissue),
      gravity);
  if (tissue == Tissue::fat) scene.supports().add_loads(gravity, force);
  return force;
}

// The derivative of the residual with respect to a parameter of supports or weight, added to its column.
void add_load_forces(const Scene& scene, const LoadedState& state, ParameterKind role,
                     const Parameter& parameter, Eigen::MatrixXd::ColXpr column) {
  if (parameter.kind == ParameterKind::support) {
    column += scene.supports().slope(parameter.name, state.state, state.gravity);
  } else if (parameter.kind == ParameterKind::density) {
    column -= scene.gravity_force(state.gravity);
  } else if (parameter.kind == ParameterKind::tissue_density) {
    column -= tissue_weight(scene, parameter.tissue, state.gravity);
  } else if (parameter.kind == role) {
    column -= scene.gravity_force(turned_gravity(state.gravity, parameter.axis));
  }
}

// The forces of parameters of which none is `together`.
ParameterForces single_forces(const Scene& scene, const LoadedState& state, ParameterKind role,
                              const std::vector<Parameter>& parameters) {
  ParameterForces out;
  out.force = Eigen::MatrixXd::Zero(3L * scene.nodes(), long(parameters.size()));
  out.volume = Eigen::MatrixXd::Zero(state.state.p.size(), long(parameters.size()));
  add_law_forces(scene, state, parameters, out.force);
  add_compliance(scene, state, parameters, out.volume);
  for (std::size_t i = 0; i < parameters.size(); ++i)
    add_load_forces(scene, state, role, parameters[i], out.force.col(long(i)));
  return out;
}

}  // namespace

// Parameters that change together have the sum of their forces.
ParameterForces parameter_forces(const Scene& scene, const LoadedState& state, ParameterKind role,
                                 const std::vector<Parameter>& parameters) {
  std::vector<Parameter> single;
  std::vector<long> column;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const Parameter& parameter = parameters[i];
    if (parameter.kind == ParameterKind::together) {
      single.insert(single.end(), parameter.members.begin(), parameter.members.end());
    } else {
      single.push_back(parameter);
    }
    column.resize(single.size(), long(i));
  }
  const ParameterForces each = single_forces(scene, state, role, single);
  ParameterForces out;
  out.force = Eigen::MatrixXd::Zero(each.force.rows(), long(parameters.size()));
  out.volume = Eigen::MatrixXd::Zero(each.volume.rows(), long(parameters.size()));
  for (std::size_t k = 0; k < single.size(); ++k) {
    out.force.col(column[k]) += each.force.col(long(k));
    out.volume.col(column[k]) += each.volume.col(long(k));
  }
  return out;
}

std::vector<double> element_stiffness_products(const Scene& scene, const LoadedState& state,
                                               const Eigen::VectorXd& lambda) {
  std::vector<Parameter> scales;
  for (int t = 0; t < n_tissues; ++t) {
    scales.push_back({"", ParameterKind::scale, Tissue(t)});
  }
  std::vector<double> products(std::size_t(scene.mesh().elements()), 0);
  visit(scene, state, scales,
        [&](int e, const int* nodes, const Eigen::MatrixXd& forces, const std::vector<Column>&) {
          for (long a = 0; a < forces.rows() / 3; ++a) {
            products[std::size_t(e)] +=
                lambda.segment<3>(3L * nodes[a]).dot(forces.col(0).segment<3>(3 * a));
          }
        });
  return products;
}

}  // namespace breast
