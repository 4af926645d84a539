// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/match_question.hpp"

#include "core/error.hpp"
#include "core/table.hpp"

namespace breast {

void MatchQuestion::check() const {
  const int questions = int(!point.empty()) + int(!pair.empty()) + int(!landmark.empty()) +
                        int(grid > 0) + int(!points.empty()) + int(!truth.empty());
  if (questions == 1) return;
  throw input_error(
      "give exactly one of --point u,v, --pair u,v,u,v, --landmark NAME, --points FILE, --truth "
      "FILE and --grid N");
}

std::vector<MatchQuery> MatchQuestion::queries(const Matcher& matcher, const PatientViews* patient,
                                               int& behind) const {
  behind = 0;
  if (grid > 0) return grid_queries(matcher, grid);
  if (!truth.empty()) return truth_queries(matcher, read_table(truth), truth.string(), behind);
  const auto first = [&](const Vec2& at) { return patient ? patient->from().uv(at) : at; };
  const auto second = [&](const Vec2& at) { return patient ? patient->to().uv(at) : at; };
  if (!points.empty()) {
    return point_queries(read_table(points), points.string(),
                         patient ? std::function<Vec2(const Vec2&)>(first) : nullptr);
  }
  const std::vector<double>& mark = pair.empty() ? point : pair;
  if (mark.empty()) return {landmark_query(matcher, landmark)};
  MatchQuery query{first({mark[0], mark[1]}), "", std::nullopt, PlaceOrigin::mark};
  if (mark.size() == 4) query.place = second({mark[2], mark[3]});
  return {query};
}

}  // namespace breast
