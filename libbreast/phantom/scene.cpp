// SPDX-License-Identifier: GPL-3.0-or-later
#include "phantom/scene.hpp"

#include <Eigen/LU>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/elementary.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "mesh/lattice.hpp"
#include "mesh/locate.hpp"
#include "phantom/random.hpp"

namespace breast {

PhantomBreast::PhantomBreast(const PhantomParameters& parameters, const Torso& torso, Side side)
    : shape(parameters, torso, side),
      map(shape),
      wider(parameters.body.beyond > 0
                ? std::optional<MeridianMap>(std::in_place, shape, parameters.body.beyond)
                : std::nullopt),
      gland(shape, parameters.gland, mix(parameters.seed, side == Side::left ? 201 : 202)),
      mesh(phantom_mesh(shape, body_map(), parameters.mesh)) {
  if (wider) seen = phantom_mesh(shape, map, parameters.mesh);
  assign_gland(gland, mesh);
  mesh.skin_model = parameters.skin > 0 ? SkinModel::membrane : SkinModel::none;
  if (parameters.skin > 0) mesh.skin_thickness.assign(mesh.skin_faces.size(), parameters.skin);
  place_landmarks(*this, mesh);
}

void PhantomBreast::lie_supine(const std::vector<Vec3>& points) {
  mesh.points = points;
  mesh.gravity = posture_gravity(Posture::supine);
  supine_cut.emplace(mesh);
}

PhantomScene::PhantomScene(const PhantomParameters& p)
    : parameters(p),
      torso(p.torso, mix(p.seed, 301)),
      left(std::make_unique<PhantomBreast>(p, torso, Side::left)),
      right(std::make_unique<PhantomBreast>(p, torso, Side::right)) {
  // The two cut faces must leave the sternum free between them.
  for (int i = 0; i < 360; ++i) {
    const double azimuth = i * std::numbers::pi / 180;
    if (!(left->map.skin(2, azimuth).x() > 2 && right->map.skin(2, azimuth).x() < -2)) {
      throw input_error("phantom breasts meet at the midline: larger centre_x or smaller radius");
    }
  }
}

RigidMotion misalignment(const PhantomScene& scene, double shift_mm, double turn_deg) {
  RandomStream stream(mix(scene.parameters.seed, 501));
  const auto direction = [&stream] {
    const double x = stream.normal(), y = stream.normal(), z = stream.normal();
    return Vec3(x, y, z).normalized();
  };
  RigidMotion motion;
  motion.centre = scene.torso.wall_point(0, 0);
  motion.shift = shift_mm * direction();
  motion.turn = turn_deg * direction();
  return motion;
}

void assign_gland(const GlandField& gland, HexMesh& mesh) {
  constexpr int n = 4;
  mesh.tissue.assign(mesh.elements(), Tissue::fat);
  mesh.fibroglandular_fraction.assign(mesh.elements(), 0.0f);
#pragma omp parallel for schedule(static) num_threads(threads())
  for (int e = 0; e < mesh.elements(); ++e) {
    double weight = 0, inside = 0;
    std::array<Vec3, 27> nodes;
    const int* vtk = lattice::vtk_nodes(mesh.order);
    for (int a = 0; a < mesh.nodes_per_element(); ++a)
      nodes[a] = mesh.reference[mesh.element(e)[vtk[a]]];
    for (int s = 0; s < n * n * n; ++s) {
      const Vec3 local((2 * (s % n) + 1.0) / n - 1, (2 * (s / n % n) + 1.0) / n - 1,
                       (2 * (s / n / n) + 1.0) / n - 1);
      Vec3 x;
      Mat3 jacobian;
      lattice::evaluate(mesh.order, nodes.data(), local, x, jacobian);
      const double volume = jacobian.determinant();
      weight += volume;
      if (gland.distance(x) < 0) inside += volume;
    }
    mesh.fibroglandular_fraction[e] = float(inside / weight);
    if (inside > 0.5 * weight) mesh.tissue[e] = Tissue::fibroglandular;
  }
}

namespace {

// The point on the margin of the gland that is nearest to `wanted`.
Vec3 margin_point(const PhantomBreast& breast, const Vec3& wanted) {
  Vec3 best = wanted;
  double best_cost = std::numeric_limits<double>::infinity();
  constexpr int n = 30;
  for (int k = -n; k <= n; ++k)
    for (int j = -n; j <= n; ++j)
      for (int i = -n; i <= n; ++i) {
        const Vec3 x = wanted + Vec3(i, j, k);
        const double off = std::abs(breast.gland.distance(x));
        if (off > 0.4 || breast.shape.skin_distance(x) > -8 ||
            breast.shape.torso().wall_distance(x) < 8) {
          continue;
        }
        const double cost = (x - wanted).norm() + 5 * off;
        if (cost < best_cost) best_cost = cost, best = x;
      }
  return best;
}

// Farthest-point selection among element centres at least 6 mm inside, for an even distribution.
std::vector<int> spread_elements(const PhantomBreast& breast, const HexMesh& mesh, int count) {
  std::vector<int> candidates, chosen;
  std::vector<Vec3> centres;
  for (int e = 0; e < mesh.elements(); ++e) {
    const Vec3 x = element_position(mesh, mesh.reference, e, Vec3::Zero());
    if (breast.shape.beyond_fold(x, 0.0) < 0 && breast.shape.skin_distance(x) < -6 &&
        breast.shape.torso().wall_distance(x) > 6) {
      candidates.push_back(e);
      centres.push_back(x);
    }
  }
  std::vector<double> distance(candidates.size(), std::numeric_limits<double>::infinity());
  Vec3 last = breast.shape.apex();
  while (int(chosen.size()) < count && chosen.size() < candidates.size()) {
    std::size_t farthest = 0;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      distance[i] = std::min(distance[i], (centres[i] - last).norm());
      if (distance[i] > distance[farthest]) farthest = i;
    }
    chosen.push_back(candidates[farthest]);
    last = centres[farthest];
  }
  return chosen;
}

}  // namespace

void place_landmarks(const PhantomBreast& breast, HexMesh& mesh) {
  mesh.landmarks.clear();
  const auto add = [&](const std::string& name, const Location& at) {
    const Vec3 imaged = element_position(mesh, mesh.imaged, at.element, at.local);
    mesh.landmarks.push_back({name, imaged, at.element, at.local, 0.0});
  };
  add("nipple",
      nearest_on_faces(mesh, mesh.reference, mesh.skin_faces, mesh.reference[mesh.nipple_node]));
  const double height = (breast.shape.apex() - breast.shape.foot()).norm();
  const Vec3 up = breast.shape.radial(0.5 * std::numbers::pi);
  const Vec3 out = lateral_sign(mesh.side) * breast.shape.radial(0);
  const BreastParameters& p = breast.shape.parameters();
  const double azimuth = p.tumour_azimuth * std::numbers::pi / 180;
  const Vec3 wanted =
      breast.shape.foot() + p.tumour_level * height * breast.shape.axis() +
      p.tumour_aside * p.radius * (elementary::cos(azimuth) * out + elementary::sin(azimuth) * up);
  const Vec3 tumour = margin_point(breast, wanted);
  add("tumour", Locator(mesh, mesh.reference).nearest(tumour));
  mesh.tumour_node = nearest_node(mesh.reference, tumour);
  int number = 0;
  for (int e : spread_elements(breast, mesh, 50)) {
    ++number;
    add("interior-" + std::string(number < 10 ? "0" : "") + std::to_string(number),
        {e, Vec3::Zero(), 0});
  }
}

}  // namespace breast
