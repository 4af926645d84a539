// SPDX-License-Identifier: GPL-3.0-or-later
#include "projection/ray_mesh.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "mesh/shape.hpp"

namespace breast {

RayMesh::RayMesh(const HexTopology& mesh, const std::vector<Vec3>& nodal, const ViewPose& pose)
    : pose_(pose),
      subdivisions_(mesh.order == 1 ? 1 : 4),
      pieces_per_element_(subdivisions_ * subdivisions_ * subdivisions_) {
  pieces_ = pieces_of(mesh, nodal);
  corners_.resize(pieces_.size());
  const Vec3 foot = pose_.on_detector({0, pose_.source_v});
  for (std::size_t p = 0; p < pieces_.size(); ++p) {
    for (int a = 0; a < 8; ++a) {
      const Vec3 d = pieces_[p].at(Trilinear::corner(a)) - foot;
      corners_[p].x[a] = d.dot(pose_.e_u);
      corners_[p].y[a] = d.dot(pose_.e_v);
      corners_[p].t[a] = d.dot(pose_.n);
    }
  }
  back_faces_.assign(std::size_t(mesh.elements()), 0);
  for (const auto* set : {&mesh.pectoral_faces, &mesh.cut_faces}) {
    for (const Face& face : *set) {
      back_faces_[face.element] = std::uint8_t(back_faces_[face.element] | (1u << face.local));
    }
  }
  bin_pieces();
}

std::vector<Trilinear> RayMesh::pieces_of(const HexTopology& mesh,
                                          const std::vector<Vec3>& nodal) const {
  std::vector<Trilinear> pieces(std::size_t(mesh.elements()) * pieces_per_element_);
#pragma omp parallel for schedule(static)
  for (int e = 0; e < mesh.elements(); ++e) {
    for (int k = 0; k < pieces_per_element_; ++k) {
      const int p = e * pieces_per_element_ + k;
      std::array<Vec3, 8> corners;
      for (int a = 0; a < 8; ++a) {
        corners[a] = mesh.order == 1
                         ? nodal[mesh.element(e)[a]]
                         : element_position(mesh, nodal, e, element_local(p, Trilinear::corner(a)));
      }
      pieces[p] = Trilinear::through(corners);
    }
  }
  return pieces;
}

Vec3 RayMesh::element_local(int piece, const Vec3& local) const {
  const int n = subdivisions_, k = piece % pieces_per_element_;
  const Vec3 cell(k % n, (k / n) % n, k / (n * n));
  return (2 * cell + Vec3::Ones() + local) / n - Vec3::Ones();
}

void RayMesh::bin_pieces() {
  std::vector<Box> boxes(pieces_.size());
  face_boxes_.resize(pieces_.size());
  Vec2 lower = Vec2::Constant(std::numeric_limits<double>::infinity()), upper = -lower;
  const double per_distance = pose_.source_distance > 0 ? 1 / pose_.source_distance : 0;
  for (std::size_t p = 0; p < boxes.size(); ++p) {
    const Eigen::Array<double, 8, 1> magnified = 1 / (1 + per_distance * corners_[p].t);
    const Eigen::Array<double, 8, 1> u = corners_[p].x * magnified, v = corners_[p].y * magnified;
    for (int f = 0; f < 6; ++f) {
      Box& box = face_boxes_[p][f];
      for (const int a : hex_face_corners[f]) {
        const Vec2 corner(u[a], v[a] + pose_.source_v);
        box.lower = box.lower.cwiseMin(corner);
        box.upper = box.upper.cwiseMax(corner);
      }
      boxes[p].lower = boxes[p].lower.cwiseMin(box.lower);
      boxes[p].upper = boxes[p].upper.cwiseMax(box.upper);
    }
    lower = lower.cwiseMin(boxes[p].lower);
    upper = upper.cwiseMax(boxes[p].upper);
  }
  if (!((upper - lower).minCoeff() >= 0) || !((upper - lower).maxCoeff() < 1e4)) {
    throw input_error("mesh: its projection spans ", (upper - lower).maxCoeff(),
                      " mm, but less than 10000 are expected (units are mm)");
  }
  bins_lower_ = lower;
  for (int k = 0; k < 2; ++k) bins_[k] = 1 + int((upper - lower)[k] / bin_mm);
  const auto for_bins = [&](const Box& box, const auto& visit) {
    const auto index = [&](double x, int k) {
      return std::clamp(int((x - lower[k]) / bin_mm), 0, bins_[k] - 1);
    };
    for (int j = index(box.lower.y(), 1); j <= index(box.upper.y(), 1); ++j) {
      for (int i = index(box.lower.x(), 0); i <= index(box.upper.x(), 0); ++i) {
        visit(j * bins_[0] + i);
      }
    }
  };
  bin_first_.assign(std::size_t(bins_[0]) * bins_[1] + 1, 0);
  for (const Box& box : boxes) for_bins(box, [&](int bin) { ++bin_first_[bin + 1]; });
  for (std::size_t b = 1; b < bin_first_.size(); ++b) bin_first_[b] += bin_first_[b - 1];
  candidates_.resize(std::size_t(bin_first_.back()));
  std::vector<int> next(bin_first_.begin(), bin_first_.end() - 1);
  for (std::size_t p = 0; p < boxes.size(); ++p) {
    for_bins(boxes[p], [&](int bin) { candidates_[next[bin]++] = {boxes[p], int(p)}; });
  }
}

bool RayMesh::leaves_through_back(const std::vector<Chord>& chords) const {
  const int n = subdivisions_;
  const auto on_back = [&](int piece, int face) {
    if ((back_faces_[element(piece)] >> face & 1u) == 0) return false;
    if (n == 1) return true;
    const int k = piece % pieces_per_element_;
    const int cell[3] = {k % n, (k / n) % n, k / (n * n)};
    return cell[face / 2] == (face % 2 == 0 ? 0 : n - 1);
  };
  return std::any_of(chords.begin(), chords.end(), [&](const Chord& chord) {
    return on_back(chord.piece, chord.face_enter) || on_back(chord.piece, chord.face_leave);
  });
}

double RayMesh::volume() const {
  double sum = 0;
  for (const Trilinear& piece : pieces_) sum += piece.volume();
  return sum;
}

}  // namespace breast
