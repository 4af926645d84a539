#include "mammo/ray_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "mesh/shape.hpp"

namespace breast {

namespace {

constexpr double bin_mm = 2.0;
// Rays pass this far beside the position asked for, so that none runs inside a face of a mesh that
// is aligned with the pixels (the paper's cuboid in CC is).
const Vec2 aside(3.7e-7, 7.3e-7);

// Corner signs of the hexahedron in VTK order.
constexpr int corner_sign[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                   {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};

Vec3 corner_local(int corner) {
  return {double(corner_sign[corner][0]), double(corner_sign[corner][1]),
          double(corner_sign[corner][2])};
}

// Bit a: corner a lies on the positive side.
unsigned above(const Eigen::Array<double, 8, 1>& x) {
  unsigned mask = 0;
  for (int a = 0; a < 8; ++a) mask |= unsigned(x[a] > 0) << a;
  return mask;
}

// Local coordinates of a point of face f at patch coordinates (s,r).
Vec3 face_local(int f, const PatchHit& hit) {
  const auto& corners = hex_face_corners[f];
  const Vec3 p0 = corner_local(corners[0]), p1 = corner_local(corners[1]),
             p3 = corner_local(corners[3]);
  return p0 + hit.s * (p1 - p0) + hit.r * (p3 - p0);
}

}  // namespace

RayMesh::RayMesh(const HexMesh& mesh, const std::vector<Vec3>& nodal, const ViewPose& pose)
    : pose_(pose),
      subdivisions_(mesh.order == 1 ? 1 : 4),
      pieces_per_element_(subdivisions_ * subdivisions_ * subdivisions_) {
  pieces_ = pieces_of(mesh, nodal);
  corners_.resize(pieces_.size());
  const Vec3 foot = pose_.on_detector({0, pose_.source_v});
  for (std::size_t p = 0; p < pieces_.size(); ++p) {
    for (int a = 0; a < 8; ++a) {
      const Vec3 d = pieces_[p].at(corner_local(a)) - foot;
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

std::vector<Trilinear> RayMesh::pieces_of(const HexMesh& mesh,
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
                         : element_position(mesh, nodal, e, element_local(p, corner_local(a)));
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
  Vec2 lower = Vec2::Constant(std::numeric_limits<double>::infinity()), upper = -lower;
  const double per_distance = pose_.source_distance > 0 ? 1 / pose_.source_distance : 0;
  for (std::size_t p = 0; p < boxes.size(); ++p) {
    const Eigen::Array<double, 8, 1> magnified = 1 / (1 + per_distance * corners_[p].t);
    const Eigen::Array<double, 8, 1> u = corners_[p].x * magnified, v = corners_[p].y * magnified;
    boxes[p].lower = Vec2(u.minCoeff(), v.minCoeff() + pose_.source_v);
    boxes[p].upper = Vec2(u.maxCoeff(), v.maxCoeff() + pose_.source_v);
    lower = lower.cwiseMin(boxes[p].lower);
    upper = upper.cwiseMax(boxes[p].upper);
  }
  if (!((upper - lower).minCoeff() >= 0) || !((upper - lower).maxCoeff() < 1e4)) {
    throw input_error("mesh: its projection spans ", (upper - lower).maxCoeff(),
                      " mm, less than 10000 expected (units are mm)");
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

Ray RayMesh::ray(const Vec2& uv) const {
  Ray ray{pose_.on_detector(uv + aside), pose_.n};
  if (pose_.source_distance > 0) ray.direction = (ray.origin - pose_.source()).normalized();
  return ray;
}

RayMesh::Target RayMesh::target(const Vec2& position) const {
  Target target;
  target.ray = ray(position);
  target.foot = position + aside - Vec2(0, pose_.source_v);
  target.slope = Vec2::Zero();
  target.stretch = 1;
  if (pose_.source_distance > 0) {
    target.slope = target.foot / pose_.source_distance;
    target.stretch = std::sqrt(1 + target.slope.squaredNorm());
  }
  return target;
}

void RayMesh::trace(const Vec2& position, std::vector<Chord>& chords) const {
  chords.clear();
  const Vec2 uv = position + aside;
  const Vec2 cell = (uv - bins_lower_) / bin_mm;
  if (!(cell.minCoeff() >= 0) || cell.x() >= bins_[0] || cell.y() >= bins_[1]) return;
  const int bin = int(cell.y()) * bins_[0] + int(cell.x());
  const Target target = this->target(position);
  for (int k = bin_first_[bin]; k < bin_first_[bin + 1]; ++k) {
    const Box& box = candidates_[k].box;
    if (uv.x() < box.lower.x() || uv.x() > box.upper.x() || uv.y() < box.lower.y() ||
        uv.y() > box.upper.y()) {
      continue;
    }
    trace_piece(candidates_[k].piece, target, chords);
  }
  std::sort(chords.begin(), chords.end(), [](const Chord& x, const Chord& y) {
    return x.enter != y.enter ? x.enter < y.enter : x.piece < y.piece;
  });
}

void RayMesh::trace_piece(int p, const Target& target, std::vector<Chord>& chords) const {
  const Corners& corners = corners_[p];
  const Eigen::Array<double, 8, 1> x = corners.x - target.foot.x() - target.slope.x() * corners.t;
  const Eigen::Array<double, 8, 1> y = corners.y - target.foot.y() - target.slope.y() * corners.t;
  struct Crossing {
    double distance;
    Vec3 local;
    std::int8_t face;
  };
  std::array<Crossing, 12> crossings;
  int n = 0;
  const std::array<unsigned, 4> sides = {above(x), above(-x), above(y), above(-y)};
  for (int f = 0; f < 6; ++f) {
    const auto& q = hex_face_corners[f];
    const unsigned face = 1u << q[0] | 1u << q[1] | 1u << q[2] | 1u << q[3];
    if (std::any_of(sides.begin(), sides.end(),
                    [face](unsigned side) { return (side & face) == face; })) {
      continue;  // wholly on one side of the ray
    }
    std::array<PatchHit, 2> hits;
    const int found = patch_hits(
        {Vec2(x[q[0]], y[q[0]]), {x[q[1]], y[q[1]]}, {x[q[2]], y[q[2]]}, {x[q[3]], y[q[3]]}}, hits);
    for (int h = 0; h < found; ++h) {
      const double s = hits[h].s, r = hits[h].r;
      const double distance =
          target.stretch * ((1 - s) * (1 - r) * corners.t[q[0]] + s * (1 - r) * corners.t[q[1]] +
                            s * r * corners.t[q[2]] + (1 - s) * r * corners.t[q[3]]);
      int place = n++;  // kept in order of distance
      for (; place > 0 && crossings[place - 1].distance > distance; --place) {
        crossings[place] = crossings[place - 1];
      }
      crossings[place] = {distance, face_local(f, hits[h]), std::int8_t(f)};
    }
  }
  constexpr double shortest = 1e-9;  // mm: a ray touching an edge
  for (int k = 0; k + 1 < n; ++k) {
    const Crossing &in = crossings[k], &out = crossings[k + 1];
    if (!(out.distance - in.distance > shortest)) continue;
    if (n > 2) {  // curved faces: the line may leave and come back
      Vec3 middle = 0.5 * (in.local + out.local);
      const bool solved =
          pieces_[p].invert(target.ray.at(0.5 * (in.distance + out.distance)), 1e-9, middle);
      if (!solved || !(middle.cwiseAbs().maxCoeff() <= 1 + 1e-9)) continue;
    }
    chords.push_back({p, in.distance, out.distance, in.local, out.local, in.face, out.face});
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
