// How far to go along a Newton increment: one rule for all contact methods, each of which sees a
// trial state in its own way.
#pragma once

#include <functional>

#include "contact/solver.hpp"

namespace breast {

/// A state as a contact method sees it.
struct Appraisal {
  double imbalance = 0;  ///< relative to the forces
  double merit = 0;      ///< what a step is to reduce
  double along = 0;      ///< gradient of the augmented energy along the increment
};
using Appraise = std::function<Appraisal(const BodyState&, const BodyForces&)>;

/// What is accepted beside a merit below the one at the start.
struct StepRule {
  double merit = 0;           ///< at the start
  double tolerance = 0;       ///< imbalance of a solution
  bool any = false;           ///< every admissible length
  bool flat_suffices = true;  ///< an end where the energy is flatter along the step
  /// The energy has kinks: a penalty that sets in along the step can be hundreds of times as stiff
  /// as the tangent knows, so after halves the slope says how much shorter.
  bool kinks = false;
};

/// Shortens the increment until a length of it is accepted, and doubles it where the body slips.
/// Sets `state` and the result's forces and adds the iteration to its history; else false, and the
/// result's outcome says why.
bool search_step(ContactBody& body, const BodyState& increment, const BodySolve& solve,
                 const StepRule& rule, const Appraise& appraise, BodyState& state,
                 StepResult& result);

}  // namespace breast
