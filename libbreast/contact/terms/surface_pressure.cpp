// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/terms/surface_pressure.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/parallel.hpp"
#include "mechanics/terms/toe_spring.hpp"
#include "mesh/gauss.hpp"
#include "mesh/nodal.hpp"
#include "mesh/nodal_faces.hpp"
#include "mesh/shape.hpp"

namespace breast {

namespace {

/// Depth over which the pressure increases quadratically, mm.
constexpr double onset = 0.02;
/// Distance between points where a plate is rounded, mm: a third of the width over which an edge of
/// 3 mm touches a face at a depth of 0.05 mm, 2 √(2 · 3 · 0.05). With fewer points the edge would
/// slip from one to the next.
constexpr double fine_spacing = 0.35;
/// Faces within this distance of the rounded part may come into contact with it, mm.
constexpr double edge_margin = 5;
/// Number of cells of 2×2 Gauss points along a side of a face; the first is used where the plates
/// are flat.
constexpr int cells_a_side[] = {6, 12, 20, 32};

/// Under a flat part a face is deepest at a node, where there is no Gauss point: this fraction of
/// the face's area belongs to its nodes there.
constexpr double nodal_part = 0.2;

/// Energy (nJ/mm²), pressure (Pa) and its slope (Pa/mm) at a depth in a plate.
ToeSpring pressure_at(double depth, double stiffness) {
  return toe_spring(depth, onset, stiffness);
}

/// |∂x/∂ξ × ∂x/∂η| of a face whose nodes are at `position`(node).
template <typename Position>
double area_scale(const int* nodes, int count, const QuadShape& shape, const Position& position) {
  Vec3 a1 = Vec3::Zero(), a2 = Vec3::Zero();
  for (int a = 0; a < count; ++a) {
    const Vec3 x = position(nodes[a]);
    a1 += shape.gradients(0, a) * x;
    a2 += shape.gradients(1, a) * x;
  }
  return a1.cross(a2).norm();
}

}  // namespace

struct SurfacePressure::Rule {
  Rule(int order, int cells) : cells(cells) {
    for (int j = 0; j < cells; ++j) {
      for (int i = 0; i < cells; ++i) {
        for (const auto& [at, w] : gauss_square(2)) {
          weight.push_back(w / (cells * cells));
          shape.push_back(quad_shape(
              order, {(2 * i + 1 + at.x()) / cells - 1, (2 * j + 1 + at.y()) / cells - 1}));
        }
      }
    }
  }
  int cells;
  std::vector<double> weight;
  std::vector<QuadShape> shape;
};

/// A point of a face that lies in a plate.
struct SurfacePressure::Touch {
  int plate = 0;
  const QuadShape& shape;
  Vec3 at{0, 0, 0};
  Gap gap;
  double area = 0;  ///< area on the imaged face, mm²
};

struct SurfacePressure::FaceResult {
  double energy = 0;
  Eigen::VectorXd residual;  // empty if nothing touches
  Eigen::MatrixXd matrix;
};

SurfacePressure::SurfacePressure(const HexMesh& mesh, const std::vector<Face>& faces,
                                 const Discretisation& space)
    : order_(mesh.order), imaged_(mesh.imaged) {
  cells_.nodes_per_cell = order_ == 1 ? 4 : 9;
  const Eigen::VectorXd imaged = flatten(mesh.imaged);
  for (const Face& face : faces) {
    const std::vector<int> nodes = face_nodes(mesh, face);
    const std::vector<double> area = nodal_faces(mesh, {face}, imaged).area;
    for (const int node : nodes) nodal_area_.push_back(area[std::size_t(node)]);
    cells_.nodes.insert(cells_.nodes.end(), nodes.begin(), nodes.end());
  }
  if (space.pattern) scatter_ = std::make_shared<ScatterMap>(*space.pattern, cells_);
  for (const int cells : cells_a_side) rules_.emplace_back(order_, cells);
  const Vec2 local[] = {{-1, -1}, {1, -1}, {1, 1},  {-1, 1}, {0, -1},
                        {1, 0},   {0, 1},  {-1, 0}, {0, 0}};
  for (int a = 0; a < cells_.nodes_per_cell; ++a)
    nodal_shape_.push_back(quad_shape(order_, local[a]));
  chosen_.assign(std::size_t(cells_.count()), 0);
}

SurfacePressure::~SurfacePressure() = default;

bool SurfacePressure::choose_points(const Eigen::VectorXd& x, bool keep_finer) {
  std::vector<int> chosen;
  for (int f = 0; f < cells_.count(); ++f) {
    chosen.push_back(std::max(rule_for(f, x), keep_finer ? chosen_[std::size_t(f)] : 0));
  }
  chosen.swap(chosen_);
  return chosen != chosen_;
}

bool SurfacePressure::set_face_rules(const std::vector<int>& rules) {
  const bool known = rules.size() == chosen_.size() && std::ranges::all_of(rules, [&](int rule) {
                       return rule >= 0 && rule < int(rules_.size());
                     });
  if (known) chosen_ = rules;
  return known;
}

int SurfacePressure::rule_for(int face, const Eigen::VectorXd& x) const {
  const Plate& plate = plates_.paddle;  // the edges of the detector lie under those of the paddle
  const int* nodes = cells_.cell(face);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  // Outward directions of the plate's four edges.
  std::array<double, 4> low, high;
  low.fill(infinity);
  high.fill(-infinity);
  double longest = 0;
  for (int a = 0; a < 4; ++a) {
    const Vec3 here = x.segment<3>(3L * nodes[a]), next = x.segment<3>(3L * nodes[(a + 1) % 4]);
    const double along = here.dot(plate.anterior);
    const double across = here.dot(plate.lateral) - plate.lateral_centre;
    const double beyond[] = {plate.edge_start - along, along - plate.far_edge,
                             across - plate.half_width, -across - plate.half_width};
    for (std::size_t k = 0; k < 4; ++k) {
      low[k] = std::min(low[k], beyond[k]);
      high[k] = std::max(high[k], beyond[k]);
    }
    longest = std::max(longest, (next - here).norm());
  }
  bool near_an_edge = false;
  for (std::size_t k = 0; k < 4; ++k) {
    near_an_edge =
        near_an_edge || (high[k] > -edge_margin && low[k] < plate.edge_radius + edge_margin);
  }
  if (!near_an_edge) return 0;
  int rule = 1;
  while (rule + 1 < int(rules_.size()) &&
         rules_[std::size_t(rule)].cells * 2 * fine_spacing < longest) {
    ++rule;
  }
  return rule;
}

/// Calls each(Touch) for the points of a face that lie in a plate.
template <typename Visit>
void SurfacePressure::visit(int face, const Eigen::VectorXd& x, Visit&& each) const {
  const int* nodes = cells_.cell(face);
  const int n = cells_.nodes_per_cell;
  const auto now = [&](int node) { return Vec3(x.segment<3>(3L * node)); };
  Vec3 centre = Vec3::Zero();
  double radius = 0;
  for (int a = 0; a < n; ++a) centre += now(nodes[a]) / n;
  for (int a = 0; a < n; ++a) radius = std::max(radius, (now(nodes[a]) - centre).norm());
  const int chosen = chosen_[std::size_t(face)];
  const Rule& rule = rules_[std::size_t(chosen)];
  const double part = chosen == 0 ? 1 - nodal_part : 1;
  for (int k = 0; k < 2; ++k) {
    const Plate& plate = plates_.plate(k);
    if (plate.gap(centre).value > radius) continue;
    for (std::size_t q = 0; q < rule.weight.size(); ++q) {
      const QuadShape& shape = rule.shape[q];
      Vec3 at = Vec3::Zero();
      for (int a = 0; a < n; ++a) at += shape.values[a] * now(nodes[a]);
      const Gap gap = plate.gap(at);
      if (!(gap.value < 0)) continue;
      const double area = part * rule.weight[q] * area_scale(nodes, n, shape, [&](int node) {
                            return imaged_[std::size_t(node)];
                          });
      each(Touch{k, shape, at, gap, area});
    }
    for (int a = 0; chosen == 0 && a < n; ++a) {
      const Gap gap = plate.gap(now(nodes[a]));
      if (!(gap.value < 0)) continue;
      each(Touch{k, nodal_shape_[std::size_t(a)], now(nodes[a]), gap,
                 nodal_part * nodal_area_[std::size_t(face * n + a)]});
    }
  }
}

SurfacePressure::FaceResult SurfacePressure::face_result(int face, const Eigen::VectorXd& x,
                                                         bool tangent) const {
  const int n = cells_.nodes_per_cell;
  FaceResult out;
  visit(face, x, [&](const Touch& touch) {
    if (out.residual.size() == 0) {
      out.residual = Eigen::VectorXd::Zero(3 * n);
      if (tangent) out.matrix = Eigen::MatrixXd::Zero(3 * n, 3 * n);
    }
    const Gap& gap = touch.gap;
    const ToeSpring p = pressure_at(-gap.value, stiffness_);
    out.energy += touch.area * p.energy;
    for (int a = 0; a < n; ++a) {
      out.residual.segment<3>(3 * a) -= touch.shape.values[a] * touch.area * p.force * gap.gradient;
    }
    if (!tangent) return;
    const double turning = pressure_at(std::min(-gap.value, turning_depth_), stiffness_).force;
    const Mat3 block = touch.area * (p.stiffness * gap.gradient * gap.gradient.transpose() -
                                     turning * gap.hessian);
    for (int a = 0; a < n; ++a) {
      for (int b = 0; b < n; ++b) {
        out.matrix.block<3, 3>(3 * a, 3 * b) +=
            touch.shape.values[a] * touch.shape.values[b] * block;
      }
    }
  });
  return out;
}

bool SurfacePressure::add(const State& state, const Request& request, Forces& forces) const {
  const bool tangent = request.matrix != nullptr || request.packed != nullptr;
  std::vector<FaceResult> results(static_cast<std::size_t>(cells_.count()));
#pragma omp parallel for num_threads(threads()) schedule(dynamic, 8)
  for (int f = 0; f < cells_.count(); ++f) {
    results[std::size_t(f)] = face_result(f, state.x, tangent);
  }
  add_results(results, request, forces);
  return true;
}

/// Sums are made in face order, so that they do not depend on the number of threads.
void SurfacePressure::add_results(const std::vector<FaceResult>& results, const Request& request,
                                  Forces& forces) const {
  const int n = cells_.nodes_per_cell;
  const std::size_t size = std::size_t(9) * n * n;
  std::vector<double> matrices(request.matrix != nullptr ? results.size() * size : 0, 0.0);
  PackedCells* packed = request.packed != nullptr ? &request.packed->next(cells_) : nullptr;
  for (std::size_t f = 0; f < results.size(); ++f) {
    const FaceResult& out = results[f];
    if (out.residual.size() == 0) continue;
    forces.energy += out.energy;
    for (int a = 0; a < n; ++a) {
      const long at = 3L * cells_.cell(int(f))[a];
      forces.r.segment<3>(at) += out.residual.segment<3>(3 * a);
      if (request.kappa != nullptr) {
        forces.augmented.segment<3>(at) += out.residual.segment<3>(3 * a);
      }
    }
    if (request.matrix != nullptr) std::copy_n(out.matrix.data(), size, matrices.data() + f * size);
    if (packed != nullptr) packed->set(int(f), out.matrix.data());
  }
  if (request.matrix != nullptr) {
    request.matrix->stiffness.add_cells(*scatter_, 0, cells_.count(), matrices.data());
  }
}

std::vector<int> SurfacePressure::nodes() const {
  std::vector<int> all = cells_.nodes;
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

Eigen::VectorXd SurfacePressure::plate_forces(const Eigen::VectorXd& x, int plate) const {
  Eigen::VectorXd total = Eigen::VectorXd::Zero(x.size());
  for (int f = 0; f < cells_.count(); ++f) {
    visit(f, x, [&](const Touch& touch) {
      if (touch.plate != plate) return;
      const Vec3 force =
          touch.area * pressure_at(-touch.gap.value, stiffness_).force * touch.gap.gradient;
      for (int a = 0; a < cells_.nodes_per_cell; ++a) {
        total.segment<3>(3L * cells_.cell(f)[a]) += touch.shape.values[a] * force;
      }
    });
  }
  return total;
}

Eigen::VectorXd SurfacePressure::change_of_forces(
    const Eigen::VectorXd& x, int plate, const Eigen::VectorXd* moved,
    const std::function<GapSlope(int plate, const Gap&, const Vec3&)>& slope) const {
  Eigen::VectorXd total = Eigen::VectorXd::Zero(x.size());
  const int n = cells_.nodes_per_cell;
  for (int f = 0; f < cells_.count(); ++f) {
    const int* nodes = cells_.cell(f);
    visit(f, x, [&](const Touch& touch) {
      if (plate >= 0 && touch.plate != plate) return;
      GapSlope change = slope(touch.plate, touch.gap, touch.at);
      if (moved != nullptr) {
        Vec3 motion = Vec3::Zero();
        for (int a = 0; a < n; ++a) {
          motion += touch.shape.values[a] * moved->segment<3>(3L * nodes[a]);
        }
        change.value += touch.gap.gradient.dot(motion);
        change.gradient += touch.gap.hessian * motion;
      }
      const ToeSpring p = pressure_at(-touch.gap.value, stiffness_);
      const Vec3 force = touch.area * (p.force * change.gradient -
                                       p.stiffness * change.value * touch.gap.gradient);
      for (int a = 0; a < n; ++a) total.segment<3>(3L * nodes[a]) += touch.shape.values[a] * force;
    });
  }
  return total;
}

std::vector<PressedPoint> SurfacePressure::pressed(const Eigen::VectorXd& x) const {
  std::vector<PressedPoint> points;
  for (int f = 0; f < cells_.count(); ++f) {
    visit(f, x, [&](const Touch& touch) {
      const double pressure = pressure_at(-touch.gap.value, stiffness_).force;
      points.push_back({touch.plate, touch.at, touch.area * pressure * touch.gap.gradient});
    });
  }
  return points;
}

double SurfacePressure::deepest(const Eigen::VectorXd& x) const {
  double worst = 0;
  for (int f = 0; f < cells_.count(); ++f) {
    visit(f, x, [&](const Touch& touch) { worst = std::max(worst, -touch.gap.value); });
  }
  return worst;
}

}  // namespace breast
