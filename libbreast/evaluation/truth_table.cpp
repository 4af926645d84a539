// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluation/truth_table.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.hpp"
#include "evaluation/landmark_truth.hpp"

namespace breast {

namespace {

// Fine and coarse mesh of one posture.
struct Pair {
  const HexMesh* fine = nullptr;
  const HexMesh* coarse = nullptr;
};

std::map<std::string, Pair> pairs_by_posture(const std::vector<HexMesh>& meshes) {
  int most = 0;
  for (const HexMesh& mesh : meshes) most = std::max(most, mesh.elements());
  std::map<std::string, Pair> pairs;
  for (const HexMesh& mesh : meshes) {
    const std::string posture = posture_of(mesh);
    if (posture.empty()) throw input_error("a mesh is in none of the postures of a truth table");
    if (mesh.side != meshes.front().side) throw input_error("the meshes are of different sides");
    Pair& pair = pairs[posture];
    const HexMesh*& slot = mesh.elements() == most ? pair.fine : pair.coarse;
    if (slot != nullptr)
      throw input_error("two meshes of the same size are in the posture ", posture);
    slot = &mesh;
  }
  for (const auto& [posture, pair] : pairs) {
    if (pair.fine == nullptr || pair.coarse == nullptr) {
      throw input_error("posture ", posture, " needs a fine and a coarse mesh");
    }
    if (!pair.fine->contact) continue;
    const double gap = pair.fine->contact->thickness_mm - pair.coarse->contact->thickness_mm;
    if (!(std::abs(gap) < 0.01)) {
      throw input_error(posture, ": the plates of the two meshes are ", std::abs(gap),
                        " mm apart in thickness; compress both to one --thickness");
    }
  }
  return pairs;
}

Vec3 place(const HexMesh& mesh, const std::string& name) {
  const Landmark* landmark = mesh.landmark(name);
  if (landmark == nullptr) throw input_error("a mesh has no landmark '", name, "'");
  return landmark_position(mesh, mesh.points, *landmark);
}

}  // namespace

Table truth_table(const Table& imaged, const std::vector<HexMesh>& meshes) {
  const std::map<std::string, Pair> pairs = pairs_by_posture(meshes);
  const Side side = meshes.front().side;
  const auto landmarks = true_landmarks(imaged, side, imaged.name);
  Table table;
  table.columns = {"landmark", "side"};
  std::vector<std::string> postures{"prone"};
  for (const char* posture : {"stress_free", "supine"})
    if (landmarks.front().at.count(posture) > 0) postures.push_back(posture);
  for (const auto& [posture, pair] : pairs)
    if (landmarks.front().at.count(posture) == 0) postures.push_back(posture);
  for (const std::string& posture : postures) {
    for (const char* what : {"_x_mm", "_y_mm", "_z_mm"}) table.columns.push_back(posture + what);
    if (pairs.count(posture) > 0) table.columns.push_back(posture + "_own_error_mm");
  }
  for (const TrueLandmark& point : landmarks) {
    std::vector<std::string> row{point.name, std::string(side_name(side))};
    for (const std::string& posture : postures) {
      const auto pair = pairs.find(posture);
      const bool solved = pair != pairs.end();
      const Vec3 fine = solved ? place(*pair->second.fine, point.name) : Vec3(Vec3::Zero());
      // The image shows the phantom's own prone shape, in which a chain sees the point.
      const bool keep = !solved || posture == "prone";
      const Vec3 shown = keep ? point.at.at(posture).x : fine;
      for (int d = 0; d < 3; ++d) row.push_back(format_fixed(shown[d], 6));
      if (!solved) continue;
      const double levels = (fine - place(*pair->second.coarse, point.name)).norm();
      row.push_back(format_fixed(std::max(levels, (fine - shown).norm()), 6));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace breast
