// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/image_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/statistics/percentile.hpp"

namespace breast {

namespace {

enum class Edge { left, right, top, bottom };
constexpr std::array<Edge, 4> edges{Edge::left, Edge::right, Edge::top, Edge::bottom};

constexpr double same_grey = 0.02;   // of the image's range; frames may be compressed with loss
constexpr double nearly_all = 0.98;  // of a line's pixels
constexpr double cut_part = 0.15;    // of a line's pixels; where skin begins, fewer are not air
constexpr int smallest = 20;         // pixels; of less nothing is said

bool is_column(Edge edge) {
  return edge == Edge::left || edge == Edge::right;
}

int& border_of(ImageField& field, Edge edge) {
  switch (edge) {
    case Edge::left:
      return field.left;
    case Edge::right:
      return field.right;
    case Edge::top:
      return field.top;
    case Edge::bottom:
      break;
  }
  return field.bottom;
}

/// The grey values of the outermost line of a field at this edge.
std::vector<double> line_at(const MammogramScan& scan, ImageField field, Edge edge) {
  const int at = border_of(field, edge);
  std::vector<double> values;
  if (is_column(edge)) {
    for (int row = field.top; row <= field.bottom; ++row) values.push_back(scan.at(at, row));
  } else {
    for (int column = field.left; column <= field.right; ++column)
      values.push_back(scan.at(column, at));
  }
  return values;
}

/// The part of these values that differs from a grey value.
double part_beside(const std::vector<double>& values, double grey) {
  const auto count = std::count_if(values.begin(), values.end(), [&](double value) {
    return std::abs(value - grey) > same_grey;
  });
  return double(count) / double(values.size());
}

/// Takes lines of one grey value off an edge if they end at a cut, where many pixels differ from them. Does
/// nothing where a quarter of the image is not enough.
void take_off(const MammogramScan& scan, ImageField& field, Edge edge) {
  ImageField inner = field;
  int& at = border_of(inner, edge);
  const int most = (is_column(edge) ? scan.header.columns : scan.header.rows) / 4;
  const int step = edge == Edge::left || edge == Edge::top ? 1 : -1;
  const double grey = median(line_at(scan, inner, edge));
  for (int taken = 0; taken <= most; ++taken, at += step) {
    const double beside = part_beside(line_at(scan, inner, edge), grey);
    if (beside <= 1 - nearly_all) continue;
    if (taken > 0 && beside >= cut_part) field = inner;
    return;
  }
}

/// Grey values of a strip along the left or right border of a field.
struct Strip {
  double low = 0, middle = 0, high = 0, mean = 0;  ///< 10th, 50th, 90th percentile
  double range() const { return high - low; }
};

Strip strip_at(const MammogramScan& scan, ImageField field, Edge edge) {
  const int step = edge == Edge::left ? 1 : -1;
  // Narrow, since a large breast comes within a few mm of the border.
  const int width = std::max(3, (field.right - field.left + 1) / 30);
  int& at = border_of(field, edge);
  std::vector<double> values;
  for (int k = 0; k < width; ++k, at += step) {
    const std::vector<double> line = line_at(scan, field, edge);
    values.insert(values.end(), line.begin(), line.end());
  }
  Strip strip;
  for (const double value : values) strip.mean += value / double(values.size());
  strip.low = percentile(values, 0.1);
  strip.middle = percentile(values, 0.5);
  strip.high = percentile(values, 0.9);
  return strip;
}

}  // namespace

ImageField image_field(const MammogramScan& scan) {
  constexpr int layers = 2;  // a frame around padding
  ImageField field{0, 0, scan.header.columns - 1, scan.header.rows - 1};
  if (scan.header.columns < smallest || scan.header.rows < smallest) return field;
  for (int layer = 0; layer < layers; ++layer) {
    for (const Edge edge : edges) take_off(scan, field, edge);
  }
  return field;
}

std::optional<AirSeen> seen_air(const MammogramScan& scan, const ImageField& field,
                                const std::string& where) {
  constexpr double plain = 0.1, clearly = 0.5, standing = 0.5;
  if (scan.header.columns < smallest || scan.header.rows < smallest) return std::nullopt;
  const Strip left = strip_at(scan, field, Edge::left), right = strip_at(scan, field, Edge::right);
  const bool at_right = right.range() < left.range();
  const Strip &air = at_right ? right : left, &tissue = at_right ? left : right;
  const auto no_breast = [&](const char* at) {
    return input_error(
        where, ": no breast with air in front of it was found in this image: tissue at its ", at,
        " (is it rotated, or cut in front?)");
  };
  if (!(air.range() < plain)) throw no_breast("left and right borders");
  if (air.range() < clearly * tissue.range()) return AirSeen{at_right, air.middle > tissue.mean};
  // Both are plain: air beside a breast that stands on the upper or lower border, or padding.
  for (const Edge edge : {Edge::top, Edge::bottom}) {
    if (part_beside(line_at(scan, field, edge), air.middle) > standing)
      throw no_breast("upper or lower border, air at both others");
  }
  return std::nullopt;
}

}  // namespace breast
