// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/skin_area.hpp"

#include <algorithm>
#include <limits>

#include "contact/penetration.hpp"

namespace breast {

std::vector<Face> contact_faces(const HexMesh& mesh, bool surface_contact) {
  return surface_contact ? touchable_faces(mesh) : mesh.skin_faces;
}

double thickness_at(const HexMesh& mesh, const Eigen::VectorXd& x, const Plate& plate, double a) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Face& face : mesh.skin_faces) {
    const std::vector<int> nodes = face_nodes(mesh, face);
    for (int c = 0; c < 4; ++c) {
      const Vec3 here = x.segment<3>(3 * nodes[std::size_t(c)]);
      const Vec3 next = x.segment<3>(3 * nodes[std::size_t((c + 1) % 4)]);
      const double p = here.dot(plate.anterior) - a, q = next.dot(plate.anterior) - a;
      if ((p < 0) == (q < 0)) continue;
      const double h = (here + p / (p - q) * (next - here)).dot(plate.n);
      low = std::min(low, h);
      high = std::max(high, h);
    }
  }
  return low <= high ? high - low : 0;
}

}  // namespace breast
