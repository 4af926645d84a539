// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/place.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <set>

#include "core/error.hpp"

namespace breast {

namespace {

using Edge = std::array<int, 2>;

std::vector<Edge> unique_edges(std::vector<Edge> edges) {
  for (Edge& edge : edges) std::sort(edge.begin(), edge.end());
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

std::vector<Edge> hex_edges(const std::vector<int>& connectivity) {
  constexpr std::array<Edge, 12> local = {{{0, 1},
                                           {1, 2},
                                           {3, 2},
                                           {0, 3},
                                           {4, 5},
                                           {5, 6},
                                           {7, 6},
                                           {4, 7},
                                           {0, 4},
                                           {1, 5},
                                           {2, 6},
                                           {3, 7}}};
  std::vector<Edge> edges;
  for (std::size_t e = 0; e < connectivity.size(); e += 8) {
    for (const Edge& edge : local)
      edges.push_back({connectivity[e + edge[0]], connectivity[e + edge[1]]});
  }
  return unique_edges(std::move(edges));
}

std::vector<Edge> wall_edges(const DomeTemplate& dome) {
  std::vector<Edge> edges;
  for (const Face& face : dome.wall_faces) {
    for (int c = 0; c < 4; ++c) {
      const int* nodes = &dome.connectivity[std::size_t(face.element) * 8];
      edges.push_back({nodes[hex_face_corners[face.local][c]],
                       nodes[hex_face_corners[face.local][(c + 1) % 4]]});
    }
  }
  return unique_edges(std::move(edges));
}

// Every free node becomes the mean of its neighbours; the others keep their values. `values` is
// nodes × d.
void graph_laplace(const std::vector<Edge>& edges, const std::vector<bool>& is_free,
                   Eigen::MatrixXd& values) {
  std::vector<int> unknown(is_free.size(), -1);
  int unknowns = 0;
  for (std::size_t a = 0; a < is_free.size(); ++a) {
    if (is_free[a]) unknown[a] = unknowns++;
  }
  if (unknowns == 0) return;
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(unknowns, values.cols());
  const auto couple = [&](int a, int b) {
    if (unknown[a] < 0) return;
    entries.emplace_back(unknown[a], unknown[a], 1.0);
    if (unknown[b] >= 0) {
      entries.emplace_back(unknown[a], unknown[b], -1.0);
    } else {
      right.row(unknown[a]) += values.row(b);
    }
  };
  for (const Edge& edge : edges) {
    couple(edge[0], edge[1]);
    couple(edge[1], edge[0]);
  }
  Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
  if (factor.info() != Eigen::Success) throw failed_error("graph Laplace: the system is singular");
  const Eigen::MatrixXd solution = factor.solve(right);
  for (std::size_t a = 0; a < is_free.size(); ++a) {
    if (unknown[a] >= 0) values.row(a) = solution.row(unknown[a]);
  }
}

}  // namespace

PlacedNodes place_nodes(const DomeTemplate& dome, const BodyMap& body) {
  const std::size_t nodes = dome.places.size();
  PlacedNodes placed{std::vector<Vec3>(nodes, Vec3::Zero()), std::vector<Support>(nodes),
                     std::vector<Vec2>(nodes, Vec2::Zero())};
  std::vector<bool> on_wall(nodes), inside(nodes);
  Eigen::MatrixXd st(nodes, 2), x(nodes, 3);
  for (std::size_t a = 0; a < nodes; ++a) {
    const HullPlace& place = dome.places[a];
    placed.support[a] = place.support;
    inside[a] = place.support == Support::interior;
    on_wall[a] = place.support == Support::wall;
    if (place.support == Support::skin) placed.st[a] = body.skin(place.rho, place.u);
    if (place.support == Support::wall) placed.st[a] = body.wall(place.rho, place.u);
    if (place.support == Support::cut) {
      placed.x[a] = body.cut(place.height, place.u);
      placed.st[a] = {place.u, place.height};
    }
    // The wall's rim is the border of the wall's disc.
    st.row(a) = place.support == Support::cut ? body.wall(1, place.u) : placed.st[a];
  }
  graph_laplace(wall_edges(dome), on_wall, st);
  for (std::size_t a = 0; a < nodes; ++a) {
    if (placed.support[a] == Support::wall) {
      placed.st[a] = st.row(a);
      placed.x[a] = body.wall_sheet().position(placed.st[a]);
    } else if (placed.support[a] == Support::skin) {
      placed.x[a] = body.skin_sheet().position(placed.st[a]);
    }
    x.row(a) = placed.x[a];
  }
  graph_laplace(hex_edges(dome.connectivity), inside, x);
  for (std::size_t a = 0; a < nodes; ++a) {
    if (inside[a]) placed.x[a] = x.row(a);
  }
  return placed;
}

}  // namespace breast
