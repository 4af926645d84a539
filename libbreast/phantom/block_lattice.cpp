// SPDX-License-Identifier: GPL-3.0-or-later
#include "phantom/block_lattice.hpp"

#include <cmath>
#include <numbers>

#include "core/elementary.hpp"

namespace breast {

BlockLattice::BlockLattice(const MeshParameters& size)
    : order_(size.order),
      c_(size.core * order_),
      m_(size.shell * order_),
      s_(size.skirt * order_),
      k_(size.slab * order_),
      l_(size.rise * order_) {
  disc_ = (c_ + 1) * (c_ + 1) + 4 * c_ * (m_ + s_);
  slab_nodes_ = disc_ * (k_ + 1);
  core_nodes_ = (c_ + 1) * (c_ + 1) * l_;
  side_nodes_ = 4 * c_ * l_ * m_;
  place_nodes();
  add_slab();
  add_dome();
  nipple = top_shell(c_ / 2, c_ / 2, m_);
}

// Point on the perimeter of the square, counter-clockwise from the corner (0,0), t in 0..4C.
int BlockLattice::perimeter_i(int t) const {
  t = ((t % (4 * c_)) + 4 * c_) % (4 * c_);
  if (t < c_) return t;
  if (t < 2 * c_) return c_;
  if (t < 3 * c_) return 3 * c_ - t;
  return 0;
}
int BlockLattice::perimeter_j(int t) const {
  return perimeter_i(t - c_);
}

int BlockLattice::slab_core(int i, int j, int level) const {
  return level * disc_ + j * (c_ + 1) + i;
}
int BlockLattice::slab_ring(int t, int ring, int level) const {
  if (ring == 0) return slab_core(perimeter_i(t), perimeter_j(t), level);
  t = ((t % (4 * c_)) + 4 * c_) % (4 * c_);
  return level * disc_ + (c_ + 1) * (c_ + 1) + (ring - 1) * 4 * c_ + t;
}
int BlockLattice::core(int i, int j, int k) const {
  if (k == 0) return slab_core(i, j, k_);
  return slab_nodes_ + ((k - 1) * (c_ + 1) + j) * (c_ + 1) + i;
}
int BlockLattice::side_shell(int t, int k, int layer) const {
  if (layer == 0) return core(perimeter_i(t), perimeter_j(t), k);
  if (k == 0) return slab_ring(t, layer, k_);
  t = ((t % (4 * c_)) + 4 * c_) % (4 * c_);
  return slab_nodes_ + core_nodes_ + ((layer - 1) * l_ + k - 1) * 4 * c_ + t;
}
int BlockLattice::top_shell(int i, int j, int layer) const {
  if (layer == 0) return core(i, j, l_);
  // The square's border belongs to the side shell's topmost row.
  if (j == 0) return side_shell(i, l_, layer);
  if (i == c_) return side_shell(c_ + j, l_, layer);
  if (j == c_) return side_shell(3 * c_ - i, l_, layer);
  if (i == 0) return side_shell(4 * c_ - j, l_, layer);
  return slab_nodes_ + core_nodes_ + side_nodes_ + ((layer - 1) * (c_ - 1) + j - 1) * (c_ - 1) + i -
         1;
}

// Interpolates between a half cube of half width `size` and the half ball through the centres of
// its faces.
Vec3 BlockLattice::core_place(int i, int j, int k) const {
  constexpr double rounding = 0.6;
  const double size = 0.92 * c_ / (c_ + 2.0 * m_) + 0.04;
  const double u = 2.0 * i / c_ - 1, v = 2.0 * j / c_ - 1, w = double(k) / l_;
  const double a = u * u, b = v * v, c = w * w;
  const Vec3 ball(u * std::sqrt(1 - b / 2 - c / 2 + b * c / 3),
                  v * std::sqrt(1 - c / 2 - a / 2 + c * a / 3),
                  w * std::sqrt(1 - a / 2 - b / 2 + a * b / 3));
  return size * ((1 - rounding) * Vec3(u, v, w) + rounding * ball);
}

// Equiangular point of the unit sphere for a node of the half cube's surface.
Vec3 BlockLattice::sphere_place(int i, int j, int k) const {
  constexpr double quarter = std::numbers::pi / 4;
  return Vec3(elementary::tan(quarter * (2.0 * i / c_ - 1)),
              elementary::tan(quarter * (2.0 * j / c_ - 1)), elementary::tan(quarter * k / l_))
      .normalized();
}

void BlockLattice::place_nodes() {
  places_.resize(slab_nodes_ + core_nodes_ + side_nodes_ + (c_ - 1) * (c_ - 1) * m_);
  const auto shell = [&](int i, int j, int k, int layer) -> Vec3 {
    const double t = double(layer) / m_;
    return (1 - t) * core_place(i, j, k) + t * sphere_place(i, j, k);
  };
  for (int k = 1; k <= l_; ++k)
    for (int j = 0; j <= c_; ++j)
      for (int i = 0; i <= c_; ++i)
        places_[core(i, j, k)] = {true, core_place(i, j, k), 0, false, false};
  for (int layer = 1; layer <= m_; ++layer) {
    for (int k = 1; k <= l_; ++k)
      for (int t = 0; t < 4 * c_; ++t)
        places_[side_shell(t, k, layer)] = {true, shell(perimeter_i(t), perimeter_j(t), k, layer),
                                            0, layer == m_, false};
    for (int j = 1; j < c_; ++j)
      for (int i = 1; i < c_; ++i)
        places_[top_shell(i, j, layer)] = {true, shell(i, j, l_, layer), 0, layer == m_, false};
  }
  for (int level = 0; level <= k_; ++level) {
    const double height = double(level) / k_;
    for (int j = 0; j <= c_; ++j)
      for (int i = 0; i <= c_; ++i)
        places_[slab_core(i, j, level)] = {false, core_place(i, j, 0), height, false, level == 0};
    for (int ring = 1; ring <= m_ + s_; ++ring)
      for (int t = 0; t < 4 * c_; ++t) {
        const int i = perimeter_i(t), j = perimeter_j(t);
        const Vec3 at = ring <= m_ ? shell(i, j, 0, ring)
                                   : Vec3(sphere_place(i, j, 0) * (1 + double(ring - m_) / s_));
        places_[slab_ring(t, ring, level)] = {false, at, height, level == k_ && ring >= m_,
                                              level == 0};
      }
  }
}

namespace {
// Nodes of one element from a node function of three lattice steps.
template <class Node>
std::vector<int> element_nodes(int order, Node node) {
  std::vector<int> nodes;
  for (int c = 0; c <= order; ++c)
    for (int b = 0; b <= order; ++b)
      for (int a = 0; a <= order; ++a) nodes.push_back(node(a, b, c));
  return nodes;
}
}  // namespace

void BlockLattice::add_slab() {
  const int o = order_;
  for (int k = 0; k < k_; k += o) {
    const auto add = [&](auto node) {
      if (k == 0) wall.push_back({int(elements.size()), 4});
      elements.push_back(element_nodes(o, node));
    };
    for (int j = 0; j < c_; j += o)
      for (int i = 0; i < c_; i += o)
        add([&](int a, int b, int c) { return slab_core(i + a, j + b, k + c); });
    for (int ring = 0; ring < m_ + s_; ring += o)
      for (int t = 0; t < 4 * c_; t += o) {
        // First direction outwards, second counter-clockwise, third away from the wall.
        if (ring >= m_ && k + o == k_) skin.push_back({int(elements.size()), 5});
        if (ring + o == m_ + s_) cut.push_back({int(elements.size()), 1});
        add([&](int a, int b, int c) { return slab_ring(t + b, ring + a, k + c); });
      }
  }
}

void BlockLattice::add_dome() {
  const int o = order_;
  const auto add = [&](auto node) { elements.push_back(element_nodes(o, node)); };
  for (int k = 0; k < l_; k += o)
    for (int j = 0; j < c_; j += o)
      for (int i = 0; i < c_; i += o)
        add([&](int a, int b, int c) { return core(i + a, j + b, k + c); });
  for (int layer = 0; layer < m_; layer += o) {
    const bool outermost = layer + o == m_;
    for (int k = 0; k < l_; k += o)
      for (int t = 0; t < 4 * c_; t += o) {
        if (outermost) skin.push_back({int(elements.size()), 1});
        add([&](int a, int b, int c) { return side_shell(t + b, k + c, layer + a); });
      }
    for (int j = 0; j < c_; j += o)
      for (int i = 0; i < c_; i += o) {
        if (outermost) skin.push_back({int(elements.size()), 5});
        add([&](int a, int b, int c) { return top_shell(i + a, j + b, layer + c); });
      }
  }
}

}  // namespace breast
