// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/match_volume.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/quality.hpp"
#include "meshing/smooth.hpp"

namespace breast {

namespace {

constexpr double largest_shift = 1;  // mm

// Parameters of a node on the skin sheet, rim included.
Vec2 skin_parameters(const BodyMap& body, const PlacedNodes& nodes, int a) {
  return nodes.support[a] == Support::skin ? nodes.st[a] : body.skin(1, nodes.st[a].x());
}

// Mean, over the faces around each skin node, of the sheet's height above the centre of the face,
// mm.
std::vector<double> gaps(const BodyMap& body, const DomeTemplate& dome, const PlacedNodes& nodes) {
  std::vector<double> sum(nodes.x.size(), 0.0);
  std::vector<int> uses(nodes.x.size(), 0);
  for (const Face& face : dome.skin_faces) {
    Vec2 st = Vec2::Zero();
    Vec3 centre = Vec3::Zero();
    std::array<int, 4> corner;
    for (int c = 0; c < 4; ++c) {
      corner[c] =
          dome.connectivity[std::size_t(face.element) * 8 + hex_face_corners[face.local][c]];
      st += 0.25 * skin_parameters(body, nodes, corner[c]);
      centre += 0.25 * nodes.x[corner[c]];
    }
    const SheetPoint on_sheet = body.skin_sheet().evaluate(st);
    const double gap = (on_sheet.x - centre).dot(on_sheet.normal());
    for (const int a : corner) sum[a] += gap, ++uses[a];
  }
  for (std::size_t a = 0; a < sum.size(); ++a) {
    sum[a] = nodes.support[a] == Support::skin && uses[a] > 0 ? sum[a] / uses[a] : 0;
  }
  return sum;
}

}  // namespace

double match_volume(double wanted, const BodyMap& body, const DomeTemplate& dome,
                    const std::vector<bool>& held, PlacedNodes& nodes) {
  std::vector<double> gap = gaps(body, dome, nodes);
  for (std::size_t a = 0; a < gap.size(); ++a) {
    gap[a] = held[a] ? 0 : std::clamp(gap[a], -1.5 * largest_shift, 1.5 * largest_shift);
  }
  const auto shifted = [&](double factor) {
    std::vector<Vec3> x = nodes.x;
    for (std::size_t a = 0; a < x.size(); ++a) {
      if (gap[a] == 0) continue;
      x[a] += factor * gap[a] * body.skin_sheet().evaluate(nodes.st[a]).normal();
    }
    return x;
  };
  HexTopology mesh;
  mesh.connectivity = dome.connectivity;
  const double now = mesh_volume(mesh, nodes.x);
  const double gain = mesh_volume(mesh, shifted(1)) - now;
  if (!(gain > 0 && wanted > now)) return 0;
  double factor = std::min(2.0 / 3, (wanted - now) / gain);
  const double shape = worst_shape(dome.connectivity, nodes.x);
  for (int halvings = 0; halvings < 4; ++halvings, factor /= 2) {
    const std::vector<Vec3> x = shifted(factor);
    if (worst_shape(dome.connectivity, x) < 0.9 * shape) continue;
    nodes.x = x;
    double largest = 0;
    for (const double g : gap) largest = std::max(largest, factor * std::abs(g));
    return largest;
  }
  return 0;
}

}  // namespace breast
