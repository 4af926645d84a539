#include "meshing/boundary_distance.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "mesh/shape.hpp"

namespace breast {

namespace {

struct Sample {
  double distance, area;
};

void sample_face(const BodyMap& body, Hull part, const Face& face, const PlacedNodes& nodes,
                 const HexMesh& mesh, std::vector<Sample>& samples) {
  constexpr int along = 5;
  const std::vector<int> list = face_nodes(mesh, face);
  std::vector<Vec2> at;
  for (int c = 0; c < 4; ++c) at.push_back(hull_point_of_node(body, part, nodes, list[c]).at);
  for (int s = 0; s < along * along; ++s) {
    const Vec2 local = Vec2(s % along + 0.5, s / along + 0.5) * (2.0 / along) - Vec2::Ones();
    const QuadShape shape = quad_shape(mesh.order, local), corner = quad_shape(1, local);
    Vec3 x = Vec3::Zero(), along_xi = Vec3::Zero(), along_eta = Vec3::Zero();
    for (std::size_t a = 0; a < list.size(); ++a) {
      x += shape.values[a] * mesh.points[list[a]];
      along_xi += shape.gradients(0, a) * mesh.points[list[a]];
      along_eta += shape.gradients(1, a) * mesh.points[list[a]];
    }
    const std::vector<double> weights(corner.values.begin(), corner.values.end());
    const HullPoint on = nearest_on_hull(body, part, mean_parameters(part, at, weights), x);
    samples.push_back({(on.x - x).norm(), along_xi.cross(along_eta).norm()});
  }
}

}  // namespace

BoundaryDistance boundary_distance(const BodyMap& body, Hull part, const std::vector<Face>& faces,
                                   const PlacedNodes& nodes, const HexMesh& mesh) {
  std::vector<Sample> samples;
  for (const Face& face : faces) sample_face(body, part, face, nodes, mesh, samples);
  std::sort(samples.begin(), samples.end(),
            [](const Sample& a, const Sample& b) { return a.distance < b.distance; });
  BoundaryDistance result;
  double area = 0, sum = 0;
  for (const Sample& s : samples) area += s.area, sum += s.area * s.distance;
  if (!(area > 0)) return result;
  result.mean = sum / area;
  result.max = samples.back().distance;
  double below = 0;
  for (const Sample& s : samples) {
    below += s.area;
    result.p95 = s.distance;
    if (below >= 0.95 * area) break;
  }
  return result;
}

}  // namespace breast
