// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/tumour.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "core/error.hpp"
#include "core/table.hpp"
#include "core/text/place.hpp"
#include "mesh/landmark_names.hpp"
#include "mesh/locate.hpp"
#include "meshing/tissue.hpp"

namespace breast {

namespace {

constexpr double clearance_mm = 8;  // distance from labels other than breast
constexpr double mesh_clearance_mm = 5,
                 least_clearance_mm = 2;  // distances from the boundary of the mesh

struct Region {
  long long voxels = 0;
  Vec3 centroid{0, 0, 0};
  double rms_radius = 0;
};

template <class Use>
void for_voxels(const LabelVolume& labels, Tissue tissue, const Use& use) {
  const Grid& grid = labels.grid;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        if (labels.at(i, j, k) == tissue) use(i, j, k);
      }
    }
  }
}

Region region_of(const LabelVolume& labels, Tissue tissue) {
  Region region;
  double squares = 0;
  for_voxels(labels, tissue, [&](int i, int j, int k) {
    const Vec3 at = labels.grid.to_patient(Vec3(i, j, k));
    ++region.voxels;
    region.centroid += at;
    squares += at.squaredNorm();
  });
  if (region.voxels == 0) return region;
  region.centroid /= double(region.voxels);
  region.rms_radius =
      std::sqrt(std::max(0.0, squares / double(region.voxels) - region.centroid.squaredNorm()));
  return region;
}

bool breast_or_beyond(const LabelVolume& labels, int i, int j, int k) {
  return !labels.grid.contains(i, j, k) || is_breast(labels.at(i, j, k));
}

// Whether there is breast in all 26 directions at the clearance.
bool is_clear(const LabelVolume& labels, int i, int j, int k) {
  const Vec3 reach = clearance_mm * labels.grid.spacing.cwiseInverse();
  for (int d = 0; d < 27; ++d) {
    Vec3 way(d % 3 - 1, (d / 3) % 3 - 1, d / 9 - 1);
    if (d == 13) continue;
    way = way.normalized().cwiseProduct(reach);
    if (!breast_or_beyond(labels, i + int(std::lround(way.x())), j + int(std::lround(way.y())),
                          k + int(std::lround(way.z())))) {
      return false;
    }
  }
  return true;
}

// Whether the point and 26 others at this distance around it lie inside the mesh.
bool is_inside(const Locator& mesh, const Vec3& at, double clearance) {
  int hint = -1;
  for (int d = 0; d < 27; ++d) {
    const Vec3 way(d % 3 - 1, (d / 3) % 3 - 1, d / 9 - 1);
    const auto found = mesh.find(d == 13 ? at : Vec3(at + clearance * way.normalized()), hint);
    if (!found) return false;
    hint = found->element;
  }
  return true;
}

// Finds a fat neighbour: the point half-way to it lies on the edge of the fibroglandular tissue.
std::optional<Vec3> edge_point(const LabelVolume& labels, int i, int j, int k) {
  constexpr std::array<std::array<int, 3>, 6> steps = {
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
  for (const auto& d : steps) {
    const int a = i + d[0], b = j + d[1], c = k + d[2];
    if (!labels.grid.contains(a, b, c) || labels.at(a, b, c) != Tissue::fat) continue;
    return labels.grid.to_patient(Vec3(i, j, k) + 0.5 * Vec3(d[0], d[1], d[2]));
  }
  return std::nullopt;
}

// A candidate position for an artificial tumour.
struct Candidate {
  double distance;  // squared distance from the wanted position, mm²
  Vec3 at;
  bool clear;  // whether it is clear of labels other than breast
};

}  // namespace

std::optional<Tumour> automatic_tumour(const LabelVolume& labels, const HexMesh& mesh) {
  if (const auto named = labels.landmarks.find("tumour"); named != labels.landmarks.end()) {
    return Tumour{named->second, 0, "landmark of the labels", false};
  }
  const Region marked = region_of(labels, Tissue::tumour);
  if (marked.voxels > 0) return Tumour{marked.centroid, 0, "centroid of tumour voxels", false};
  const Region gland = region_of(labels, Tissue::fibroglandular);
  if (gland.voxels == 0) return std::nullopt;
  const Vec3 upper_outer = Vec3(lateral_sign(labels.side), 0, 1).normalized();
  const Vec3 target = gland.centroid + 0.7 * gland.rms_radius * upper_outer;
  std::vector<Candidate> candidates;
  for_voxels(labels, Tissue::fibroglandular, [&](int i, int j, int k) {
    if (const auto edge = edge_point(labels, i, j, k))
      candidates.push_back({(*edge - target).squaredNorm(), *edge, is_clear(labels, i, j, k)});
  });
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.distance < b.distance; });
  const Locator locator(mesh, mesh.imaged);
  const auto first = [&](bool clear, double clearance) {
    return std::find_if(candidates.begin(), candidates.end(), [&](const Candidate& c) {
      return (c.clear || !clear) && is_inside(locator, c.at, clearance);
    });
  };
  auto chosen = first(true, mesh_clearance_mm);
  if (chosen == candidates.end()) chosen = first(false, mesh_clearance_mm);
  if (chosen == candidates.end()) chosen = first(false, least_clearance_mm);
  if (chosen == candidates.end()) return std::nullopt;
  return Tumour{chosen->at, 0, "artificial, on the edge of the fibroglandular region", true};
}

Tumour tumour_of(const LabelVolume& labels, const std::string& name) {
  const Region region = region_of(labels, Tissue::tumour);
  if (region.voxels == 0) {
    throw input_error(
        "--tumour ", name,
        ": has no tumour voxels (value 5), and is no mask (one value besides 0) either");
  }
  const double volume = double(region.voxels) * labels.grid.voxel_volume();
  return {region.centroid, std::cbrt(3 * volume / (4 * std::numbers::pi)),
          "tumour voxels of " + name, false};
}

Tumour read_tumour(const std::filesystem::path& file) {
  const Table table = read_table(file);
  const std::string name = file.filename().string();
  if (table.rows.empty()) throw input_error("--tumour ", name, ": the table has no row");
  Tumour tumour{table.point(0, ""), 0, "first row of " + name, false};
  if (table.has("radius_mm")) {
    tumour.radius = table.number(0, "radius_mm");
    check_place_radius(tumour.radius, "--tumour " + name);
  }
  return tumour;
}

Tumour parse_tumour(const std::string& text) {
  const Place place = parse_place(text, "--tumour");
  return {place.centre, place.radius.value_or(0), "given", false};
}

void add_nipple(HexMesh& mesh) {
  if (!mesh.geometry) throw failed_error("nipple: the mesh has no geometry");
  const Vec3 at = mesh.geometry->nipple;
  const Location found = nearest_on_faces(mesh, mesh.imaged, mesh.skin_faces, at);
  mesh.landmarks.push_back({"nipple", at, found.element, found.local, found.moved});
  mesh.nipple_node = nearest_node(mesh.imaged, at);
}

void add_landmark(const std::string& name, const Vec3& at, HexMesh& mesh, double max_moved) {
  const Location found = Locator(mesh, mesh.imaged).nearest(at);
  if (!(found.moved <= max_moved)) {
    throw input_error(name, " at (", at.x(), ", ", at.y(), ", ", at.z(), ") mm lies ", found.moved,
                      " mm outside the mesh; at most ", max_moved,
                      ": check the side and that the point is in patient LPS mm");
  }
  mesh.landmarks.push_back({name, at, found.element, found.local, found.moved});
}

void add_tumour(const Tumour& tumour, HexMesh& mesh, double max_moved) {
  const Locator locator(mesh, mesh.imaged);
  const std::string name = tumour.artificial ? std::string(artificial_tumour) : "tumour";
  add_landmark(name, tumour.centre, mesh, max_moved);
  mesh.tumour_node = nearest_node(mesh.imaged, tumour.centre);
  if (!(tumour.radius > 0)) return;
  for (int e = 0; e < mesh.elements(); ++e) {
    int inside = 0;
    for (int s = 0; s < 27; ++s) {
      const Vec3 local = Vec3(s % 3 - 1, (s / 3) % 3 - 1, s / 9 - 1) * (2.0 / 3);
      inside += (locator.position(e, local) - tumour.centre).norm() < tumour.radius;
    }
    if (inside >= 14 || e == mesh.landmarks.back().element) mesh.tissue[e] = Tissue::tumour;
  }
}

}  // namespace breast
