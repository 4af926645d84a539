// SPDX-License-Identifier: GPL-3.0-or-later
// Reading and writing of points and curves of 3D Slicer (.mrk.json, Markups schema 1.0); reading of its
// point lists before 4.11 (.fcsv).
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "core/types.hpp"

namespace breast {

struct MarkupPoint {
  std::string label;
  Vec3 at{0, 0, 0};  ///< mm, LPS
};

/// A point list, or a curve through its points.
struct Markups {
  std::string name;
  bool curve = false;
  std::array<double, 3> colour{1, 0.5, 0.5};
  std::vector<MarkupPoint> points;
};

/// True for .mrk.json and .fcsv, in any case.
bool is_markups_name(const std::filesystem::path& file);

/// All points of all lists of the file that have a position, converted to LPS if the file states
/// RAS (LPS is the default of .mrk.json, as in the schema; .fcsv must state it). Throws Error (input) for another format, coordinates
/// that are not three finite mm, and a file without points.
std::vector<MarkupPoint> read_markups(const std::filesystem::path& file);

/// Writes locked points in LPS, atomically.
void write_markups(const std::filesystem::path& file, const Markups& markups);

/// The point labelled `label` (ignoring case), or the only point. Otherwise throws Error (input)
/// beginning with `name` and listing the existing labels.
MarkupPoint point_named(const std::vector<MarkupPoint>& points, const std::string& label,
                        const std::string& name);

}  // namespace breast
