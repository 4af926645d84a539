// SPDX-License-Identifier: GPL-3.0-or-later
#include "identification/landmark_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "core/error.hpp"

namespace breast {

namespace {

// The nipples of women move by 52 to 170 mm (5 to 95 %), those of the largest phantom by 190 mm.
constexpr double longest_move = 400, usual_move = 250;
// Tissue between two landmarks is stretched or shortened less than this.
constexpr double most_stretch = 5, deviations = 6;

using Slip = std::function<LandmarkPair(LandmarkPair)>;
using Pairs = std::vector<LandmarkPair>;

Vec3 from_ras(const Vec3& x) {
  return {-x.x(), -x.y(), x.z()};
}

// Common mistakes, the most likely first.
const std::vector<std::pair<std::string, Slip>>& slips() {
  static const std::vector<std::pair<std::string, Slip>> list{
      {"prone and supine seem to be interchanged: interchange the columns",
       [](LandmarkPair p) { return std::swap(p.imaged, p.second), p; }},
      {"coordinates seem to be RAS: change the signs of x and y, since LPS is expected",
       [](LandmarkPair p) {
         p.imaged = from_ras(p.imaged), p.second = from_ras(p.second);
         return p;
       }},
      {"coordinates seem to be in metres: multiply them by 1000, since mm are expected",
       [](LandmarkPair p) { return p.imaged *= 1000, p.second *= 1000, p; }},
      {"coordinates seem to be in centimetres: multiply them by 10, since mm are expected",
       [](LandmarkPair p) { return p.imaged *= 10, p.second *= 10, p; }}};
  return list;
}

// A mistake in the second posture only.
const std::vector<std::pair<std::string, Slip>>& second_slips() {
  static const std::vector<std::pair<std::string, Slip>> list{
      {"the second posture's coordinates seem to be RAS: change the signs of their x and y",
       [](LandmarkPair p) { return p.second = from_ras(p.second), p; }},
      {"the second posture's coordinates seem to be in metres: multiply them by 1000",
       [](LandmarkPair p) { return p.second *= 1000, p; }},
      {"the second posture's coordinates seem to be in centimetres: multiply them by 10",
       [](LandmarkPair p) { return p.second *= 10, p; }}};
  return list;
}

// Whether half of the landmarks lie in the body.
bool mostly_inside(const Pairs& pairs, const Locator& body, double outside) {
  const auto inside = std::count_if(pairs.begin(), pairs.end(), [&](const LandmarkPair& p) {
    return body.nearest(p.imaged).moved <= outside;
  });
  return 2 * inside > long(pairs.size());
}

// The marks of a breast are never all within a few mm: tiny coordinates near the origin indicate
// another unit.
bool clumped(const Pairs& pairs) {
  constexpr double tiny = 2;  // mm
  return pairs.size() > 2 && std::all_of(pairs.begin(), pairs.end(), [&](const LandmarkPair& p) {
           return (p.imaged - pairs.front().imaged).norm() < tiny;
         });
}

bool move_as_breasts_do(const Pairs& pairs) {
  const auto moved = std::count_if(pairs.begin(), pairs.end(), [](const LandmarkPair& p) {
    return (p.second - p.imaged).norm() <= usual_move;
  });
  return 2 * moved > long(pairs.size());
}

Pairs with(const Slip& slip, const Pairs& pairs) {
  Pairs out;
  std::transform(pairs.begin(), pairs.end(), std::back_inserter(out), slip);
  return out;
}

void check_frames(const Pairs& pairs, const Locator& body, double outside,
                  const std::string& where) {
  if (clumped(pairs) || !mostly_inside(pairs, body, outside)) {
    for (const auto& [what, slip] : slips()) {
      const Pairs changed = with(slip, pairs);
      if (!clumped(changed) && mostly_inside(changed, body, outside))
        throw input_error(where, ": ", what);
    }
  } else if (!move_as_breasts_do(pairs)) {
    for (const auto& [what, slip] : second_slips()) {
      const Pairs changed = with(slip, pairs);
      if (move_as_breasts_do(changed)) throw input_error(where, ": ", what);
    }
  }
}

void check_names(const Pairs& pairs, const std::string& where) {
  std::set<std::string> names;
  for (const LandmarkPair& pair : pairs)
    if (!names.insert(pair.name).second)
      throw input_error(where, ": landmark '", pair.name, "' appears twice");
}

// Tissue is continuous, so that the change of the distance between two landmarks is bounded.
void check_neighbours(const Pairs& pairs, const std::string& where) {
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const double before = (pairs[i].imaged - pairs[k].imaged).norm(),
                   after = (pairs[i].second - pairs[k].second).norm(),
                   slack = deviations * std::hypot(pairs[i].observer, pairs[k].observer);
      if (after <= most_stretch * before + slack && before <= most_stretch * after + slack)
        continue;
      throw input_error(where, ": landmarks '", pairs[k].name, "' and '", pairs[i].name,
                        "' contradict each other: ", format_fixed(before, 1),
                        " mm apart in the scan, ", format_fixed(after, 1),
                        " mm in the second posture; check their names and positions");
    }
  }
}

}  // namespace

std::vector<LandmarkPair> landmark_pairs(const Table& table, Side side, double observer) {
  Pairs pairs;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    if (table.has("side") && side_from_name(table.cell(row, "side")) != side) continue;
    LandmarkPair pair{"row " + std::to_string(row + 1), table.point(row, "prone_"),
                      table.point(row, "supine_"), observer};
    if (table.has("landmark")) pair.name = table.cell(row, "landmark");
    if (table.has("observer_mm")) pair.observer = table.number(row, "observer_mm");
    if (!(pair.observer > 0)) {
      throw input_error(table.name, ", landmark '", pair.name, "': observer_mm ", pair.observer,
                        " must be above 0");
    }
    pairs.push_back(pair);
  }
  if (pairs.empty()) {
    throw input_error(table.name, ": no landmark of the ", side_name(side),
                      " breast; at least one is needed, and ten or more to distinguish "
                      "stiffness from support");
  }
  return pairs;
}

std::vector<SeenPoint> seen_points(const HexMesh& mesh, const std::vector<LandmarkPair>& pairs,
                                   double outside, const std::string& where) {
  const Locator body(mesh, mesh.imaged);
  check_names(pairs, where);
  check_frames(pairs, body, outside, where);
  std::vector<SeenPoint> points;
  for (const LandmarkPair& pair : pairs) {
    const Location at = body.nearest(pair.imaged);
    if (at.moved > outside) {
      throw input_error(where, ": landmark '", pair.name, "' lies ", format_fixed(at.moved, 1),
                        " mm outside the body in the scan, more than ", outside,
                        " mm; patient LPS coordinates in mm of the scan are needed");
    }
    const double moved = (pair.second - pair.imaged).norm();
    if (moved > longest_move) {
      throw input_error(where, ": landmark '", pair.name, "' would have moved ",
                        format_fixed(moved, 0), " mm, more than ", longest_move,
                        " mm; both postures must be given in one frame, in which the rib cages "
                        "coincide");
    }
    points.push_back({pair.name, at, pair.second, coordinate_deviation(pair.observer)});
  }
  check_neighbours(pairs, where);
  return points;
}

}  // namespace breast
