// SPDX-License-Identifier: GPL-3.0-or-later
// The extreme cases of gravity, defined once: for the program that prints the table and for the
// tests that run a part of it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mechanics/mechanics.hpp"

namespace breast::extreme {

/// A mesh, its tissues and options, and the gravity (mm/s²) its imaged shape was seen under.
struct Problem {
  HexMesh mesh;
  MechanicsOptions options;
  Vec3 gravity{0, 0, 0};
};

struct Case {
  std::string name;
  bool tested = false;                 ///< in the test suite as well
  int elements = 0;                    ///< about; what a limit on size is compared with
  std::string expected = "converged";  ///< or a reason_id
  std::function<Problem()> make;
};

/// One factor at a time about the base case (an analytic breast of some 500 elements, seed2008,
/// prone gravity, 1.45 mm membrane skin), then combinations.
std::vector<Case> cases();

/// A direction solved: a row of the table.
struct Row {
  std::string direction;  ///< "backward" or "forward"
  SolveSummary summary;
  double seconds = 0;
  double closure_mm = 0;  ///< forward: largest distance from the imaged shape
  std::string outcome() const { return summary.converged() ? "converged" : summary.reason_id; }
};

/// Backward and, from its body, forward under the same gravity. Backward
/// alone when it has no answer.
std::vector<Row> solve(const Problem& problem);

}  // namespace breast::extreme
