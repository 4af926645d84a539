// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/results.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/faces.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "mesh/nodal.hpp"
#include "mesh/nodal_faces.hpp"

namespace breast {

namespace {

constexpr int profile_points = 10;
/// Depth of the zone at the plates' edge for which the force is reported separately, mm.
constexpr double first_zone_mm = 20;

/// Distance of a point from the nearest node of chest wall and cut, mm.
double distance_to_wall(const HexTopology& mesh, const Eigen::VectorXd& x, const Vec3& at) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto* faces : {&mesh.pectoral_faces, &mesh.cut_faces}) {
    for (const int node : nodes_of(mesh, *faces)) {
      least = std::min(least, (x.segment<3>(3L * node) - at).norm());
    }
  }
  return least;
}

/// The pose of a plate, and the depth of the body in it.
PlateRecord pose_of(const HexMesh& mesh, const Plate& plate, const std::vector<Face>& faces,
                    const Eigen::VectorXd& x) {
  PlateRecord record;
  record.name = plate.name;
  record.normal = plate.normal();
  record.anterior =
      (plate.anterior - plate.anterior.dot(record.normal) * record.normal).normalized();
  record.origin = plate.origin();
  record.edge_radius = plate.edge_radius;
  record.worst_gap_mm = deepest_penetration(mesh, faces, x, plate);
  return record;
}

/// Pressure at the nodes, kPa: the force of a node divided by the area of the surrounding faces
/// that may touch.
void record_pressure(const HexMesh& mesh, const Eigen::VectorXd& x, const ContactSolver& solver,
                     CompressionResult& result) {
  const ContactStep& step = result.path.final_step;
  const std::vector<double> area = nodal_faces(mesh, solver.contact_faces(mesh), x).area;
  for (std::size_t c = 0; c < step.contacts.size(); ++c) {
    const NodalContact& contact = step.contacts[c];
    if (contact.plate < 0 || !(contact.normal > 0)) continue;
    const int node = solver.candidates()[c];
    const double pressure = contact.normal / area[std::size_t(node)] / pascal_per_kilopascal;
    result.contact_pressure[std::size_t(node)] = pressure;
    PlateRecord& record = result.contact->plates[std::size_t(contact.plate)];
    if (!(pressure > record.peak_kPa)) continue;
    const Vec3 at = x.segment<3>(3L * node);
    record.peak_kPa = pressure;
    result.places[std::size_t(contact.plate)].peak_at = at;
    result.places[std::size_t(contact.plate)].peak_to_wall_mm = distance_to_wall(mesh, x, at);
  }
}

/// Fills force and mean pressure of a plate of known contact area, and the position of the force along
/// its depth. Returns the force on the body, µN.
Vec3 record_plate(const std::vector<PressedPoint>& points, int k, const Plate& plate,
                  PlateRecord& record, PressedPlace& place) {
  Vec3 force = Vec3::Zero();
  for (const PressedPoint& point : points) {
    if (point.plate != k) continue;
    force += point.force;
    const double along = point.force.dot(record.normal) / micronewton_per_newton;
    const double in_front = plate.in_front(point.at);
    (in_front < 0               ? place.behind_edge_N
     : in_front < first_zone_mm ? place.first_20mm_N
                                : place.beyond_20mm_N) += along;
  }
  const double pressing = force.dot(record.normal);
  record.force_N = pressing / micronewton_per_newton;
  if (record.area_cm2 > 0) {
    record.mean_kPa = pressing / (record.area_cm2 * mm2_per_cm2) / pascal_per_kilopascal;
  }
  if (pressing > 0) place.edge_part = place.behind_edge_N / record.force_N;
  return force;
}

void record_balance(const Scene& scene, const Constraints& held, const State& state,
                    const Vec3& plates, const Vec3& weight, const Vec3& load,
                    CompressionResult& result) {
  const Eigen::VectorXd& residual = result.path.final_step.forces.r;
  Eigen::VectorXd free = residual;
  held.project(free);
  const Eigen::VectorXd reaction = residual - free;
  // With the weight that hangs on the cut.
  Vec3 wall = scene.supports().force_of_springs(state) + load - weight;
  for (Eigen::Index i = 0; i < reaction.size(); i += 3) wall += reaction.segment<3>(i);
  result.wall_reaction_N = wall / micronewton_per_newton;
  result.weight_N = weight.norm() / micronewton_per_newton;
  double largest = weight.norm();
  for (const PathPoint& point : result.path.points) {
    largest = std::max(largest, point.paddle_N * micronewton_per_newton);
  }
  result.force_balance = largest > 0 ? (plates + weight + wall).norm() / largest : 0;
}

void record_profile(const HexMesh& mesh, const Eigen::VectorXd& x, const ContactSolver& solver,
                    CompressionResult& result) {
  const Plate& paddle = result.plates.paddle;
  double front = paddle.edge_start;
  for (const int node : solver.candidates()) {
    front = std::max(front, x.segment<3>(3L * node).dot(paddle.anterior));
  }
  for (int i = 0; i <= profile_points; ++i) {
    const double depth = (front - paddle.edge_start) * i / profile_points * 0.999;
    result.profile_depth_mm.push_back(depth);
    result.profile_thickness_mm.push_back(thickness_at(mesh, x, paddle, paddle.edge_start + depth));
  }
}

ContactRecord record_of(const CompressionOptions& options, const CompressionResult& result) {
  const PlatePair& plates = result.plates;
  ContactRecord record;
  record.view = options.view;
  record.angle_deg = options.angle_deg;
  record.turn_deg = result.pose.turn_deg;
  record.lean_deg = result.pose.lean_deg;
  record.bend_deg = result.pose.bend_deg;
  record.ends_image = options.plates.image_edge.has_value();
  record.thickness_mm = plates.thickness();
  record.initial_thickness_mm = plates.initial_thickness;
  record.reduction_percent = 100 * (1 - plates.thickness() / plates.initial_thickness);
  record.standoff_mm = plates.standoff;
  record.paddle_share = plates.paddle_share();
  for (const PathPoint& point : result.path.points) {
    record.path_thickness_mm.push_back(point.thickness);
    record.path_force_N.push_back(point.paddle_N);
    record.path_detector_N.push_back(point.detector_N);
  }
  return record;
}

}  // namespace

void record_compression(const Scene& scene, const CompressionOptions& options, const State& state,
                        const ContactSolver& solver, const Vec3& load, CompressionResult& result) {
  const HexMesh& mesh = scene.mesh();
  result.contact_pressure.assign(std::size_t(mesh.nodes()), 0);
  result.places.assign(2, {});
  ContactRecord record = record_of(options, result);
  solver.fill_record(state, record);
  const std::vector<Face> faces = free_boundary_faces(mesh, scene.walls());
  const std::vector<Face> touchable = solver.contact_faces(mesh);
  Vec3 total = Vec3::Zero();  // force of both plates on the body, µN
  for (int k = 0; k < 2; ++k) {
    const Plate& plate = result.plates.plate(k);
    record.plates.push_back(pose_of(mesh, plate, faces, state.x));
    record.plates.back().area_cm2 = touching_area(mesh, touchable, state.x, plate) / mm2_per_cm2;
    PressedPlace& place = result.places[std::size_t(k)];
    total += record_plate(result.path.final_step.pressed, k, plate, record.plates.back(), place);
  }
  result.contact = std::move(record);
  record_pressure(mesh, state.x, solver, result);
  record_balance(scene, solver.problem().constraints_at(state.x), state, total,
                 scene.weight(options.gravity), load, result);
  const std::vector<Vec3> positions = unflatten(state.x);
  result.self_contact = self_contact(mesh, positions);
  result.projected_cm2 = projected_cm2(mesh, positions, result.plates.paddle);
  result.coverage = coverage(mesh, state.x, result.plates.paddle);
  result.strains = strain_ranges(mesh, positions);
  record_profile(mesh, state.x, solver, result);
}

}  // namespace breast
