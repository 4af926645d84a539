// SPDX-License-Identifier: GPL-3.0-or-later
// Tracing of X-rays through a deformed hexahedral mesh, with exact entry and exit points of every
// element.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "mesh/hex_mesh.hpp"
#include "projection/mammogram.hpp"
#include "projection/patch_hits.hpp"
#include "projection/trilinear.hpp"

namespace breast {

/// The segment of a ray inside one piece of the mesh.
struct Chord {
  int piece = 0;
  double enter = 0, leave = 0;  ///< mm along the ray from its detector point (negative: before it)
  Vec3 local_enter, local_leave;  ///< piece coordinates in [-1,1]^3
  std::int8_t face_enter = -1, face_leave = -1;
};

struct Ray {
  Vec3 origin;     ///< on the detector, patient frame
  Vec3 direction;  ///< unit, from the source to the detector
  Vec3 at(double distance) const { return origin + distance * direction; }
};

/// Chords of neighbouring rays, one list per ray.
using ChordPacket = std::array<std::vector<Chord>, packet_rays>;

/// Elements of order 1 are one piece each; those of order 2 are cut into 4×4×4 trilinear pieces
/// (their faces have no closed-form intersection; the pieces' corners lie on the quadratic map).
/// Neighbouring pieces share their faces, so chords follow each other without gap or overlap.
class RayMesh {
 public:
  /// `pose` defines the rays; `nodal` are the coordinates (mesh.points of a compressed mesh).
  RayMesh(const HexTopology& mesh, const std::vector<Vec3>& nodal, const ViewPose& pose);

  /// The ray that is traced: it ends less than 1e-6 mm beside (u,v), for the reason given in the
  /// .cpp file.
  Ray ray(const Vec2& uv) const;
  /// Chords of the ray to detector position (u,v) in mm, from the paddle to the detector.
  void trace(const Vec2& uv, std::vector<Chord>& chords) const;
  /// The same for the rays to (u + k step, v), k = 0 ... count − 1 (at most packet_rays), together,
  /// which is several times faster. Stops at the border of the table of candidates; returns the
  /// number of rays that were followed (at least one).
  int trace(const Vec2& uv, double step, int count, ChordPacket& chords) const;
  /// Whether a column meets the chest wall or the cut surface and thus continues in tissue outside
  /// the mesh.
  bool leaves_through_back(const std::vector<Chord>& chords) const;

  int element(int piece) const { return piece / pieces_per_element_; }
  /// Converts coordinates of a piece to those of its element.
  Vec3 element_local(int piece, const Vec3& local) const;
  const Trilinear& piece(int p) const { return pieces_[p]; }
  int pieces() const { return int(pieces_.size()); }
  double volume() const;  ///< mm³ of all pieces
  const ViewPose& pose() const { return pose_; }

  /// The same pieces in another nodal field (mesh.imaged), for mapping points along a chord.
  std::vector<Trilinear> pieces_of(const HexTopology& mesh, const std::vector<Vec3>& nodal) const;

 private:
  struct Box {
    Vec2 lower = Vec2::Constant(std::numeric_limits<double>::infinity()), upper = -lower;
  };
  /// A piece's corners in detector axes from the foot of the source: x = X e_u + Y e_v + T n.
  /// The ray to (u,v) is where X − u (1 + T/D) = 0 and Y − v (1 + T/D) = 0, D = source
  /// distance (1/D = 0 for the parallel beam), both linear in the corners: bilinear faces stay
  /// bilinear for either beam.
  struct Corners {
    Eigen::Array<double, 8, 1> x, y, t;
  };
  struct Packet;
  struct Crossings;
  void trace_piece(int p, const Packet& packet, ChordPacket& chords) const;
  void add_chords(int p, const Packet& packet, int ray, const Crossings& crossings,
                  std::vector<Chord>& chords) const;
  void bin_pieces();

  ViewPose pose_;
  int subdivisions_ = 1, pieces_per_element_ = 1;
  std::vector<Trilinear> pieces_;
  std::vector<Corners> corners_;
  std::vector<std::array<Box, 6>> face_boxes_;  ///< of each face, projected
  std::vector<std::uint8_t> back_faces_;        ///< per element, bit f: face f is chest wall or cut
  static constexpr double bin_mm = 2;
  Vec2 bins_lower_{0, 0};
  std::array<int, 2> bins_{0, 0};
  struct Candidate {
    Box box;  ///< of the projected piece, mm on the detector
    int piece;
  };
  std::vector<int> bin_first_;
  std::vector<Candidate> candidates_;  ///< by bin
};

}  // namespace breast
