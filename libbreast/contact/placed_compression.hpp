// SPDX-License-Identifier: GPL-3.0-or-later
// A compression between plates that stand at one place: the breast is brought between them, they close to the target, and the
// result is judged.
#pragma once

#include <functional>
#include <memory>

#include "contact/compression.hpp"
#include "contact/path/path.hpp"
#include "mechanics/load_steps.hpp"
#include "mechanics/scene.hpp"
#include "mechanics/solution.hpp"

namespace breast {

class PlacedCompression {
 public:
  /// `mesh` and `progress` must outlive this object. Throws Error (input) if the plates would miss the breast.
  PlacedCompression(const HexMesh& mesh, CompressionOptions options,
                    const MechanicsOptions& mechanics, Progress& progress);

  /// From the stress-free shape to the target, or until the path is left.
  void run();
  /// After a run that was left because the edges press on the wall (CompressionResult::left_with_on_edge): seeks its exact end
  /// (ClosingPath::finish).
  void finish(int iterations_left);
  CompressionResult& found() { return found_; }
  const CompressionResult& found() const { return found_; }

 private:
  bool load_with(const Eigen::VectorXd& load, const char* name);
  bool position();
  bool lift();
  void place();
  void set_target();
  PathOptions path_options();
  bool has_let_go();
  void close_plates();
  void conclude_path(const std::function<PathResult()>& follow);
  void record_path();
  void count_factorisations() { found_.factorisations = solver_.factorisations() - of_states_; }
  void check_stability();
  void estimate();
  void note_stage(const char* name);
  void say_where_plates_stand() const;
  void say_how_it_ended();
  double load_reached() const;
  void judge_against_practice();
  void refuse_without_grip();
  void solve_states();

  const HexMesh& mesh_;
  CompressionOptions options_;
  Progress& progress_;
  Scene scene_;
  Eigen::VectorXd load_, pull_;  // the weight; the force that a hand adds until it lets go
  LoadedProblem body_;
  SaddleSolver solver_;
  State state_;            // the present shape
  Eigen::VectorXd start_;  // the shape about which the plates stand
  CompressionTarget target_;
  CompressionResult found_;
  SolveLog log_{found_, progress_};
  std::unique_ptr<ContactSolver> contact_;
  PathOptions path_;
  std::unique_ptr<ClosingPath> way_;
  std::size_t recorded_iterations_ = 0;  // of the path
  int recorded_solves_ = 0;
  int of_states_ = 0;  // factorisations of the states on the way
};

}  // namespace breast
