// SPDX-License-Identifier: GPL-3.0-or-later
// Contact of faces with the plates by a pressure that grows steeply with depth. On the way to the
// target the faces may penetrate the plates by up to `way_depth`; a state to be reported is solved
// with increasingly stiff plates until no point of a face lies deeper than `depth`.
#pragma once

#include <memory>
#include <vector>

#include "contact/solvers/solver.hpp"
#include "contact/terms/friction.hpp"
#include "contact/terms/surface_pressure.hpp"

namespace breast {

struct SurfaceContactOptions {
  double stiffness = 3e4;       ///< Pa/mm, to start with
  double way_depth = 1;         ///< mm
  double depth = 0.035;         ///< mm
  double way_tolerance = 1e-6;  ///< a solve with a larger tolerance is an intermediate one
  /// A solve with at most this tolerance is a solution, one with a larger tolerance, up to that of the way, is one of
  /// those among which a force is sought.
  double accurate_tolerance = 1e-8;
  double volume_tolerance = 1e-9;
  Friction friction;
  int max_iterations = 100;   ///< without an indefinite tangent
  int most_iterations = 250;  ///< with one
};

class SurfaceContact : public ContactSolver {
 public:
  /// `body`: everything but the plates. `faces` may touch. `solver` must outlive this.
  SurfaceContact(const HexMesh& mesh, const std::vector<Face>& faces, const Problem& body,
                 SaddleSolver& solver, SurfaceContactOptions options = {});

  ContactStep solve(const PlatePair& plates, State& state, double tolerance) override;
  const Problem& problem() const override { return problem_; }
  Constraints constraints(const State& state) const override {
    return problem_.constraints_at(state.x);
  }
  const std::vector<int>& candidates() const override { return candidates_; }
  std::vector<Face> contact_faces(const HexTopology& mesh) const override;
  double resolution() const override;
  void fill_record(const State& solution, ContactRecord& record) const override;
  /// Nothing: faces roll on plates, and steps towards a richer mesh with a fixed touching set were
  /// wrong by factors of three either way (docs/validation).
  std::optional<ContactEstimate> for_estimate(const HexMesh&, const PlatePair&,
                                              const State&) const override {
    return {};
  }

 private:
  class System;
  /// The plates' forces on the candidates, the friction that they allow (µN), and the relative
  /// difference between this and memory_.bounds.
  struct Bounds {
    std::vector<NodalContact> contacts;
    std::vector<double> values;
    double lag = 0;
    /// Goes only this part of the way from the present values.
    void approach_from(const std::vector<double>& present, double part) {
      for (std::size_t c = 0; c < values.size(); ++c)
        values[c] = (1 - part) * present[c] + part * values[c];
    }
  };
  bool equilibrate(State& state, double tolerance, double depth, ContactStep& step);
  bool begin(State& state, double tolerance, double allowed, ContactStep& step);
  bool stiffen(State& state, double allowed, ContactStep& step);
  void finish(const State& state, ContactStep& step);
  std::vector<NodalContact> nodal_contacts(const Eigen::VectorXd& x) const;
  void set_friction(const Eigen::VectorXd& x, bool keep_normals = false);
  Bounds bounds_at(const Eigen::VectorXd& x) const;
  void adopt(Bounds bounds, const State& state, bool keep_normals);
  void hold(std::size_t c, int plate, const State& state);
  void move_anchors(const State& state, ContactStep& step);

  Problem problem_;
  SaddleSolver& solver_;
  SaddleMatrix matrix_;
  SurfaceContactOptions options_;
  std::shared_ptr<SurfacePressure> pressure_;
  std::shared_ptr<FrictionTerm> friction_;  // null: none
  std::vector<int> candidates_;
};

}  // namespace breast
