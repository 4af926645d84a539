// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/experiments/coverage.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

#include "core/error.hpp"
#include "core/text/lists.hpp"
#include "study/cells.hpp"

namespace breast {

namespace {
// Half-widths of the 50 and 95 % bands of a normal distribution, in standard deviations; z is
// rounded as for the intervals.
constexpr double half_50 = 0.6744897502, half_95 = 1.9599639845, z = 1.96;
}  // namespace

Share coverage(const std::vector<int>& held, const std::vector<int>& places) {
  const double n = std::accumulate(places.begin(), places.end(), 0.0),
               solved = double(places.size());
  if (!(n > 0)) return {};
  const double p = std::accumulate(held.begin(), held.end(), 0.0) / n;
  double mean = p, half = 0;
  if (places.size() == 1) {
    half = z * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n)) / (1 + z * z / n);
    mean = (p + z * z / (2 * n)) / (1 + z * z / n);
  } else {
    double scatter = 0;
    for (std::size_t k = 0; k < places.size(); ++k) scatter += std::pow(held[k] - p * places[k], 2);
    half = z * std::sqrt(scatter * solved / (solved - 1)) / n;
  }
  return {100 * p, std::max(0.0, 100 * (mean - half)), std::min(100.0, 100 * (mean + half))};
}

double quantile(std::vector<double> values, double part) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const auto order = std::size_t(part * double(values.size()) + 0.5);
  return values[std::clamp<std::size_t>(order, 1, values.size()) - 1];
}

BandRows read_band_rows(const std::string& text, const std::string& name) {
  BandRows rows{name, {}, 0};
  std::istringstream in(text);
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.starts_with("# sample")) ++rows.failed;
    if (line.empty() || line.front() == '#') continue;
    const std::vector<std::string> cells = split(line, '\t');
    if (cells.size() < 4)
      throw input_error(name, ": line ", number, " has ", cells.size(),
                        " columns, not sample, place, distance, deviation");
    const std::string where = message(name, ", line ", number);
    rows.places.push_back({cells[0], parse_number(cells[2], where), parse_number(cells[3], where)});
  }
  if (rows.places.empty()) throw input_error(name, ": contains no places");
  return rows;
}

namespace {

Row coverage_row(const BandRows& rows) {
  std::map<std::string, std::size_t> order;
  std::vector<int> places, narrow, wide;
  std::vector<double> ratios;
  double square = 0, linear = 0;
  for (const BandPlace& place : rows.places) {
    const auto [found, fresh] = order.try_emplace(place.sample, places.size());
    if (fresh) places.push_back(0), narrow.push_back(0), wide.push_back(0);
    const double distance = std::abs(place.distance);
    ++places[found->second];
    narrow[found->second] += distance <= half_50 * place.deviation ? 1 : 0;
    wide[found->second] += distance <= half_95 * place.deviation ? 1 : 0;
    ratios.push_back(distance / place.deviation);
    square += distance * distance, linear += place.deviation * place.deviation;
  }
  const double n = double(rows.places.size());
  Row row{rows.name, std::to_string(places.size()), std::to_string(rows.failed),
          std::to_string(rows.places.size())};
  for (const Share& share : {coverage(narrow, places), coverage(wide, places)})
    row.insert(row.end(), {format_fixed(share.percent, 1), format_fixed(share.from, 1),
                           format_fixed(share.to, 1)});
  row.insert(row.end(),
             {format_fixed(std::sqrt(square / n), 2), format_fixed(std::sqrt(linear / n), 2),
              format_fixed(quantile(ratios, 0.5) / half_50, 2),
              format_fixed(quantile(ratios, 0.95) / half_95, 2)});
  return row;
}

}  // namespace

Table coverage_table(const std::vector<BandRows>& files) {
  Table table{{"rows", "samples", "failed", "places", "in_50_percent", "in_50_from", "in_50_to",
               "in_95_percent", "in_95_from", "in_95_to", "rms_mm", "band_rms_mm", "half_50_ratio",
               "half_95_ratio"},
              {}};
  for (const BandRows& file : files) table.rows.push_back(coverage_row(file));
  return table;
}

}  // namespace breast
