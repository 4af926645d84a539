#include "cli/mechanics_options.hpp"

#include <sstream>

#include "core/error.hpp"
#include "core/table.hpp"
#include "core/types.hpp"
#include "core/units.hpp"

namespace breast {

namespace {
void check_scale(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) {
    throw input_error("--scale: '", text, "' is not TISSUE=PERCENT; for example fat=150");
  }
  tissue_from_name(text.substr(0, equals));
  const double percent = parse_number(text.substr(equals + 1), "--scale " + text.substr(0, equals));
  if (!(percent > 0)) throw input_error("--scale: '", text, "' must be above 0 percent");
}
}  // namespace

void declare_mechanics(Tool& tool, MechanicsChoices& choices) {
  tool.text(choices.materials, "--materials", "NAME|FILE",
            "name of a material set, or a TSV file of one");
  tool.texts(choices.scale, "--scale", "TISSUE=PERCENT",
             "stiffness of one tissue in percent of the set's, as fat=150");
  tool.choice(choices.element, "--element", {"q1p0", "q2p1"},
              "8 nodes and one pressure, or 27 nodes and four");
  tool.choice(choices.invariants, "--invariants", {"isochoric", "plain"},
              "invariants of the isochoric part of C, or plain as printed in the paper");
  tool.number(choices.bulk_ratio, "--bulk-ratio", "K_OVER_MU",
              "bulk over shear modulus; without it, exactly incompressible", 1.0, 1e9);
  tool.choice(choices.cut, "--cut", {"free", "fixed", "roller"},
              "what holds the lateral cut surface where the body ends");
  tool.choice(choices.solver, "--solver", {"auto", "direct", "multigrid"},
              "linear solver: a Cholesky factor; multigrid, with a check of stability; or "
              "multigrid where it "
              "is cheaper, and a factor where multigrid meets a difficulty");
  tool.flag(
      choices.keep_unconverged, "--keep-unconverged",
      "write the last state of a solve that did not converge; its status says so, exit code 3");
  tool.check([&choices] {
    for (const std::string& scale : choices.scale) check_scale(scale);
  });
}

void declare_estimate(Tool& tool, std::string& estimate) {
  tool.choice(estimate, "--estimate", {"step", "q2", "none"},
              "discretisation error at the landmarks by two steps with 27-node elements and one "
              "matrix, by a whole second solution with them (dear), or not at all");
}

Vec3 GravityChoices::vector() const {
  if (gravity.empty()) return posture_gravity(posture);
  return {gravity[0], gravity[1], gravity[2]};
}

void declare_gravity(Tool& tool, GravityChoices& choices, const std::string& help) {
  std::vector<std::string> postures{"supine", "prone", "upright", "off"};
  if (choices.posture == "prone") std::swap(postures[0], postures[1]);
  tool.choice(choices.posture, "--posture", postures, help);
  tool.numbers(choices.gravity, "--gravity", "gx,gy,gz", 3,
               "gravity in mm/s2, patient axes (left, posterior, superior), instead of --posture");
}

Vec3 parse_gravity(const std::string& text) {
  if (text.find(',') == std::string::npos) return posture_gravity(text);
  Vec3 gravity = Vec3::Zero();
  std::istringstream parts(text);
  int count = 0;
  for (std::string part; std::getline(parts, part, ','); ++count) {
    if (count < 3) gravity[count] = parse_number(part, "--gravity");
  }
  if (count != 3) throw input_error("--gravity '", text, "': three numbers are needed, mm/s2");
  return gravity;
}

}  // namespace breast
