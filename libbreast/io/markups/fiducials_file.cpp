// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/markups/fiducials_file.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/table.hpp"
#include "core/text/trimmed.hpp"

namespace breast {

namespace {

using Cells = std::vector<std::string>;

/// Cells between commas; one in quotes may contain commas, and quotes that are doubled.
Cells cells_of(const std::string& line) {
  Cells cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back() += line[++i];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  for (std::string& cell : cells) cell = trimmed(cell);
  return cells;
}

struct Header {
  std::optional<bool> ras;
  Cells columns;
};

/// Takes "# CoordinateSystem = LPS" and "# columns = id,x,y,z,...,label,..." from a comment.
void read_comment(const std::string& line, const std::string& name, Header& header) {
  const std::size_t equals = line.find('=');
  if (equals == std::string::npos) return;
  const std::string key = trimmed(line.substr(1, equals - 1)),
                    value = trimmed(line.substr(equals + 1));
  if (key == "columns") header.columns = cells_of(value);
  if (key != "CoordinateSystem") return;
  if (value != "LPS" && value != "1" && value != "RAS" && value != "0") {
    throw input_error(name, ": CoordinateSystem '", value, "': LPS (1) or RAS (0) are read");
  }
  header.ras = value == "RAS" || value == "0";
}

std::size_t column(const Header& header, const char* name, const std::string& file) {
  const auto at = std::find(header.columns.begin(), header.columns.end(), name);
  if (at != header.columns.end()) return std::size_t(at - header.columns.begin());
  throw input_error(file, ": its comments name no column '", name,
                    "' (# columns = id,x,y,z,...,label,...): not a point list of 3D Slicer");
}

MarkupPoint point_of(const Cells& cells, const Header& header, const std::string& file,
                     const std::string& where) {
  constexpr double farthest_mm = 1e6;
  const auto cell = [&](const char* name) {
    const std::size_t at = column(header, name, file);
    if (at < cells.size()) return cells[at];
    throw input_error(where, ": has ", cells.size(), " cells, but '", name, "' is column ", at + 1);
  };
  if (!header.ras) {
    throw input_error(file,
                      ": states no CoordinateSystem, so left and right are unknown: save it "
                      "again with 3D Slicer (# CoordinateSystem = LPS)");
  }
  Vec3 at;
  int d = 0;
  for (const char* axis : {"x", "y", "z"}) at[d++] = parse_number(cell(axis), where);
  if (!(at.cwiseAbs().maxCoeff() <= farthest_mm)) {
    throw input_error(where, ": position is not three numbers of mm");
  }
  if (*header.ras) at = Vec3(-at[0], -at[1], at[2]);
  return {cell("label"), at};
}

}  // namespace

std::vector<MarkupPoint> read_fiducials(const std::filesystem::path& file) {
  constexpr std::uintmax_t most_bytes = 16 << 20;
  std::istringstream in(read_text(file, most_bytes));
  Header header;
  std::vector<MarkupPoint> points;
  std::size_t number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (trimmed(line).empty()) continue;
    if (line.starts_with('#')) {
      read_comment(line, file.string(), header);
      continue;
    }
    points.push_back(point_of(cells_of(line), header, file.string(),
                              file.string() + ", line " + std::to_string(number)));
  }
  return points;
}

}  // namespace breast
