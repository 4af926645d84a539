#include "contact/results.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/skin_area.hpp"
#include "core/error.hpp"
#include "core/units.hpp"

namespace breast {

namespace {

constexpr int profile_points = 10;

/// Distance of a point to the nearest node of chest wall and cut, mm.
double distance_to_wall(const HexMesh& mesh, const Vec3& at) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto* faces : {&mesh.pectoral_faces, &mesh.cut_faces}) {
    for (const int node : nodes_of(mesh, *faces)) {
      least = std::min(least, (mesh.points[std::size_t(node)] - at).norm());
    }
  }
  return least;
}

/// Force, area and pressures of one plate; adds its nodes to mesh.contact_pressure (kPa).
PlateRecord record_plate(HexMesh& mesh, const Plate& plate, int k, const BodyState& state,
                         const ContactSolver& solver, const std::vector<double>& pushed,
                         const std::vector<Vec3>& rubbed, const std::vector<double>& area,
                         Vec3& total, PressedPlace& place) {
  PlateRecord record;
  record.name = plate.name;
  record.normal = plate.normal();
  record.anterior =
      (plate.anterior - plate.anterior.dot(record.normal) * record.normal).normalized();
  record.origin = plate.origin();
  record.edge_radius = plate.edge_radius;
  Vec3 force = Vec3::Zero();
  double area_mm2 = 0, on_edge = 0;
  for (std::size_t c = 0; c < pushed.size(); ++c) {
    const int node = solver.candidates()[c];
    const Gap gap = plate.gap(state.x.segment<3>(3 * node));
    record.worst_gap_mm = std::max(record.worst_gap_mm, -gap.value);
    if (solver.touching()[c] != k || !(pushed[c] > 0)) continue;
    Vec3 nodal = pushed[c] * gap.gradient;
    if (!rubbed.empty()) nodal += rubbed[c];
    force += nodal;
    if (state.x.segment<3>(3 * node).dot(plate.anterior) < plate.edge_start) {
      on_edge += nodal.dot(record.normal);
    }
    area_mm2 += area[std::size_t(node)];
    const double pressure = pushed[c] / area[std::size_t(node)] / pascal_per_kilopascal;
    mesh.contact_pressure[std::size_t(node)] = pressure;
    if (pressure > record.peak_kPa) {
      record.peak_kPa = pressure;
      place.peak_at = state.x.segment<3>(3 * node);
    }
  }
  total += force;
  record.force_N = force.dot(record.normal) / micronewton_per_newton;
  record.area_cm2 = area_mm2 / mm2_per_cm2;
  if (area_mm2 > 0) {
    place.peak_to_wall_mm = distance_to_wall(mesh, place.peak_at);
    place.edge_part = on_edge / force.dot(record.normal);
    record.mean_kPa = record.force_N * micronewton_per_newton / area_mm2 / pascal_per_kilopascal;
  }
  return record;
}

void record_balance(const BodyState& state, const ContactBody& body, const Vec3& plates,
                    const Vec3& springs, CompressionSummary& summary) {
  const Eigen::VectorXd& residual = summary.path.final_step.forces.residual;
  Eigen::VectorXd reaction = residual;
  body.remove_held(reaction);
  reaction = residual - reaction;
  Vec3 wall = springs;
  for (Eigen::Index i = 0; i < state.x.size(); i += 3) wall += reaction.segment<3>(i);
  const Vec3 weight = body.weight();
  summary.wall_reaction_N = wall / micronewton_per_newton;
  summary.weight_N = weight.norm() / micronewton_per_newton;
  double largest = weight.norm();
  for (const PathPoint& point : summary.path.points) {
    largest = std::max(largest, point.paddle_N * micronewton_per_newton);
  }
  summary.force_balance = largest > 0 ? (plates + weight + wall).norm() / largest : 0;
}

}  // namespace

void record_compression(HexMesh& mesh, const CompressionOptions& options, const BodyState& state,
                        const ContactBody& body, const ContactSolver& solver,
                        const Vec3& wall_springs, CompressionSummary& summary) {
  const PlatePair& plates = summary.plates;
  for (int n = 0; n < mesh.nodes(); ++n) mesh.points[std::size_t(n)] = state.x.segment<3>(3 * n);
  mesh.contact_pressure.assign(std::size_t(mesh.nodes()), 0);
  mesh.gravity = options.gravity;

  ContactRecord record;
  record.view = options.view;
  record.angle_deg = options.angle_deg;
  record.thickness_mm = plates.thickness();
  record.initial_thickness_mm = plates.initial_thickness;
  record.reduction_percent = 100 * (1 - plates.thickness() / plates.initial_thickness);
  record.standoff_mm = plates.standoff;
  const std::vector<double> area = skin_area_per_node(mesh, state.x);
  const std::vector<double> pushed =
      solver.normal_forces(plates, state, summary.path.final_step.forces);
  const std::vector<Vec3> rubbed =
      solver.friction_forces(plates, state);
  Vec3 total = Vec3::Zero();
  summary.places.assign(2, {});
  for (int k = 0; k < 2; ++k) {
    record.plates.push_back(record_plate(mesh, plates.plate(k), k, state, solver, pushed, rubbed,
                                         area, total, summary.places[std::size_t(k)]));
  }
  for (const PathPoint& point : summary.path.points) {
    record.path_thickness_mm.push_back(point.thickness);
    record.path_force_N.push_back(point.paddle_N);
    record.path_detector_N.push_back(point.detector_N);
  }
  summary.thickness_mm = record.thickness_mm;
  summary.reduction_percent = record.reduction_percent;
  summary.initial_thickness_mm = record.initial_thickness_mm;
  record_balance(state, body, total, wall_springs, summary);
  summary.strains = strain_ranges(mesh, state.x);
  double front = plates.paddle.edge_start;
  for (const int node : solver.candidates()) {
    front = std::max(front, state.x.segment<3>(3 * node).dot(plates.paddle.anterior));
  }
  for (int i = 0; i <= profile_points; ++i) {
    const double depth = (front - plates.paddle.edge_start) * i / profile_points * 0.999;
    summary.profile_depth_mm.push_back(depth);
    summary.profile_thickness_mm.push_back(
        thickness_at(mesh, state.x, plates.paddle, plates.paddle.edge_start + depth));
  }
  mesh.contact = std::move(record);
}

}  // namespace breast
