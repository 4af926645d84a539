// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/mechanics_options.hpp"

#include <sstream>

#include "core/error.hpp"
#include "core/table.hpp"
#include "core/types.hpp"
#include "core/units.hpp"

namespace breast {

namespace {

// Numbers below these limits are much more likely to be in another unit than intended: a fraction
// instead of a percentage (the softest row of the paper's tables is 10 percent), m/s2 or multiples
// of the earth's gravity instead of mm/s2 (50 mm/s2, a two-hundredth of the earth's gravity, moves
// a breast by a tenth of a millimetre).
constexpr double least_scale_percent = 10;
constexpr double least_gravity_mm_s2 = 50;
// Twice the earth's gravity: more is a slip of a power of ten, or um/s2.
constexpr double most_gravity_mm_s2 = 2 * gravity_mm_s2;

void check_scale(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) {
    throw input_error("--scale: '", text, "' is not of the form TISSUE=PERCENT, such as fat=150");
  }
  tissue_from_name(text.substr(0, equals));
  const double percent = parse_number(text.substr(equals + 1), "--scale " + text.substr(0, equals));
  if (!(percent > 0)) throw input_error("--scale: '", text, "' must be above 0 percent");
  if (percent < least_scale_percent) {
    throw input_error("--scale ", text, ": ", format_number(percent), " percent is below ",
                      format_number(least_scale_percent), "; did you mean ",
                      text.substr(0, equals + 1), format_number(100 * percent),
                      "? (100 leaves the stiffness unchanged; a softer tissue needs a material "
                      "set of its own, --materials FILE)");
  }
}

void check_gravity(const Vec3& gravity, const std::string& given) {
  const double size = gravity.stableNorm();
  if (size > most_gravity_mm_s2) {
    throw input_error("--gravity ", given, ": ", format_number(size), " mm/s2 is above ",
                      format_number(most_gravity_mm_s2),
                      ", twice the earth's gravity, which is 9810 mm/s2");
  }
  if (size == 0 || size >= least_gravity_mm_s2) return;
  // In m/s2 a body on earth has 9.81, in multiples of the earth's gravity 1.
  const double factor = size > 2 ? 1000 : gravity_mm_s2;
  std::string meant;
  for (int d = 0; d < 3; ++d) meant += (d == 0 ? "" : ",") + format_number(factor * gravity[d]);
  throw input_error("--gravity ", given, ": ", format_number(size), " mm/s2 is below ",
                    format_number(least_gravity_mm_s2), "; did you mean ", meant,
                    "? (in mm/s2, the earth's gravity is 9810; 0,0,0 means none)");
}
}  // namespace

namespace {

void declare_origin(Tool& tool, const MechanicsChoices& choices, const std::string& from) {
  tool.describe(
      "The model is the one with which " + from +
      " was solved, as the file states it: laws, densities and skin, supports at wall and cut, "
      "element, invariants and bulk ratio. Options change only what they name; --materials "
      "replaces laws, densities and skin, and those supports that the set has. A warning names every "
      "part that differs from the file's model. " +
      (choices.default_set.empty()
           ? "A file without a model needs --materials; wall, cut"
           : "Without a model in the file and without --materials, the set is " +
                 choices.default_set + "; wall, cut") +
      " and skin are then those of the set (where it states none: the wall is held, the cut free, "
      "and the skin does not wrinkle), the element is q1p0, the invariants are isochoric, and the tissues are "
      "exactly incompressible.");
}

}  // namespace

void declare_mechanics(Tool& tool, MechanicsChoices& choices, const std::string& from) {
  declare_origin(tool, choices, from);
  tool.text(choices.materials, "--materials", "NAME|FILE", "material set: its name or a TSV file");
  tool.texts(
      choices.scale, "--scale", "TISSUE=PERCENT",
      "stiffness of one tissue in percent of its stiffness in --materials or, without that, in the "
      "file's model, such as fat=150 (at least 10)");
  tool.choice(choices.element, "--element", {"q1p0", "q2p1"},
              "element type: 8 nodes and one pressure, or 27 nodes and four pressures");
  tool.choice(choices.invariants, "--invariants", {"isochoric", "plain"},
              "invariants in the laws: those of the isochoric part of C, or the plain ones as "
              "printed in the paper");
  tool.text(choices.bulk_ratio, "--bulk-ratio", "K_OVER_MU|incompressible",
            "ratio of bulk to shear modulus, from 1 to 1e9, or exactly incompressible tissues");
  tool.text(choices.wall, "--wall", "held|slide[:KT]|spring:KN[,KT]",
            "boundary condition at the chest wall. held: no displacement; slide: the breast "
            "slides on the wall against springs of KT kPa/mm (0.01 if no number is given); "
            "spring: springs of KN kPa/mm normal and KT tangential to the wall (KT is a third "
            "of KN if it is not given). With L=MM behind the numbers (slide:0.002,L=20), springs "
            "along the wall are twice as stiff where they have moved by L, and P=EXPONENT (2 if "
            "not given) says how they stiffen");
  tool.text(
      choices.cut, "--cut", "free|fixed|roller|spring:KC[,KS][,BORDER=K]|tissue:KC[,KS]",
      "boundary condition on the lateral cut, the surface at which the model ends: free, "
      "fixed, roller, or springs of KC kPa/mm, or of K at the medial, superior, lateral or "
      "inferior BORDER of the breast (spring:0.001,medial=0.1), with L and P as at the wall. "
      "Where the cut faces the sternum, tissue that moves away from it is pulled back with KS "
      "kPa/mm. tissue: the same springs, which also hold up the tissue beyond the cut; springs at "
      "the wall (KT) carry a part of its weight, and the cut carries the rest");
  tool.number(choices.skin_compression, "--skin-compression", "PERCENT",
              "share of the skin's stiffness that remains in compression, where skin wrinkles", 0.1,
              100);
  tool.number(choices.skin_smoothing, "--skin-smoothing", "WIDTH",
              "half the width of the transition to wrinkling, in squared stretches", 1e-4, 0.5);
  tool.number(choices.skin_prestretch, "--skin-prestretch", "PERCENT",
              "stretch of the skin in the stress-free shape of the body", 0, 50);
  tool.choice(choices.solver, "--solver", {"auto", "direct", "multigrid"},
              "linear solver. direct: Cholesky factorisation; multigrid: iterative, with a "
              "check of stability; auto: multigrid where it is cheaper, followed by direct if "
              "multigrid meets a difficulty");
  tool.flag(choices.keep_unconverged, "--keep-unconverged",
            "write the last state of a solve that did not converge, marked by its status; the exit "
            "code is still 3");
  tool.topic("model",
             {"--materials", "--scale", "--element", "--invariants", "--bulk-ratio", "--wall",
              "--cut", "--skin-compression", "--skin-smoothing", "--skin-prestretch"});
  tool.topic("solver", {"--solver", "--keep-unconverged"});
  tool.check([&choices] {
    for (const std::string& scale : choices.scale) check_scale(scale);
  });
}

void declare_estimate(Tool& tool, std::string& estimate) {
  tool.choice(
      estimate, "--estimate", {"step", "q2", "none"},
      "estimate of the discretisation error at the landmarks. step: by two Newton steps with "
      "27-node elements, which share one factorisation; q2: by a complete second solution "
      "with 27-node elements (expensive); none: no estimate");
  tool.topic("solver", {"--estimate"});
}

Vec3 GravityChoices::vector() const {
  if (gravity.empty()) return posture_gravity(posture_from_name(posture));
  return {gravity[0], gravity[1], gravity[2]};
}

void declare_gravity(Tool& tool, GravityChoices& choices, const std::string& help) {
  std::vector<std::string> postures{"supine", "prone", "upright", "off"};
  if (choices.posture == "prone") std::swap(postures[0], postures[1]);
  tool.choice(choices.posture, "--posture", postures, help);
  tool.numbers(choices.gravity, "--gravity", "gx,gy,gz", 3,
               "gravity vector in mm/s2 along the patient axes (left, posterior, superior), "
               "instead of --posture; its magnitude is at least 50, or 0 for none");
  tool.check([&choices] {
    if (choices.gravity.empty()) return;
    const Vec3 gravity = choices.vector();
    std::string given;
    for (int d = 0; d < 3; ++d) given += (d == 0 ? "" : ",") + format_number(gravity[d]);
    check_gravity(gravity, given);
  });
}

Vec3 parse_gravity(const std::string& text) {
  if (text.find(',') == std::string::npos) return posture_gravity(posture_from_name(text));
  Vec3 gravity = Vec3::Zero();
  std::istringstream parts(text);
  int count = 0;
  for (std::string part; std::getline(parts, part, ','); ++count) {
    if (count < 3) gravity[count] = parse_number(part, "--gravity");
  }
  if (count != 3) throw input_error("--gravity '", text, "': three numbers are needed, mm/s2");
  check_gravity(gravity, text);
  return gravity;
}

}  // namespace breast
