// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluation/shape_difference.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "mesh/locate.hpp"

namespace breast {

namespace {

std::optional<View> view_of(const HexMesh& mesh) {
  return mesh.contact ? std::optional(mesh.contact->view) : std::nullopt;
}
std::string view_word(const HexMesh& mesh) {
  return mesh.contact ? view_name(mesh.contact->view) : "uncompressed";
}

// The positions of the base's nodes in the other model.
std::vector<Vec3> followed(const HexMesh& base, const HexMesh& other, double bound,
                           double& outside) {
  if (base.side != other.side || view_of(base) != view_of(other)) {
    throw input_error("the shapes differ in side or view: ", side_name(base.side), " ",
                      view_word(base), " and ", side_name(other.side), " ", view_word(other));
  }
  const Locator locator(other, other.imaged);
  std::vector<Vec3> places;
  for (const Vec3& x : base.imaged) {
    const Location found = locator.nearest(x);
    outside = std::max(outside, found.moved);
    places.push_back(element_position(other, other.points, found.element, found.local));
  }
  if (!(outside <= bound)) {
    throw input_error("a node lies ", outside, " mm outside the other model, at most ", bound,
                      " mm expected: these are not models of one scan");
  }
  return places;
}

}  // namespace

ShapeDifference shape_difference(const HexMesh& base, const HexMesh& plus, const HexMesh& minus,
                                 double step, double bound) {
  if (!(step > 0)) throw input_error("step ", step, ": must be positive");
  ShapeDifference difference;
  difference.per_node = followed(base, plus, bound, difference.outside_mm);
  const std::vector<Vec3> other = followed(base, minus, bound, difference.outside_mm);
  for (std::size_t i = 0; i < other.size(); ++i) {
    difference.per_node[i] = (difference.per_node[i] - other[i]) / (2 * step);
  }
  return difference;
}

}  // namespace breast
