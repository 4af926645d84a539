// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the plates stand: at first at their default place, then, while their edges press on the chest wall, farther from it.
#include "contact/compression.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "contact/placed_compression.hpp"
#include "core/error.hpp"

namespace breast {

namespace {

void check(const HexMesh& mesh, const CompressionOptions& options,
           const MechanicsOptions& mechanics) {
  if (mechanics.solver == SolverOption::multigrid) {
    throw input_error("--solver multigrid is not available for compression: use auto or direct");
  }
  if (mesh.reference.size() != mesh.points.size()) {
    throw input_error("mesh: no stress-free reference shape; run backward first");
  }
  for (const CompressionStop& stop : options.stops) {
    if (!(stop.value > 0)) {
      throw input_error("compression target ", stop.value, ": must be above 0");
    }
    if (stop.at == StopAt::reduction && !(stop.value < 100)) {
      throw input_error("reduction ", stop.value, " %: must be below 100");
    }
  }
  if (options.states < 0 || options.states == 1) {
    throw input_error("states ", options.states, ": must be at least 2, or 0 for none");
  }
  if (!(options.pull_N >= 0 && options.pull_N <= 500)) {
    throw input_error("pull ", options.pull_N, " N: must lie within 0 and 500");
  }
  if (options.pull_N > 0 && options.positioning == Positioning::hanging) {
    throw input_error(
        "pull ", options.pull_N,
        " N on a hanging breast: only a lifted breast can be pulled; give --positioning lifted");
  }
  if (!(options.friction >= 0 && options.friction <= 2)) {
    throw input_error("friction ", options.friction, ": must lie within 0 and 2");
  }
  if (options.friction > 0 && options.method == ContactMethod::augmented_lagrangian) {
    throw input_error("friction ", options.friction,
                      " with the augmented Lagrangian, which has no friction: omit --contact al");
  }
}

/// A loosely solved state with more than this part of a plate's force on its edge will not grip: that
/// takes less than 0.40, and such states differ from accurate ones by up to 0.03.
constexpr double surely_on_edge = 0.43;

/// Shares of the paddle's and the detector's force on their rounded edges.
std::array<double, 2> on_edges(const CompressionResult& found) {
  if (found.left_with_on_edge) return *found.left_with_on_edge;
  std::array<double, 2> parts{0, 0};
  for (std::size_t k = 0; k < std::min(parts.size(), found.places.size()); ++k)
    parts[k] = found.places[k].edge_part;
  return parts;
}

/// The larger of the two.
double on_edge(const CompressionResult& found) {
  return std::ranges::max(on_edges(found));
}

/// Whether a result between plates that were placed anew replaces the one before: always if it grips, and
/// a finished one replaces one that was left, unless it used up the iterations on its way.
bool is_better(const CompressionResult& next, const CompressionResult& before) {
  if (next.converged()) return true;
  if (next.path.end == PathEnd::cost_limit) return false;
  const bool left = next.left_with_on_edge.has_value();
  if (!left && !next.contact) return false;
  if (left != before.left_with_on_edge.has_value()) return !left;
  return on_edge(next) < on_edge(before);
}

/// Whether the edges press on the chest wall instead of the breast, so that the result is no compression.
bool presses_on_wall(const CompressionResult& found) {
  if (found.left_with_on_edge) return true;
  return !found.converged() && std::ranges::any_of(found.judgement, [](const Judgement& line) {
    return line.id == "edge_carries_force";
  });
}

/// Where the edge of the image is placed if the wall is in the way: halfway to the farthest place, and there. Nowhere else
/// if the place is given, or if the plates need not grip the breast.
std::vector<double> farther_image_edges(const CompressionOptions& options) {
  constexpr double least_mm = 1;
  const PlateOptions& plates = options.plates;
  if (!options.must_grip || plates.edge_at || !plates.image_edge || !plates.farthest_image_edge)
    return {};
  const double farthest = *plates.farthest_image_edge, way = farthest - *plates.image_edge;
  if (way < least_mm) return {};
  return {farthest - 0.5 * way, farthest};
}

/// Adds the cost of another placement of the plates, whose iterations stand before those of the result.
void charge(const CompressionResult& other, CompressionResult& found) {
  std::vector<IterationRecord>& rows = found.record.iterations;
  for (IterationRecord& row : rows) row.step += other.steps;
  rows.insert(rows.begin(), other.record.iterations.begin(), other.record.iterations.end());
  found.steps += other.steps;
  found.newton_iterations += other.newton_iterations;
  found.linear_iterations += other.linear_iterations;
  found.factorisations += other.factorisations;
  found.path.indefinite += other.path.indefinite;
  found.path.failures += other.path.failures;
  for (const auto& [phase, seconds] : other.timer.seconds()) found.timer.add(phase, seconds);
}

/// The options with the angle by which the patient bends forwards, and gravity in her frame; `options.gravity` is that of a
/// patient who stands upright.
CompressionOptions bent(const HexMesh& mesh, CompressionOptions options) {
  const ViewPose pose = place_pose(mesh, mesh.reference, options.angle_deg, options.plates);
  options.plates.bend_deg = pose.bend_deg;
  options.gravity = turned_by_bend(pose, options.gravity);
  return options;
}

/// Where the plates stand and how far the patient bends forwards: what changes from one placement to the next.
struct Stance {
  std::optional<double> image_edge, bend_deg;
};

/// The search for a place at which the plates grip the breast. A placement is left as soon as the edges press on the wall, and
/// finished only if no other is better.
class PlacementSearch {
 public:
  PlacementSearch(const HexMesh& mesh, const CompressionOptions& options,
                  const MechanicsOptions& mechanics, Progress& progress)
      : mesh_(mesh), options_(options), mechanics_(mechanics), progress_(progress) {}

  CompressionResult run();

 private:
  void solve_at(const Stance& stance, double most_on_edge);
  bool search_at(double image_edge, bool last);
  CompressionResult conclude();

  const HexMesh& mesh_;
  const CompressionOptions& options_;
  const MechanicsOptions& mechanics_;
  Progress& progress_;
  std::unique_ptr<PlacedCompression> best_;
  Stance stance_;                            // of the best
  std::map<int, CompressionResult> others_;  // by number, in the order in which they were solved
  int best_number_ = 0;
  int iterations_ = 0;  // of all placements
};

/// Compresses with the plates at a place. The result is kept as the best or among the others.
void PlacementSearch::solve_at(const Stance& stance, double most_on_edge) {
  CompressionOptions placed = options_;
  placed.plates.image_edge = stance.image_edge;
  placed.plates.bend_deg = stance.bend_deg;
  placed.path.most_on_edge = most_on_edge;
  placed.path.most_iterations -= iterations_;
  placed = bent(mesh_, std::move(placed));
  const Stance taken{stance.image_edge, placed.plates.bend_deg};
  auto next = std::make_unique<PlacedCompression>(mesh_, std::move(placed), mechanics_, progress_);
  next->run();
  iterations_ += next->found().newton_iterations;
  int number = best_ == nullptr ? 0 : int(others_.size()) + 1;
  if (best_ == nullptr || is_better(next->found(), best_->found())) {
    std::swap(next, best_);
    std::swap(number, best_number_);
    stance_ = taken;
  }
  if (next != nullptr) others_.emplace(number, std::move(next->found()));
}

/// Tries another place of the edge. Returns false if it grips, or if the plates would miss the breast there.
bool PlacementSearch::search_at(double image_edge, bool last) {
  const CompressionResult& best = best_->found();
  Stance stance{image_edge, stance_.bend_deg};
  if (!options_.plates.bend_deg)
    stance.bend_deg = balanced_bend_deg(*stance_.bend_deg, on_edges(best));
  progress_.note(message("the plates' edge carries ", std::round(100 * on_edge(best)),
                         " % of a plate's force: the plates are placed anew, their edge ",
                         image_edge - *options_.plates.image_edge,
                         " mm farther from the wall than at first, the patient bent forwards by ",
                         *stance.bend_deg, " degrees"));
  try {
    solve_at(stance, last ? options_.path.most_on_edge : surely_on_edge);
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::input) return false;
    throw;
  }
  return !best_->found().converged();
}

CompressionResult PlacementSearch::run() {
  const std::vector<double> farther = farther_image_edges(options_);
  solve_at({options_.plates.image_edge, options_.plates.bend_deg},
           farther.empty() ? options_.path.most_on_edge : surely_on_edge);
  bool search = presses_on_wall(best_->found());
  for (std::size_t k = 0; search && k < farther.size(); ++k) {
    if (iterations_ >= options_.path.most_iterations) {
      progress_.note(message("the plates are not placed anew: ", iterations_,
                             " iterations were made; --most-iterations allows more"));
      break;
    }
    search = search_at(farther[k], k + 1 == farther.size());
  }
  return conclude();
}

/// The best placement, with the cost of all: its iterations stand after those of the others.
CompressionResult PlacementSearch::conclude() {
  if (best_->found().left_with_on_edge)
    best_->finish(std::max(0, options_.path.most_iterations - iterations_));
  CompressionResult found = std::move(best_->found());
  std::for_each(others_.rbegin(), others_.rend(),
                [&](const auto& other) { charge(other.second, found); });
  found.placements = 1 + int(others_.size());
  return found;
}

}  // namespace

CompressionResult compress(const HexMesh& mesh, const CompressionOptions& options,
                           const MechanicsOptions& mechanics, Progress& progress) {
  check(mesh, options, mechanics);
  return PlacementSearch(mesh, options, mechanics, progress).run();
}

}  // namespace breast
