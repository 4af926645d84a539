#include "contact/results.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/penetration.hpp"
#include "contact/skin_area.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "mesh/nodal.hpp"

namespace breast {

namespace {

constexpr int profile_points = 10;

/// Distance of a point to the nearest node of chest wall and cut, mm.
double distance_to_wall(const HexMesh& mesh, const Eigen::VectorXd& x, const Vec3& at) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto* faces : {&mesh.pectoral_faces, &mesh.cut_faces}) {
    for (const int node : nodes_of(mesh, *faces)) {
      least = std::min(least, (x.segment<3>(3L * node) - at).norm());
    }
  }
  return least;
}

/// A plate's pose, and how deep the body enters it.
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

/// Writes the record of one compression, plate by plate.
class Recorder {
 public:
  Recorder(const Scene& scene, const State& state, const ContactSolver& solver,
           CompressionResult& result)
      : mesh_(scene.mesh()),
        x_(state.x),
        solver_(solver),
        result_(result),
        area_(skin_area_per_node(mesh_, state.x)),
        faces_(free_boundary_faces(mesh_, scene.walls())) {}

  /// Force, area and pressures of plate k; adds its nodes to the contact pressures (kPa).
  PlateRecord plate(int k);
  const Vec3& total() const { return total_; }

 private:
  void add_node(std::size_t candidate, const Plate& plate, PlateRecord& record);

  const HexMesh& mesh_;
  const Eigen::VectorXd& x_;
  const ContactSolver& solver_;
  CompressionResult& result_;
  std::vector<double> area_;
  std::vector<Face> faces_;
  Vec3 total_{0, 0, 0}, force_{0, 0, 0};  // µN, of both plates and of this one
  double area_mm2_ = 0, on_edge_ = 0;
  Vec3 peak_at_{0, 0, 0};
};

void Recorder::add_node(std::size_t c, const Plate& plate, PlateRecord& record) {
  const NodalContact& contact = result_.path.final_step.contacts[c];
  const int node = solver_.candidates()[c];
  const Vec3 x = x_.segment<3>(3L * node);
  const Vec3 force = contact.normal * plate.gap(x).gradient + contact.friction;
  force_ += force;
  if (x.dot(plate.anterior) < plate.edge_start) on_edge_ += force.dot(record.normal);
  area_mm2_ += area_[std::size_t(node)];
  const double pressure = contact.normal / area_[std::size_t(node)] / pascal_per_kilopascal;
  result_.contact_pressure[std::size_t(node)] = pressure;
  if (pressure > record.peak_kPa) {
    record.peak_kPa = pressure;
    peak_at_ = x;
  }
}

PlateRecord Recorder::plate(int k) {
  const Plate& plate = result_.plates.plate(k);
  PlateRecord record = pose_of(mesh_, plate, faces_, x_);
  force_.setZero();
  area_mm2_ = on_edge_ = 0;
  const std::vector<NodalContact>& contacts = result_.path.final_step.contacts;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (contacts[c].plate == k && contacts[c].normal > 0) add_node(c, plate, record);
  }
  total_ += force_;
  const double pressing = force_.dot(record.normal);
  record.force_N = pressing / micronewton_per_newton;
  record.area_cm2 = area_mm2_ / mm2_per_cm2;
  PressedPlace& place = result_.places[std::size_t(k)];
  if (area_mm2_ > 0) {
    place.peak_at = peak_at_;
    place.peak_to_wall_mm = distance_to_wall(mesh_, x_, peak_at_);
    place.edge_part = on_edge_ / pressing;
    record.mean_kPa = pressing / area_mm2_ / pascal_per_kilopascal;
  }
  return record;
}

void record_balance(const Scene& scene, const Constraints& held, const State& state,
                    const Vec3& plates, const Vec3& weight, CompressionResult& result) {
  const Eigen::VectorXd& residual = result.path.final_step.forces.r;
  Eigen::VectorXd free = residual;
  held.project(free);
  const Eigen::VectorXd reaction = residual - free;
  Vec3 wall = scene.force_of_springs(state);
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
    result.profile_thickness_mm.push_back(
        thickness_at(mesh, x, paddle, paddle.edge_start + depth));
  }
}

ContactRecord record_of(const CompressionOptions& options, const CompressionResult& result) {
  const PlatePair& plates = result.plates;
  ContactRecord record;
  record.view = options.view;
  record.angle_deg = options.angle_deg;
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
                        const ContactSolver& solver, const Vec3& weight,
                        CompressionResult& result) {
  const HexMesh& mesh = scene.mesh();
  result.contact_pressure.assign(std::size_t(mesh.nodes()), 0);
  result.places.assign(2, {});
  ContactRecord record = record_of(options, result);
  Recorder recorder(scene, state, solver, result);
  for (int k = 0; k < 2; ++k) record.plates.push_back(recorder.plate(k));
  result.thickness_mm = record.thickness_mm;
  result.reduction_percent = record.reduction_percent;
  result.initial_thickness_mm = record.initial_thickness_mm;
  result.contact = std::move(record);
  record_balance(scene, solver.problem().constraints_at(state.x), state, recorder.total(), weight,
                 result);
  result.strains = strain_ranges(mesh, state.x);
  record_profile(mesh, state.x, solver, result);
}

}  // namespace breast
