// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/turn.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "mechanics/chosen_solver.hpp"
#include "mechanics/forward_steps.hpp"
#include "mechanics/solution.hpp"

namespace breast {

namespace {

/// Directions whose sines differ by less than this are parallel or opposite.
constexpr double parallel = 1e-9;

/// A unit vector perpendicular to the unit vector `from`, towards which gravity turns.
Vec3 towards(const Vec3& from, const Vec3& to, Side side) {
  const Vec3 across = to - to.dot(from) * from;
  if (across.norm() > parallel) return across.normalized();
  const Vec3 lateral(lateral_sign(side), 0, 0), back(0, 1, 0);
  const Vec3 seen = lateral - lateral.dot(from) * from;
  return (seen.norm() > parallel ? seen : Vec3(back - back.dot(from) * from)).normalized();
}

class Turn {
 public:
  Turn(const HexMesh& mesh, const MechanicsOptions& options, bool fail_fast, Progress& progress)
      : mesh_(mesh), scene_(mesh, options), fail_fast_(fail_fast), progress_(progress) {}

  std::vector<Equilibrium> run(const Vec3& from, const Vec3& to, int states);

 private:
  const HexMesh& mesh_;
  Scene scene_;
  bool fail_fast_;
  Progress& progress_;
};

std::vector<Equilibrium> Turn::run(const Vec3& from, const Vec3& to, int states) {
  const auto gravity_at = [&](double part) { return turned_gravity(from, to, mesh_.side, part); };
  LoadedProblem loaded = scene_.problem(scene_.gravity_force(from));
  SaddleMatrix matrix = scene_.solid().space()->make_matrix();
  SaddleSolver solver(scene_.solid().space()->pattern, scene_.solid().solver());
  State state = scene_.at_rest(flatten(mesh_.reference));
  std::vector<Equilibrium> all;
  double reached = -1;  // part of the way; nothing was found yet: the load grows from zero
  for (int k = 0; k < states; ++k) {
    const double part = double(k) / (states - 1);
    Equilibrium found;
    State trial = state;
    ForwardSteps steps(loaded, solver, matrix, fail_fast_, message("state ", k + 1, " of ", states),
                       found, progress_);
    steps.run(
        [&](double share) -> Eigen::VectorXd {
          if (reached < 0) return share * scene_.gravity_force(gravity_at(part));
          return scene_.gravity_force(gravity_at(reached + share * (part - reached)));
        },
        trial);
    note_solver(solver, matrix, found);
    found.gravity = gravity_at(part);
    if (found.converged()) {
      state = std::move(trial);
      reached = part;
      conclude(found, scene_, state, found.gravity);
    } else if (fail_fast_) {
      return {std::move(found)};
    }
    all.push_back(std::move(found));
  }
  return all;
}

}  // namespace

Vec3 turned_gravity(const Vec3& from, const Vec3& to, Side side, double part) {
  const double first = from.norm(), last = to.norm();
  if (!(first > 0) || !(last > 0)) return (1 - part) * from + part * to;
  if (part <= 0) return from;
  if (part >= 1) return to;
  const Vec3 a = from / first, b = to / last;
  const Vec3 c = towards(a, b, side);
  const double angle = part * std::atan2(std::max(0.0, b.dot(c)), a.dot(b));
  return ((1 - part) * first + part * last) * (std::cos(angle) * a + std::sin(angle) * c);
}

std::vector<Equilibrium> solve_turn(const HexMesh& mesh, const Vec3& from, const Vec3& to,
                                    int states, const MechanicsOptions& options,
                                    Progress& progress) {
  if (mesh.reference.size() != mesh.points.size())
    throw input_error("mesh: no stress-free reference shape; run backward first");
  if (states < 2) throw input_error("states ", states, ": must be at least 2");
  std::vector<Equilibrium> all;
  with_chosen_solver(3.0 * mesh.nodes(), options, progress,
                     [&](const MechanicsOptions& chosen, bool fail_fast) {
                       all = Turn(mesh, chosen, fail_fast, progress).run(from, to, states);
                       return static_cast<const Equilibrium&>(all.back());
                     });
  return all;
}

}  // namespace breast
