// SPDX-License-Identifier: GPL-3.0-or-later
// The plates' pressure on the faces of a body as a term. It grows steeply with the depth of a point
// in the plate and is integrated over every face, with many points where the plate is rounded. A
// condition at the nodes alone lets faces penetrate an edge between nodes, and a node that carries
// a whole force slips off an edge over which a face can roll.
//
// Per area of the imaged faces the energy is ψ(s) with s = −gap, and ψ' is the pressure: ρ s²/(2δ) to
// a depth of δ, ρ (s − δ/2) beyond, so that the tangent is continuous. ρ approximates rigid plates:
// the solver increases it until no point lies deeper than allowed.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "contact/plates.hpp"
#include "mesh/hex_mesh.hpp"
#include "mesh/shape.hpp"
#include "solve/discretisation.hpp"
#include "solve/term.hpp"

namespace breast {

class SurfacePressure final : public Term {
 public:
  /// `space` is that of the underlying solid.
  SurfacePressure(const HexMesh& mesh, const std::vector<Face>& faces, const Discretisation& space);
  ~SurfacePressure() override;
  SurfacePressure(const SurfacePressure&) = delete;
  SurfacePressure& operator=(const SurfacePressure&) = delete;

  void set_plates(const PlatePair& plates) { plates_ = plates; }
  const PlatePair& plates() const { return plates_; }
  /// ρ, Pa/mm.
  void set_stiffness(double stiffness) { stiffness_ = stiffness; }
  double stiffness() const { return stiffness_; }
  /// Chooses the quadrature points of every face for plates and positions near these; until the
  /// next call the forces are a smooth function of the positions. Returns true if the points
  /// changed. `keep_finer`: no face gets fewer points than it has, so that repeated choices end.
  bool choose_points(const Eigen::VectorXd& x, bool keep_finer = false);
  /// Per face, the number of its set of points: 0 is the coarsest.
  const std::vector<int>& face_rules() const { return chosen_; }
  /// Uses these sets; returns false if they are not of these faces.
  bool set_face_rules(const std::vector<int>& rules);
  /// In the tangent, the rotation of the forces on a rounded edge is taken as if no point lay
  /// deeper than this, mm: far from a solution the depth does not determine the force.
  void set_turning_depth(double depth) { turning_depth_ = depth; }

  std::string name() const override { return "plates on faces"; }
  bool add(const State& state, const Request& request, Forces& forces) const override;
  std::vector<int> nodes() const override;

  /// Forces of one plate on the nodes (µN, 3 per node).
  Eigen::VectorXd plate_forces(const Eigen::VectorXd& x, int plate) const;
  /// Change of the forces of one plate (−1: of both) on the nodes while the plates move, µN per
  /// unit: `slope` gives the motion of the plates and `moved` (3 per node) that of the body, null
  /// for none.
  Eigen::VectorXd change_of_forces(
      const Eigen::VectorXd& x, int plate, const Eigen::VectorXd* moved,
      const std::function<GapSlope(int plate, const Gap&, const Vec3&)>& slope) const;
  /// All points under pressure, face by face.
  std::vector<PressedPoint> pressed(const Eigen::VectorXd& x) const;
  /// The greatest depth of any quadrature point in a plate, mm; 0 without contact.
  double deepest(const Eigen::VectorXd& x) const;

 private:
  struct Rule;
  struct FaceResult;
  struct Touch;
  template <typename Visit>
  void visit(int face, const Eigen::VectorXd& x, Visit&& each) const;
  int rule_for(int face, const Eigen::VectorXd& x) const;
  FaceResult face_result(int face, const Eigen::VectorXd& x, bool tangent) const;
  void add_results(const std::vector<FaceResult>& results, const Request& request,
                   Forces& forces) const;

  PlatePair plates_;
  double stiffness_ = 1e6, turning_depth_ = 0;
  int order_ = 1;
  Cells cells_;
  std::shared_ptr<const ScatterMap> scatter_;
  std::vector<Vec3> imaged_;            // positions of all nodes, for the areas
  std::vector<Rule> rules_;             // coarse to fine
  std::vector<QuadShape> nodal_shape_;  // at the nodes of a face
  std::vector<double> nodal_area_;      // ∫ N dA of the nodes of every face, imaged, mm²
  std::vector<int> chosen_;             // per face, its rule
};

}  // namespace breast
