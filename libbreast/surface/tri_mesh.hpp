// SPDX-License-Identifier: GPL-3.0-or-later
// Triangle surface and point sets with named scalars.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "core/provenance.hpp"
#include "core/types.hpp"

namespace breast {

struct TriMesh {
  std::vector<Vec3> points;                   ///< mm, LPS
  std::vector<std::array<int, 3>> triangles;  ///< may be empty: a point set
  std::vector<Vec3> normals;                  ///< per point, may be empty
  std::map<std::string, std::vector<double>> point_data;
  History history;             ///< empty for a file of another program
  std::string content_sha256;  ///< filled by the reader
};

/// One or more polylines with named scalars per point (curve.vtp). A line with one point is a
/// marker; files contain markers before lines.
struct PolyLines {
  std::vector<Vec3> points;
  std::vector<std::vector<int>> lines;
  std::vector<std::string> line_names;  ///< per line, may be empty
  std::map<std::string, std::vector<double>> point_data;
  std::map<std::string, std::vector<Vec3>> point_vectors;
  History history;
  std::string content_sha256;  ///< filled by the reader
};

}  // namespace breast
