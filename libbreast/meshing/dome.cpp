// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/dome.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/elementary.hpp"
#include "core/error.hpp"

namespace breast {

namespace {

// Node numbers of the template. The shell is the core's surface without the inside of its bottom:
// rows 0..l of 4n perimeter nodes, then the inside of the top.
struct Numbering {
  explicit Numbering(const DomeSize& s)
      : n(s.n),
        l(s.l),
        core_nodes((s.n + 1) * (s.n + 1) * (s.l + 1)),
        shell_nodes(4 * s.n * (s.l + 1) + (s.n - 1) * (s.n - 1)) {}

  int core(int i, int j, int row) const { return (row * (n + 1) + j) * (n + 1) + i; }
  std::array<int, 2> perimeter(int p) const {
    p = (p + 4 * n) % (4 * n);
    if (p < n) return {p, 0};
    if (p < 2 * n) return {n, p - n};
    if (p < 3 * n) return {3 * n - p, n};
    return {0, 4 * n - p};
  }
  int perimeter_of(int i, int j) const {
    if (j == 0) return i;
    if (i == n) return n + j;
    return j == n ? 3 * n - i : 4 * n - j;
  }
  bool on_perimeter(int i, int j) const { return i == 0 || j == 0 || i == n || j == n; }
  /// Layer 0 is the surface of the core, layer m that of the body.
  int side(int p, int row, int layer) const {
    const auto [i, j] = perimeter(p);
    if (layer == 0) return core(i, j, row);
    return core_nodes + (layer - 1) * shell_nodes + row * 4 * n + (p + 4 * n) % (4 * n);
  }
  int top(int i, int j, int layer) const {
    if (on_perimeter(i, j)) return side(perimeter_of(i, j), l, layer);
    if (layer == 0) return core(i, j, l);
    return core_nodes + (layer - 1) * shell_nodes + 4 * n * (l + 1) + (j - 1) * (n - 1) + i - 1;
  }

  int n, l, core_nodes, shell_nodes;
};

// A point (i,j) of the n × n square in the polar form of the equiangular half cube: u around the
// square, θ from its axis, and θe of the square's edge in the same direction (45° at mid-side,
// 54.7° at corners).
struct SquarePolar {
  double u, theta, theta_edge;
};
SquarePolar square_polar(int n, double i, double j) {
  constexpr double quarter = std::numbers::pi / 4;
  const double x = elementary::tan(quarter * (2 * i / n - 1)),
               y = elementary::tan(quarter * (2 * j / n - 1));
  const double radius = std::hypot(x, y), edge = std::max(std::abs(x), std::abs(y));
  if (edge == 0) return {0, 0, quarter};
  double along;  // perimeter coordinate in sides, from the corner i = j = 0
  if (-y >= std::abs(x)) {
    along = 0.5 + elementary::atan(x / -y) / quarter / 2;
  } else if (x >= std::abs(y)) {
    along = 1.5 + elementary::atan(y / x) / quarter / 2;
  } else if (y >= std::abs(x)) {
    along = 2.5 - elementary::atan(x / y) / quarter / 2;
  } else {
    along = 3.5 - elementary::atan(y / -x) / quarter / 2;
  }
  return {along / 4 - std::floor(along / 4), elementary::atan(radius),
          elementary::atan(radius / edge)};
}

// The value of ρ at the edge of the top block: its share of the skin's area, smaller at mid-side
// than at the corners.
double edge_rho(const DomeSize& s, double theta_edge) {
  const double share = 0.97 / std::sqrt(1 + 4.0 * (s.l - s.k) / s.n);
  return share * elementary::pow(theta_edge / (std::numbers::pi / 4), 0.7);
}

HullPlace side_place(const DomeSize& s, const Numbering& number, int p, int row) {
  const auto [i, j] = number.perimeter(p);
  const SquarePolar polar = square_polar(s.n, i, j);
  HullPlace place;
  place.u = double(p) / (4 * s.n);
  if (row <= s.k) {
    place.support = Support::cut;
    place.height = double(row) / s.k;
    place.rho = 1;
  } else {
    place.support = Support::skin;
    place.rho = 1 - (1 - edge_rho(s, polar.theta_edge)) * (row - s.k) / (s.l - s.k);
  }
  return place;
}

std::vector<HullPlace> hull_places(const DomeSize& s, const Numbering& number) {
  std::vector<HullPlace> places(number.core_nodes + std::size_t(s.m) * number.shell_nodes);
  // The wall comes first, so that its rim is overwritten by that of the cut.
  for (int j = 0; j <= s.n; ++j) {
    for (int i = 0; i <= s.n; ++i) {
      const SquarePolar polar = square_polar(s.n, i, j);
      const double core_share = double(s.n) / (s.n + 2 * s.m);
      places[number.core(i, j, 0)] = {Support::wall, polar.u,
                                      core_share * polar.theta / (std::numbers::pi / 4), 0};
    }
  }
  for (int layer = 1; layer < s.m; ++layer) {
    const double rho = double(s.n + 2 * layer) / (s.n + 2 * s.m);
    for (int p = 0; p < 4 * s.n; ++p) {
      places[number.side(p, 0, layer)] = {Support::wall, double(p) / (4 * s.n), rho, 0};
    }
  }
  for (int row = 0; row <= s.l; ++row) {
    for (int p = 0; p < 4 * s.n; ++p)
      places[number.side(p, row, s.m)] = side_place(s, number, p, row);
  }
  for (int j = 1; j < s.n; ++j) {
    for (int i = 1; i < s.n; ++i) {
      const SquarePolar polar = square_polar(s.n, i, j);
      places[number.top(i, j, s.m)] = {
          Support::skin, polar.u, edge_rho(s, polar.theta_edge) * polar.theta / polar.theta_edge,
          0};
    }
  }
  return places;
}

void add_core(const DomeSize& s, const Numbering& number, DomeTemplate& dome) {
  for (int row = 0; row < s.l; ++row) {
    for (int j = 0; j < s.n; ++j) {
      for (int i = 0; i < s.n; ++i) {
        const int e = int(dome.connectivity.size()) / 8;
        for (const auto& d : {std::array{0, 0, 0},
                              {1, 0, 0},
                              {1, 1, 0},
                              {0, 1, 0},
                              {0, 0, 1},
                              {1, 0, 1},
                              {1, 1, 1},
                              {0, 1, 1}}) {
          dome.connectivity.push_back(number.core(i + d[0], j + d[1], row + d[2]));
        }
        if (row == 0) dome.wall_faces.push_back({e, 4});
        if (s.m > 0) continue;
        std::vector<Face>& sides = row < s.k ? dome.cut_faces : dome.skin_faces;
        if (i == 0) sides.push_back({e, 0});
        if (i == s.n - 1) sides.push_back({e, 1});
        if (j == 0) sides.push_back({e, 2});
        if (j == s.n - 1) sides.push_back({e, 3});
        if (row == s.l - 1) dome.skin_faces.push_back({e, 5});
      }
    }
  }
}

// Layers around the core: ζ points outwards, so that face 5 of the outermost layer is the boundary
// of the body.
void add_layers(const DomeSize& s, const Numbering& number, DomeTemplate& dome) {
  for (int layer = 0; layer < s.m; ++layer) {
    const bool outermost = layer == s.m - 1;
    for (int row = 0; row < s.l; ++row) {
      for (int p = 0; p < 4 * s.n; ++p) {
        const int e = int(dome.connectivity.size()) / 8;
        for (int up = 0; up < 2; ++up) {
          for (const auto& d : {std::array{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
            dome.connectivity.push_back(number.side(p + d[0], row + d[1], layer + up));
          }
        }
        if (row == 0) dome.wall_faces.push_back({e, 2});
        if (outermost) (row < s.k ? dome.cut_faces : dome.skin_faces).push_back({e, 5});
      }
    }
    for (int j = 0; j < s.n; ++j) {
      for (int i = 0; i < s.n; ++i) {
        const int e = int(dome.connectivity.size()) / 8;
        for (int up = 0; up < 2; ++up) {
          for (const auto& d : {std::array{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
            dome.connectivity.push_back(number.top(i + d[0], j + d[1], layer + up));
          }
        }
        if (outermost) dome.skin_faces.push_back({e, 5});
      }
    }
  }
}

}  // namespace

void check_dome(const DomeSize& s) {
  if (s.n < 2 || s.l < 2 || s.m < 0 || s.k < 1 || s.k >= s.l) {
    throw input_error("dome ", s.n, ",", s.l, ",", s.m, ",", s.k,
                      ": needs n >= 2, l >= 2, m >= 0 and 1 <= k < l");
  }
  const double elements =
      double(s.n) * s.n * s.l + double(s.m) * (double(s.n) * s.n + 4.0 * s.n * s.l);
  if (elements > 2e6) {
    throw input_error("dome ", s.n, ",", s.l, ",", s.m, ",", s.k, ": ", elements,
                      " elements; at most 2000000");
  }
}

DomeSize dome_near(int edge) {
  if (edge < 4 || edge > 120) {
    throw input_error("--elements ", edge,
                      ": must be from 4 to 120 (16 gives about 4096 elements)");
  }
  // At every size the proportions of (10,10,6) with k = 3, which suits real breasts.
  const double wanted = double(edge) * edge * edge, scale = std::cbrt(wanted / 4000);
  DomeSize best;
  double best_cost = std::numeric_limits<double>::infinity();
  for (int n = 2; n <= 2 * edge; n += 2) {
    for (int l = std::max(2, int(0.7 * n)); l <= 1.3 * n + 1; ++l) {
      for (int m = 1; m <= n; ++m) {
        DomeSize size{n, l, m, std::clamp(int(std::lround(0.3 * l)), 1, l - 1)};
        const auto square_log = [](double ratio) {
          return elementary::log(ratio) * elementary::log(ratio);
        };
        const double cost = 4 * square_log(size.elements() / wanted) +
                            square_log(n / (10 * scale)) + square_log(l / (10 * scale)) +
                            square_log(m / (6 * scale));
        if (cost < best_cost) best_cost = cost, best = size;
      }
    }
  }
  return best;
}

DomeSize dome_of(const std::vector<double>& numbers) {
  for (const double number : numbers) {
    if (number != std::floor(number) || std::abs(number) > 1000) {
      throw input_error("--dome: ", number, " is not a whole number of elements up to 1000");
    }
  }
  const DomeSize size{int(numbers[0]), int(numbers[1]), int(numbers[2]), int(numbers[3])};
  if (size.m < 1) {
    throw input_error("--dome: m must be at least 1 (--template cuboid has no layers)");
  }
  check_dome(size);
  return size;
}

DomeSize cuboid_size(int edge) {
  const DomeSize size{edge, edge, 0, std::max(1, edge / 4)};
  check_dome(size);
  return size;
}

DomeTemplate dome_template(const DomeSize& size) {
  check_dome(size);
  const Numbering number(size);
  DomeTemplate dome;
  dome.size = size;
  dome.places = hull_places(size, number);
  dome.connectivity.reserve(std::size_t(size.elements()) * 8);
  add_core(size, number, dome);
  add_layers(size, number, dome);
  return dome;
}

}  // namespace breast
